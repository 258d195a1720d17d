//! The operators, comparison and printing of fixed-point numbers.

use super::{Fixed, Format, Overflow, Word};
use core::cmp::Ordering;
use core::fmt::{Debug, Display, Formatter};
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

impl<F: Format, O: Overflow> Add for Fixed<F, O> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(O::add(self.value, other.value))
    }
}

impl<F: Format, O: Overflow> Sub for Fixed<F, O> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(O::subtract(self.value, other.value))
    }
}

impl<F: Format, O: Overflow> Mul for Fixed<F, O> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        if self.is_nar() || other.is_nar() {
            return Self::new(O::undefined());
        }
        Self::narrow(self.to_bits().product(other.to_bits(), F::FRAC_NBITS))
    }
}

impl<F: Format, O: Overflow> Div for Fixed<F, O> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        if self.is_nar() || other.is_nar() {
            return Self::new(O::undefined());
        }
        let quotient = self.to_bits().divided(other.to_bits(), F::FRAC_NBITS);
        Self::quotient(quotient, self.value.cmp(&F::ZERO))
    }
}

impl<F: Format, O: Overflow> Neg for Fixed<F, O> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(O::negate(self.value))
    }
}

impl<F: Format, O: Overflow> AddAssign for Fixed<F, O> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<F: Format, O: Overflow> SubAssign for Fixed<F, O> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<F: Format, O: Overflow> PartialEq for Fixed<F, O> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value && !self.is_nar()
    }
}

impl<F: Format, O: Overflow> PartialOrd for Fixed<F, O> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self.is_nar() || other.is_nar() { None } else { Some(self.value.cmp(&other.value)) }
    }
}

impl<F, O> From<F> for Fixed<F, O> {
    #[inline(always)]
    fn from(value: F) -> Self {
        Self::new(value)
    }
}

impl<F: Format, O: Overflow> Display for Fixed<F, O> {
    fn fmt(&self, formatter: &mut Formatter) -> core::fmt::Result {
        if self.is_nar() { formatter.pad("NaR") } else { Display::fmt(&self.value, formatter) }
    }
}

impl<F: Format, O: Overflow> Debug for Fixed<F, O> {
    fn fmt(&self, formatter: &mut Formatter) -> core::fmt::Result {
        Display::fmt(self, formatter)
    }
}

/// The decimal value: the host formats it, the target sends 8 bytes.
#[cfg(feature = "defmt")]
impl<F: Format, O: Overflow> defmt::Format for Fixed<F, O> {
    fn format(&self, formatter: defmt::Formatter) {
        if self.is_nar() {
            defmt::write!(formatter, "NaR");
        } else {
            defmt::write!(formatter, "{=f64}", crate::Scalar::to_f64(*self));
        }
    }
}
