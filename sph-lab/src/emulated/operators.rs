//! The operators, comparison and printing of emulated numbers.

use std::cmp::Ordering;
use std::fmt::{Debug, Display, Formatter};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::exact::{held_sum, is_nar, quotient, rounded, undefined};
use super::{Emulated, Format};
use sph_core::Scalar;

impl Emulated {
    /// A result of two counts, NaR where one of them is.
    fn of_two(self, other: Self, result: impl FnOnce(Format, i128, i128) -> Self) -> Self {
        let format = Format::current();
        let (a, b) = (self.count(format), other.count(format));
        if is_nar(format, a) || is_nar(format, b) {
            return Self::of(undefined(format));
        }
        result(format, a.into(), b.into())
    }
}

impl Add for Emulated {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.of_two(other, |format, a, b| Self::of(held_sum(format, a + b)))
    }
}

impl Sub for Emulated {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.of_two(other, |format, a, b| Self::of(held_sum(format, a - b)))
    }
}

impl Mul for Emulated {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.of_two(other, |format, a, b| {
            Self::narrow(format, rounded(format, a * b, format.fraction_bits()))
        })
    }
}

impl Div for Emulated {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        self.of_two(other, |format, a, b| {
            Self::of_quotient(format, quotient(format, a << format.fraction_bits(), b), a)
        })
    }
}

impl Neg for Emulated {
    type Output = Self;

    fn neg(self) -> Self {
        let format = Format::current();
        let count = self.count(format);
        if is_nar(format, count) { self } else { Self::of(held_sum(format, -i128::from(count))) }
    }
}

crate::assign::assign_operators!([] Emulated);

impl PartialEq for Emulated {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for Emulated {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let format = Format::current();
        let (a, b) = (self.count(format), other.count(format));
        if is_nar(format, a) || is_nar(format, b) { None } else { Some(a.cmp(&b)) }
    }
}

impl Display for Emulated {
    fn fmt(&self, formatter: &mut Formatter) -> std::fmt::Result {
        if self.to_f64().is_nan() { formatter.pad("NaR") } else { Display::fmt(&self.to_f64(), formatter) }
    }
}

impl Debug for Emulated {
    fn fmt(&self, formatter: &mut Formatter) -> std::fmt::Result {
        Display::fmt(self, formatter)
    }
}
