//! Numbers near 1 for the pairs of particles of a real-time solver: half the memory, and a product in one machine word.
//!
//! For particles within reach of each other all numbers are small: offsets in units of h, weights and displacements a frame. A float is
//! its own [`NearUnit`]. A fixed-point number becomes an integer count of 2^−14 that is stored in 16 bits and multiplied in 32,
//! where a product of its own format takes a 64-bit one: some fifty instructions on a processor without it.

use super::{Arithmetic, Scalar};
use crate::vector;
use core::fmt::Debug;

/// A scalar with a small companion for values near 1.
pub trait Compact: Scalar {
    /// The companion.
    type Near: NearUnit;

    /// `self − other`, rounded down to the companion's step. Exact in range for two numbers of [0, 2¹⁶) whose difference the
    /// scalar itself can hold; any number for others.
    fn offset(self, other: Self) -> Self::Near;
    /// The number rounded down to the companion's step, within ±2¹⁷: a coordinate.
    #[inline(always)]
    fn near(self) -> Self::Near {
        self.offset(Self::ZERO)
    }
    /// The companion as this scalar.
    fn from_near(near: Self::Near) -> Self;
}

/// A vector of small numbers as it lies in memory, added in one machine word where two components fill one.
pub trait Pack<N, const D: usize>: Copy + Debug + Send + Sync + 'static {
    /// 0
    const ZERO: Self;

    /// The vector; components within ±2.
    fn pack(vector: [N; D]) -> Self;
    /// What [`pack`](Self::pack) packed, as long as sums stay within ±2.
    fn unpack(self) -> [N; D];
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The difference.
    fn minus(self, other: Self) -> Self;
    /// Each component as [`NearUnit::clamp_abs`] clamps it.
    #[inline(always)]
    fn clamped(self, limit: N) -> Self
    where
        N: NearUnit,
    {
        Self::pack(self.unpack().map(|component| component.clamp_abs(limit)))
    }
}

/// A number near 1. Exact bounds are kept by the caller: offsets and factors below 2 in magnitude never overflow, and what
/// overflows wraps without a panic. Sums, differences and comparisons are right up to 2¹⁷, as coordinates need them.
pub trait NearUnit: Arithmetic + PartialOrd + Default + Debug + Send + Sync + 'static {
    /// A vector in memory.
    type Packed<const D: usize>: Pack<Self, D>;

    /// Whether each component lies between `low` and what `high` has for it; false for NaN.
    #[inline(always)]
    fn all_between<const D: usize>(x: &[Self; D], low: Self, high: &[Self; D]) -> bool {
        (0..D).all(|axis| x[axis] >= low && x[axis] <= high[axis])
    }

    /// The number as an f64, exact.
    fn to_f64(self) -> f64;
    /// ⌊x⌋ for x ≥ 0; any number for others.
    fn floor(self) -> i32;

    /// |v|²
    #[inline(always)]
    fn norm_squared<const D: usize>(v: &[Self; D]) -> Self {
        vector::norm_squared(v)
    }

    /// Multiplies and rounds to nearest, where `*` rounds down: for a product that no opposite one cancels the bias of.
    #[inline(always)]
    fn mul_rounded(self, other: Self) -> Self {
        self * other
    }

    /// Clamps to ±`limit`; returns 0 for NaN.
    #[inline(always)]
    fn clamp_abs(self, limit: Self) -> Self {
        if self > limit {
            limit
        } else if self >= -limit {
            self
        } else if self < -limit {
            -limit
        } else {
            Self::ZERO
        }
    }
}

/// Makes a scalar its own companion, as f32 and f64 are: what a scalar of your own needs to run the real-time fluid. It takes the
/// type's parameters in brackets, the type, and its zero.
///
/// ```
/// # use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};
/// # use sph_core::{Accumulator, Arithmetic, Scalar};
/// use sph_core::scalar::compact::{Compact, NearUnit};
///
/// #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
/// struct Mine(f64);
/// // ... its operators, Arithmetic, Scalar and a sum, as the example of `Scalar` has them ...
/// # impl Add for Mine { type Output = Self; fn add(self, other: Self) -> Self { Self(self.0 + other.0) } }
/// # impl Sub for Mine { type Output = Self; fn sub(self, other: Self) -> Self { Self(self.0 - other.0) } }
/// # impl Mul for Mine { type Output = Self; fn mul(self, other: Self) -> Self { Self(self.0 * other.0) } }
/// # impl Div for Mine { type Output = Self; fn div(self, other: Self) -> Self { Self(self.0 / other.0) } }
/// # impl Neg for Mine { type Output = Self; fn neg(self) -> Self { Self(-self.0) } }
/// # impl AddAssign for Mine { fn add_assign(&mut self, other: Self) { self.0 += other.0 } }
/// # impl SubAssign for Mine { fn sub_assign(&mut self, other: Self) { self.0 -= other.0 } }
/// # impl Arithmetic for Mine {
/// #     const ZERO: Self = Self(0.0);
/// #     const ONE: Self = Self(1.0);
/// #     fn ratio(numerator: i32, denominator: i32) -> Self { Self(Arithmetic::ratio(numerator, denominator)) }
/// #     fn positive_part(self) -> Self { Self(self.0.positive_part()) }
/// #     fn times(self, n: i32) -> Self { Self(self.0.times(n)) }
/// # }
/// # impl Scalar for Mine {
/// #     type Sum = Self;
/// #     const NAME: &'static str = "mine";
/// #     const EPSILON: Self = Self(f64::EPSILON);
/// #     const MAX: Self = Self(f64::MAX);
/// #     fn from_f64(value: f64) -> Self { Self(value) }
/// #     fn to_f64(self) -> f64 { self.0 }
/// #     fn sqrt(self) -> Self { Self(Scalar::sqrt(self.0)) }
/// #     fn is_finite(self) -> bool { self.0.is_finite() }
/// #     fn floor_to_i32(self) -> i32 { self.0.floor_to_i32() }
/// #     fn canonical_bits(self) -> u64 { self.0.canonical_bits() }
/// # }
/// # impl Accumulator<Mine> for Mine {
/// #     const ZERO: Self = Self(0.0);
/// #     fn add(&mut self, term: Mine) { self.0 += term.0 }
/// #     fn total(self) -> Mine { self }
/// # }
/// sph_core::own_companion!([] Mine, Mine(0.0));
///
/// assert_eq!(Mine(1.5).offset(Mine(1.0)), Mine(0.5));
/// assert_eq!(NearUnit::to_f64(Mine(0.5)), 0.5);
/// ```
#[macro_export]
macro_rules! own_companion {
    ([$($parameters:tt)*] $Scalar:ty, $zero:expr) => {
        impl<$($parameters)*> $crate::scalar::compact::Compact for $Scalar {
            type Near = Self;

            #[inline(always)]
            #[track_caller]
            fn offset(self, other: Self) -> Self {
                self - other
            }

            #[inline(always)]
            fn from_near(near: Self) -> Self {
                near
            }
        }

        $crate::own_companion!(@pack [$($parameters)*, const DIMENSION: usize] $Scalar, $zero);

        impl<$($parameters)*> $crate::scalar::compact::NearUnit for $Scalar {
            type Packed<const DIMENSION: usize> = [Self; DIMENSION];

            #[inline(always)]
            fn to_f64(self) -> f64 {
                $crate::Scalar::to_f64(self)
            }

            #[inline(always)]
            fn clamp_abs(self, limit: Self) -> Self {
                if $crate::Scalar::abs(self) <= limit {
                    self
                } else if self > limit {
                    limit
                } else if self < -limit {
                    -limit
                } else {
                    $zero
                }
            }

            #[inline(always)]
            fn floor(self) -> i32 {
                $crate::Scalar::split(self, 0).0 as i32
            }
        }
    };
    (@pack [, $($parameters:tt)*] $Scalar:ty, $zero:expr) => {
        $crate::own_companion!(@pack [$($parameters)*] $Scalar, $zero);
    };
    (@pack [$($parameters:tt)*] $Scalar:ty, $zero:expr) => {
        impl<$($parameters)*> $crate::scalar::compact::Pack<$Scalar, DIMENSION> for [$Scalar; DIMENSION] {
            const ZERO: Self = [$zero; DIMENSION];

            #[inline(always)]
            fn pack(vector: Self) -> Self {
                vector
            }

            #[inline(always)]
            fn unpack(self) -> Self {
                self
            }

            #[inline(always)]
            #[track_caller]
            fn plus(self, other: Self) -> Self {
                $crate::vector::add(&self, &other)
            }

            #[inline(always)]
            #[track_caller]
            fn minus(self, other: Self) -> Self {
                $crate::vector::sub(&self, &other)
            }
        }
    };
}

own_companion!([] f32, 0.0);
own_companion!([] f64, 0.0);

#[cfg(feature = "micromath")]
own_companion!([] super::fast::Fast32, super::fast::Fast32(0.0));
