//! A number near 1 as a count of 2^−14: the arithmetic.

use super::Word;
use crate::Arithmetic;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Bits behind the binary point.
pub(super) const FRACTION: u32 = 14;
/// An integer count of 2^−14 in 32 bits; see [`compact`](crate::scalar::compact). `*` rounds down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(transparent)]
pub struct Near14(pub(super) i32);

impl Arithmetic for Near14 {
    const ZERO: Self = Self(0);
    const ONE: Self = Self(1 << FRACTION);

    #[inline(always)]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        let numerator = i64::from(numerator).wrapping_shl(FRACTION);
        Self(i32::quotient(numerator, denominator.into()).unwrap_or(0) as i32)
    }

    #[inline(always)]
    fn positive_part(self) -> Self {
        Self(self.0 & !self.0.wrapping_shr(31))
    }

    #[inline(always)]
    fn times(self, n: i32) -> Self {
        Self(self.0.wrapping_mul(n))
    }
}

impl Add for Near14 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl Sub for Near14 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0.wrapping_sub(other.0))
    }
}

impl Mul for Near14 {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0.wrapping_mul(other.0).wrapping_shr(FRACTION))
    }
}

/// Rounded to nearest, ties away from zero; 0 for a divisor of 0.
impl Div for Near14 {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self::ratio(self.0, other.0)
    }
}

impl Neg for Near14 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.wrapping_neg())
    }
}

impl AddAssign for Near14 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Near14 {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
