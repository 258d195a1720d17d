//! f32 with the square root of `micromath`: within 6.1 %, for a tenth of the instructions.
//!
//! Only the root is approximate. Instructions an operation takes, counted in release builds:
//!
//! | | Cortex-M0, no floating point | Cortex-M4F | largest relative error |
//! |---|---|---|---|
//! | √ of `f32` | 414 | 48 | half a unit in the last place |
//! | √ of [`Fast32`] | 52 | 12 | 6.07 %, never too small |
//! | division, as in `f32` and here | 173 | 1 | half a unit in the last place |
//! | multiplication by `micromath`'s reciprocal | 112 | 4 | 12.5 % |
//! | the same after a Newton step | 595 | 9 | 0.2 % |
//!
//! Division stays exact: a twelfth of every quotient is more than the third of a division that its reciprocal saves without
//! floating point, and nothing is saved with it. A Newton step for the root costs 708 instructions on the M0. A sum that
//! needs r² alone needs no root at all.

use super::{Accumulator, Arithmetic, Scalar, Table};
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};
use micromath::F32Ext;

/// An f32 whose square root is an approximation; see the [module](self).
///
/// ```
/// use sph_core::Scalar;
/// use sph_core::scalar::fast::Fast32;
/// let root = Fast32(2.0).sqrt().0;
/// assert!((root / core::f32::consts::SQRT_2 - 1.0).abs() < 0.061);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Fast32(pub f32);

/// One operator, as f32 does it.
macro_rules! operator {
    ($Operator:ident $method:ident, $Assign:ident $assign:ident) => {
        operator!($Operator $method);

        impl $Assign for Fast32 {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                self.0.$assign(other.0);
            }
        }
    };
    ($Operator:ident $method:ident) => {
        impl $Operator for Fast32 {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    };
}

operator!(Add add, AddAssign add_assign);
operator!(Sub sub, SubAssign sub_assign);
operator!(Mul mul);
operator!(Div div);

impl Neg for Fast32 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl From<f32> for Fast32 {
    #[inline(always)]
    fn from(value: f32) -> Self {
        Self(value)
    }
}

impl From<Fast32> for f32 {
    #[inline(always)]
    fn from(number: Fast32) -> Self {
        number.0
    }
}

impl Arithmetic for Fast32 {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    #[inline(always)]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self(Arithmetic::ratio(numerator, denominator))
    }

    #[inline(always)]
    fn positive_part(self) -> Self {
        Self(self.0.positive_part())
    }

    #[inline(always)]
    fn times(self, n: i32) -> Self {
        Self(self.0.times(n))
    }
}

impl Scalar for Fast32 {
    type Sum = Self;

    const NAME: &'static str = "fast32";
    const EPSILON: Self = Self(f32::EPSILON);
    const MAX: Self = Self(f32::MAX);

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        Self(Scalar::from_f64(value))
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self.0.to_f64()
    }

    /// √x: 0 to 6.07 % too large. 0 where x is 0 or subnormal, ∞ where x is, NaN for x < 0.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let smallest = f32::MIN_POSITIVE.to_bits();
        let positive_and_normal =
            self.0.to_bits().wrapping_sub(smallest) < f32::INFINITY.to_bits() - smallest;
        Self(match self.0 {
            x if positive_and_normal => F32Ext::sqrt(x),
            x if x < 0.0 => f32::NAN,
            x if x < f32::MIN_POSITIVE => 0.0,
            infinite_or_nan => infinite_or_nan,
        })
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    #[inline(always)]
    fn floor_to_i32(self) -> i32 {
        self.0.floor_to_i32()
    }

    #[inline(always)]
    fn canonical_bits(self) -> u64 {
        self.0.canonical_bits()
    }

    #[inline(always)]
    fn split(self, bits: u32) -> (usize, Self) {
        let (index, rest) = self.0.split(bits);
        (index, Self(rest))
    }

    #[inline(always)]
    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        f32::constant::<C, ROWS, N>(row, i).map(Self)
    }
}

impl Accumulator<Fast32> for Fast32 {
    const ZERO: Self = Self(0.0);

    #[inline(always)]
    fn add(&mut self, term: Fast32) {
        *self += term;
    }

    #[inline(always)]
    fn total(self) -> Fast32 {
        self
    }

    #[inline(always)]
    fn scaled_total(self, a: Fast32, b: Fast32) -> Fast32 {
        a * b * self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The smallest and the largest relative error over `range`, every 977th float of it.
    fn errors(
        range: core::ops::Range<f32>,
        approximate: fn(f32) -> f32,
        exact: fn(f64) -> f64,
    ) -> (f64, f64) {
        let bits = (range.start.to_bits()..range.end.to_bits()).step_by(977);
        bits.map(f32::from_bits).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            let error = f64::from(approximate(x)) / exact(x.into()) - 1.0;
            (low.min(error), high.max(error))
        })
    }

    #[test]
    fn root_is_up_to_six_percent_too_large() {
        let (low, high) = errors(f32::MIN_POSITIVE..f32::MAX, |x| Fast32(x).sqrt().0, libm::sqrt);
        assert!((-1e-7..=0.0).contains(&low), "{low}");
        assert!((0.0605..0.0608).contains(&high), "{high}");
    }

    #[test]
    fn quotient_is_exact() {
        let (low, high) = errors(1.0..4.0, |x| (Fast32(1.0) / Fast32(x)).0, |x| 1.0 / x);
        assert!((-6e-8..-4e-8).contains(&low), "{low}");
        assert!((4e-8..6e-8).contains(&high), "{high}");
    }

    #[test]
    fn the_reciprocal_left_out_is_an_eighth_too_large() {
        let (low, high) = errors(1.0..4.0, F32Ext::inv, |x| 1.0 / x);
        assert!((-1e-7..=0.0).contains(&low), "{low}");
        assert!((0.1249..0.1251).contains(&high), "{high}");
    }

    #[test]
    fn root_at_the_edges() {
        for zero in [0.0, -0.0, 1e-45, f32::MIN_POSITIVE.next_down()] {
            assert_eq!(Fast32(zero).sqrt().0.to_bits(), 0, "{zero:e}");
        }
        assert_eq!(Fast32(f32::INFINITY).sqrt().0, f32::INFINITY);
        for nan in [f32::NAN, -1.0, -1e-45, f32::NEG_INFINITY] {
            assert!(Fast32(nan).sqrt().0.is_nan(), "{nan}");
        }
        assert!((1.8e19..2e19).contains(&Fast32::MAX.sqrt().0));
        assert_eq!(Fast32(1.0).sqrt(), Fast32::ONE);
    }

    #[test]
    fn everything_else_is_as_in_f32() {
        let (a, b) = (Fast32(2.75), Fast32(-0.3));
        for (found, expected) in
            [(a + b, 2.75 - 0.3), (a - b, 2.75 + 0.3), (a * b, 2.75 * -0.3), (a / b, 2.75 / -0.3)]
        {
            assert_eq!(found.0, expected);
        }
        assert_eq!(a * a * a, a.pow::<3>());
        assert_eq!((-b).0, 0.3);
        assert_eq!(b.positive_part().canonical_bits(), 0);
        assert_eq!((b.floor_to_i32(), a.times(20).0, Fast32::ratio(1, 3).0), (-1, 55.0, 1.0 / 3.0));
        assert!(!(a / Fast32::default()).is_finite());
        assert_eq!(a.canonical_bits(), u64::from(2.75_f32.to_bits()));
        assert_eq!(Fast32(-0.0).canonical_bits(), 0);
        assert_eq!(f32::from(Fast32::from_f64(0.1)), 0.1);
    }

    #[test]
    fn sums_in_order() {
        let mut sum = <Fast32 as Accumulator<Fast32>>::ZERO;
        for term in [1e8, 1.0, -1e8] {
            Accumulator::add(&mut sum, Fast32(term));
        }
        assert_eq!(sum.total(), Fast32(0.0));
    }
}
