//! The number types, and the operations that the mathematics needs of them.
//!
//! Two traits, because two kinds of number run through the same source. [`Arithmetic`] is what a kernel needs: no
//! comparison that yields a `bool`, so an array of SIMD lanes satisfies it as well as one number does. [`Scalar`] adds
//! comparison, the square root and conversions: what searches, sums and solvers need of one number.
//!
//! | scalar | where | roots by |
//! |---|---|---|
//! | `f32`, `f64` | [`float`] | libm: the same bits on every target |
//! | `Fast32` | `fast`, feature `micromath` | micromath's approximations, errors documented |
//! | `Fixed` over the types of the `fixed` crate | `fixed`, feature `fixed` | integer square root |
//!
//! A new scalar is one file that implements both traits and its line in [`for_each_float`](crate::for_each_float); a new
//! fixed-point format is one line in `for_each_format`. The command, the laws and the other tests take them from there.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

pub mod compact;
#[cfg(feature = "micromath")]
pub mod fast;
#[cfg(feature = "fixed")]
pub mod fixed;
pub mod float;

/// Calls a macro with the list of the scalars: variant name, type and description of each, and then with what follows `;`. What
/// the features `micromath` and `fixed` bring is in it where they are on. [`Scalar::NAME`] is the name that users write.
///
/// ```
/// use sph_core::Scalar;
/// macro_rules! names {
///     ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => { [$(<$Scalar as Scalar>::NAME),+] };
/// }
/// assert_eq!(sph_core::for_each_scalar!(names)[..2], ["f64", "f32"]);
/// ```
#[macro_export]
macro_rules! for_each_scalar {
    ($($callback:tt)::+ $(; $($context:tt)*)?) => {
        $crate::for_each_float! { $crate::__with_formats; ($($callback)::+) ($($($context)*)?) }
    };
}

/// As [`for_each_scalar`](crate::for_each_scalar), with the scalars that are no fixed-point formats.
///
/// ```
/// use sph_core::Scalar;
/// macro_rules! names {
///     ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => { [$(<$Scalar as Scalar>::NAME),+] };
/// }
/// assert!(!sph_core::for_each_float!(names).contains(&"i16f16"));
/// ```
#[cfg(feature = "micromath")]
#[macro_export]
macro_rules! for_each_float {
    ($($callback:tt)::+ $(; $($context:tt)*)?) => {
        $($callback)::+! {
            [
                F64: f64, "64-bit floating point";
                F32: f32, "32-bit floating point";
                Fast32: $crate::scalar::fast::Fast32, "32-bit floating point with micromath's approximations";
            ]
            $($($context)*)?
        }
    };
}

/// As [`for_each_scalar`](crate::for_each_scalar), with the scalars that are no fixed-point formats.
#[cfg(not(feature = "micromath"))]
#[macro_export]
macro_rules! for_each_float {
    ($($callback:tt)::+ $(; $($context:tt)*)?) => {
        $($callback)::+! {
            [
                F64: f64, "64-bit floating point";
                F32: f32, "32-bit floating point";
            ]
            $($($context)*)?
        }
    };
}

#[cfg(feature = "fixed")]
#[doc(hidden)]
#[macro_export]
macro_rules! __with_formats {
    ([$($list:tt)*] $callback:tt $context:tt) => {
        $crate::for_each_format! { $crate::__with_all_scalars; $callback $context $($list)* }
    };
}

#[cfg(not(feature = "fixed"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __with_formats {
    ([$($list:tt)*] $callback:tt $context:tt) => {
        $crate::__with_all_scalars! { [] $callback $context $($list)* }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! __with_all_scalars {
    (
        [$($Format:ident $name:tt $about:tt;)*] ($($callback:tt)+) ($($context:tt)*) $($list:tt)*
    ) => {
        $($callback)+! {
            [
                $($list)*
                $($Format: $crate::scalar::fixed::Saturating<$crate::scalar::fixed::$Format>, $about;)*
            ]
            $($context)*
        }
    };
}

/// What a kernel's polynomial needs of a number or of an array of lanes.
///
/// Nothing here fuses a multiplication with an addition, so every target rounds alike.
pub trait Arithmetic:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;

    /// The literal `numerator / denominator`, rounded once.
    fn ratio(numerator: i32, denominator: i32) -> Self;

    /// (x)₊ = max(0, x), without a branch and never −0.
    fn positive_part(self) -> Self;

    /// n x for a small integer n, which itself need not be representable: 20 x in a type that ends at 8.
    fn times(self, n: i32) -> Self;

    /// x^N by multiplication, squaring from the top bit of N down: the order of the products is fixed by N.
    ///
    /// ```
    /// use sph_core::Arithmetic;
    /// assert_eq!(1.5_f32.pow::<3>(), 3.375);
    /// assert_eq!(7.0_f64.pow::<0>(), 1.0);
    /// ```
    #[inline(always)]
    #[track_caller]
    fn pow<const N: u32>(self) -> Self {
        const { assert!(N < 64) };
        if N == 0 {
            return Self::ONE;
        }
        let mut power = self;
        let mut bit = 31 - N.leading_zeros();
        while bit > 0 {
            bit -= 1;
            power = power * power;
            if (N >> bit) & 1 == 1 {
                power = power * self;
            }
        }
        power
    }
}

/// One real number: [`Arithmetic`] with comparison, roots and conversions.
///
/// The smallest one of your own: an f64 that counts the multiplications of a computation. It has the operators of f64, the constants
/// and conversions below, and a running sum.
///
/// ```
/// use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};
/// use sph_core::{Accumulator, Arithmetic, BruteForce, KernelInfluence, Scalar, Sources, Uniform, kernel::Poly6};
/// use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
///
/// static PRODUCTS: AtomicU32 = AtomicU32::new(0);
///
/// #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
/// struct Counted(f64);
///
/// impl Add for Counted { type Output = Self; fn add(self, other: Self) -> Self { Self(self.0 + other.0) } }
/// impl Sub for Counted { type Output = Self; fn sub(self, other: Self) -> Self { Self(self.0 - other.0) } }
/// impl Div for Counted { type Output = Self; fn div(self, other: Self) -> Self { Self(self.0 / other.0) } }
/// impl Neg for Counted { type Output = Self; fn neg(self) -> Self { Self(-self.0) } }
/// impl AddAssign for Counted { fn add_assign(&mut self, other: Self) { self.0 += other.0 } }
/// impl SubAssign for Counted { fn sub_assign(&mut self, other: Self) { self.0 -= other.0 } }
/// impl Mul for Counted {
///     type Output = Self;
///     fn mul(self, other: Self) -> Self {
///         PRODUCTS.fetch_add(1, Relaxed);
///         Self(self.0 * other.0)
///     }
/// }
///
/// impl Arithmetic for Counted {
///     const ZERO: Self = Self(0.0);
///     const ONE: Self = Self(1.0);
///     fn ratio(numerator: i32, denominator: i32) -> Self { Self(Arithmetic::ratio(numerator, denominator)) }
///     fn positive_part(self) -> Self { Self(self.0.positive_part()) }
///     fn times(self, n: i32) -> Self { Self(self.0.times(n)) }
/// }
///
/// impl Scalar for Counted {
///     type Sum = Self;
///     const NAME: &'static str = "counted";
///     const EPSILON: Self = Self(f64::EPSILON);
///     const MAX: Self = Self(f64::MAX);
///     fn from_f64(value: f64) -> Self { Self(value) }
///     fn to_f64(self) -> f64 { self.0 }
///     fn sqrt(self) -> Self { Self(Scalar::sqrt(self.0)) }
///     fn is_finite(self) -> bool { self.0.is_finite() }
///     fn floor_to_i32(self) -> i32 { self.0.floor_to_i32() }
///     fn canonical_bits(self) -> u64 { self.0.canonical_bits() }
/// }
///
/// impl Accumulator<Counted> for Counted {
///     const ZERO: Self = Self(0.0);
///     fn add(&mut self, term: Counted) { self.0 += term.0 }
///     fn total(self) -> Counted { self }
/// }
///
/// let sources = Sources::new(BruteForce::open(&[[Counted(0.1); 2]; 10])?, Uniform(Counted(1.0)))?;
/// let w = KernelInfluence::<Counted, 2, Poly6>::new(Counted(1.0))?;
/// let before = PRODUCTS.load(Relaxed);
/// sources.density_at(&w, &[Counted(0.0); 2]);
/// // two for the distance, one for q², two for the cube, one for σ and one for the mass
/// assert_eq!(PRODUCTS.load(Relaxed) - before, 10 * 7 + 1); // and the square of the radius
/// # Ok::<(), sph_core::Error>(())
/// ```
pub trait Scalar: Arithmetic + PartialOrd + Default + Debug + Send + Sync + 'static {
    /// What a sum over neighbours is gathered in: wider than the type where the type is narrow.
    type Sum: Accumulator<Self>;

    /// The type's name as users write it, such as `f32` or `i16f16`.
    const NAME: &'static str;
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;
    /// The largest finite number.
    const MAX: Self;

    /// The nearest representable number; what is out of range becomes what overflow becomes in this type.
    fn from_f64(value: f64) -> Self;
    /// The number as an f64; exact for every type of 53 significant bits or fewer.
    fn to_f64(self) -> f64;
    /// √x, and 0 for x < 0 where the type has no NaN.
    fn sqrt(self) -> Self;
    /// False for NaN and infinities, and for a fixed-point number that overflowed where the type can tell.
    fn is_finite(self) -> bool;
    /// ⌊x⌋ as an integer, held at the ends of `i32`; 0 for NaN.
    fn floor_to_i32(self) -> i32;
    /// Bits to compare and hash by: −0 as 0, every NaN alike.
    fn canonical_bits(self) -> u64;

    /// ⌊2^`bits` x⌋ and what is left, 2^`bits` x − ⌊2^`bits` x⌋, for 0 ≤ x: a place in a table, and where behind it. `bits`
    /// is at most 12; another one, and x < 0, give a place that is meaningless.
    #[inline(always)]
    #[track_caller]
    fn split(self, bits: u32) -> (usize, Self) {
        let scaled = self.times(1_i32.wrapping_shl(bits));
        let whole = scaled.floor_to_i32();
        (whole as usize, scaled - Self::ratio(whole, 1))
    }

    /// Number i of a table's row in this type; the types of this crate convert it when the program is compiled.
    #[inline(always)]
    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        C::VALUES.get(row)?.get(i).copied().map(Self::from_f64)
    }

    /// Whether x > 0; false for NaN.
    #[inline(always)]
    fn is_above_zero(self) -> bool {
        self > Self::ZERO
    }

    /// |x|
    #[inline(always)]
    fn abs(self) -> Self {
        if self < Self::ZERO { -self } else { self }
    }

    /// The smaller of two; `other` when they do not compare.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    /// The larger of two; `other` when they do not compare.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
}

/// Numbers that are known when the program is compiled.
pub trait Table<const ROWS: usize, const N: usize> {
    /// The numbers, from −1 to 1.
    const VALUES: [[f64; N]; ROWS];
}

/// A running sum of many terms.
pub trait Accumulator<T>: Copy + Send {
    /// The empty sum.
    const ZERO: Self;
    /// Adds one term. Terms are added one by one in the order of the calls.
    fn add(&mut self, term: T);
    /// The sum, rounded or saturated to T once.
    fn total(self) -> T;

    /// a · b · sum. Only the result has to be in the range of T: neither the sum nor a · b needs to be.
    ///
    /// The form given here serves types whose products and sums tell when they leave the range, and returns what is not
    /// finite as it is. A sum that is wider than T multiplies before it is narrowed.
    #[inline(always)]
    #[track_caller]
    fn scaled_total(self, a: T, b: T) -> T
    where
        T: Scalar,
    {
        let (factor, total) = (a * b, self.total());
        if !factor.is_finite() {
            factor
        } else if !total.is_finite() {
            total
        } else {
            factor * total
        }
    }
}
