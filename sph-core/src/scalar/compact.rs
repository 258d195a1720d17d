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
}

/// A number near 1. Exact bounds are kept by the caller: offsets and factors below 2 in magnitude never overflow, and what
/// overflows wraps without a panic. Sums, differences and comparisons are right up to 2¹⁷, as coordinates need them.
pub trait NearUnit: Arithmetic + PartialOrd + Default + Debug + Send + Sync + 'static {
    /// The form in memory.
    type Stored: Copy + Debug + Send + Sync + 'static;
    /// A vector in memory.
    type Packed<const D: usize>: Pack<Self, D>;

    /// Zero as [`store`](Self::store) stores it.
    const STORED_ZERO: Self::Stored;
    /// Zero as [`store_weight`](Self::store_weight) stores it.
    const NO_WEIGHT: Self::Stored;

    /// Whether each component lies between `low` and what `high` has for it; false for NaN.
    #[inline(always)]
    fn all_between<const D: usize>(x: &[Self; D], low: Self, high: &[Self; D]) -> bool {
        (0..D).all(|axis| x[axis] >= low && x[axis] <= high[axis])
    }

    /// ⌊x⌋; 0 for NaN.
    fn floor(self) -> i32;
    /// Returns the form in memory; fixed point is clamped to ±2.
    fn store(self) -> Self::Stored;
    /// As [`store`](Self::store) for what is known to lie within ±2; the low bits of what does not.
    fn store_low(self) -> Self::Stored;
    /// What [`store`](Self::store) stored.
    fn load(stored: Self::Stored) -> Self;
    /// A sum of weights below 32, in steps of 2^−11 in fixed point.
    fn store_weight(self) -> Self::Stored;
    /// What [`store_weight`](Self::store_weight) stored.
    fn load_weight(stored: Self::Stored) -> Self;

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

macro_rules! float {
    ($($Float:ty: $zero:expr),+) => {$(
        impl Compact for $Float {
            type Near = Self;

            #[inline(always)]
            fn offset(self, other: Self) -> Self {
                self - other
            }

            #[inline(always)]
            fn from_near(near: Self) -> Self {
                near
            }
        }

        impl<const D: usize> Pack<$Float, D> for [$Float; D] {
            const ZERO: Self = [$zero; D];

            #[inline(always)]
            fn pack(vector: Self) -> Self {
                vector
            }

            #[inline(always)]
            fn unpack(self) -> Self {
                self
            }

            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                vector::add(&self, &other)
            }

            #[inline(always)]
            fn minus(self, other: Self) -> Self {
                vector::sub(&self, &other)
            }
        }

        impl NearUnit for $Float {
            type Stored = Self;
            type Packed<const D: usize> = [Self; D];

            const STORED_ZERO: Self = $zero;
            const NO_WEIGHT: Self = $zero;

            #[inline(always)]
            fn clamp_abs(self, limit: Self) -> Self {
                if self.abs() <= limit {
                    self
                } else if self > limit {
                    limit
                } else if self < -limit {
                    -limit
                } else {
                    Self::ZERO
                }
            }

            #[inline(always)]
            fn floor(self) -> i32 {
                self.floor_to_i32()
            }

            #[inline(always)]
            fn store(self) -> Self {
                self
            }

            #[inline(always)]
            fn store_low(self) -> Self {
                self
            }

            #[inline(always)]
            fn load(stored: Self) -> Self {
                stored
            }

            #[inline(always)]
            fn store_weight(self) -> Self {
                self
            }

            #[inline(always)]
            fn load_weight(stored: Self) -> Self {
                stored
            }
        }
    )+};
}

float!(f32: 0.0, f64: 0.0);

#[cfg(feature = "micromath")]
float!(super::fast::Fast32: super::fast::Fast32(0.0));
