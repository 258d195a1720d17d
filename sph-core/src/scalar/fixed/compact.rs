//! [`Near14`] as the companion of the fixed-point scalars.

use super::near::{FRACTION, Near14};
use super::packed::Packed14;
use super::{Fixed, Format, Overflow, Word};
use crate::scalar::compact::{Compact, NearUnit};

impl<F: Format, O: Overflow> Compact for Fixed<F, O> {
    type Near = Near14;

    #[inline(always)]
    fn offset(self, other: Self) -> Near14 {
        Near14(self.to_bits().near_difference(other.to_bits(), F::FRAC_NBITS, FRACTION))
    }

    #[inline(always)]
    fn from_near(near: Near14) -> Self {
        Self::narrow(F::Bits::from_near(near.0, F::FRAC_NBITS, FRACTION))
    }
}

impl NearUnit for Near14 {
    type Packed<const D: usize> = Packed14<D>;

    /// The signs of all differences in one word: one branch.
    #[inline(always)]
    fn all_between<const D: usize>(x: &[Self; D], low: Self, high: &[Self; D]) -> bool {
        let outside = |bits: i32, axis: usize| bits | (x[axis] - low).0 | (high[axis] - x[axis]).0;
        (0..D).fold(0, outside) >= 0
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self.0) / f64::from(1 << FRACTION)
    }

    #[inline(always)]
    fn floor(self) -> i32 {
        self.0.wrapping_shr(FRACTION)
    }

    /// Rounded once, and right for components below 2.8.
    #[inline(always)]
    fn norm_squared<const D: usize>(v: &[Self; D]) -> Self {
        let squares = v.iter().fold(0_u32, |sum, &Self(n)| sum.wrapping_add(n.wrapping_mul(n) as u32));
        Self(squares.wrapping_shr(FRACTION) as i32)
    }

    #[inline(always)]
    fn clamp_abs(self, limit: Self) -> Self {
        let above = self.0.wrapping_add(limit.0) as u32;
        if above <= limit.0.wrapping_shl(1) as u32 {
            self
        } else if self.0 < 0 {
            -limit
        } else {
            limit
        }
    }

    #[inline(always)]
    fn mul_rounded(self, other: Self) -> Self {
        const HALF: i32 = 1 << (FRACTION - 1);
        Self(self.0.wrapping_mul(other.0).wrapping_add(HALF).wrapping_shr(FRACTION))
    }
}
