//! The operators, comparison and printing of emulated numbers.

use std::cmp::Ordering;
use std::fmt::{Debug, Display, Formatter};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::exact::{
    held_narrow, held_narrow_sum, held_sum, is_nar, quotient, rounded, rounded_narrow, undefined,
};
use super::{Emulated, Format};
use sph_core::Scalar;

impl Emulated {
    /// A result of two counts, NaR where one of them is.
    fn of_two(self, other: Self, result: impl FnOnce(Format, i64, i64) -> Self) -> Self {
        let format = Format::current();
        let (a, b) = (self.count(format), other.count(format));
        if is_nar(format, a) || is_nar(format, b) {
            return Self::of(undefined(format));
        }
        result(format, a, b)
    }

    /// Sums of two counts of up to 32 bits need no more than 64.
    fn of_sum(format: Format, a: i64, b: i64) -> Self {
        Self::of(if format.is_narrow() {
            held_narrow_sum(format, a + b)
        } else {
            held_sum(format, i128::from(a) + i128::from(b))
        })
    }

    fn of_difference(format: Format, a: i64, b: i64) -> Self {
        Self::of(if format.is_narrow() {
            held_narrow_sum(format, a - b)
        } else {
            held_sum(format, i128::from(a) - i128::from(b))
        })
    }
}

impl Add for Emulated {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.of_two(other, Self::of_sum)
    }
}

impl Sub for Emulated {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.of_two(other, Self::of_difference)
    }
}

impl Mul for Emulated {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.of_two(other, |format, a, b| {
            if format.is_narrow() {
                return Self::of(held_narrow(format, rounded_narrow(format, a * b)));
            }
            let product = i128::from(a) * i128::from(b);
            Self::narrow(format, rounded(format, product, format.fraction_bits()))
        })
    }
}

impl Div for Emulated {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        self.of_two(other, |format, a, b| {
            let shifted = i128::from(a) << format.fraction_bits();
            Self::of_quotient(format, quotient(format, shifted, b.into()), a.into())
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
