//! Floating point of 16 bits whose format is chosen when the program runs.
//!
//! A number is held as an f64. Each result is the f64's, rounded once more: with p ≤ 24 significant bits that is the result rounded once,
//! since 53 ≥ 2p + 2 (S. A. Figueroa, *When is double rounding innocuous?*, SIGNUM 1995).

mod bits;
mod format;

pub use format::{MiniFormat, MiniFormatError};

use std::cmp::Ordering;
use std::fmt::{Debug, Display, Formatter};
use std::ops::{Add, Div, Mul, Neg, Sub};

use sph_core::{Accumulator, Arithmetic, Scalar};

/// A number in the format of 16 bits that is in use on its thread; see [`MiniFormat::scope`].
///
/// f16 and bf16 overflow to infinity and round to even as IEEE 754 says, subnormal numbers included. A posit ends at its largest number
/// and never rounds to 0; what no number is becomes NaR, which is a NaN here. A sum is gathered in f64 and rounded once.
///
/// ```
/// use sph_core::Scalar;
/// use sph_lab::{Mini, MiniFormat};
///
/// let third = |format: MiniFormat| format.scope(|| (Mini::from_f64(1.0) / Mini::from_f64(3.0)).to_bits());
/// assert_eq!(third(MiniFormat::F16), 0x3555);
/// assert_eq!(third(MiniFormat::BF16), 0x3eab);
/// assert_eq!(third(MiniFormat::POSIT16), 0x2555);
/// ```
#[derive(Clone, Copy, Default)]
pub struct Mini(Number);

/// A value, or a constant of the trait whose value depends on the format.
#[derive(Clone, Copy)]
enum Number {
    Value(f64),
    Epsilon,
    Max,
}

impl Default for Number {
    fn default() -> Self {
        Self::Value(0.0)
    }
}

impl Mini {
    /// The number whose bits these are.
    #[must_use]
    pub fn from_bits(bits: u16) -> Self {
        Self(Number::Value(bits::from_bits(MiniFormat::current(), bits)))
    }

    /// Its 16 bits.
    #[must_use]
    pub fn to_bits(self) -> u16 {
        bits::to_bits(MiniFormat::current(), self.value())
    }

    /// The number nearest to x.
    #[inline]
    fn nearest(x: f64) -> Self {
        Self(Number::Value(bits::rounded(MiniFormat::current(), x)))
    }

    #[inline]
    fn value(self) -> f64 {
        match self.0 {
            Number::Value(value) => value,
            Number::Epsilon => bits::epsilon(MiniFormat::current()),
            Number::Max => bits::largest(MiniFormat::current()),
        }
    }
}

macro_rules! operators {
    ($($Trait:ident $method:ident $sign:tt;)+) => {$(
        impl $Trait for Mini {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                Self::nearest(self.value() $sign other.value())
            }
        }
    )+};
}
operators! {
    Add add +;
    Sub sub -;
    Mul mul *;
    Div div /;
}
crate::assign::assign_operators!([] Mini);
sph_core::own_companion!([] Mini, Mini(Number::Value(0.0)));

impl Neg for Mini {
    type Output = Self;

    fn neg(self) -> Self {
        Self(Number::Value(-self.value()))
    }
}

impl PartialEq for Mini {
    fn eq(&self, other: &Self) -> bool {
        self.value() == other.value()
    }
}

impl PartialOrd for Mini {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value().partial_cmp(&other.value())
    }
}

impl Arithmetic for Mini {
    const ZERO: Self = Self(Number::Value(0.0));
    const ONE: Self = Self(Number::Value(1.0));

    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::nearest(f64::from(numerator) / f64::from(denominator))
    }

    fn positive_part(self) -> Self {
        Self(Number::Value(self.value().positive_part()))
    }

    fn times(self, n: i32) -> Self {
        Self::nearest(self.value() * f64::from(n))
    }
}

impl Scalar for Mini {
    type Sum = MiniSum;

    const NAME: &'static str = "mini";
    const EPSILON: Self = Self(Number::Epsilon);
    const MAX: Self = Self(Number::Max);

    fn from_f64(value: f64) -> Self {
        Self::nearest(value)
    }

    fn to_f64(self) -> f64 {
        self.value()
    }

    fn sqrt(self) -> Self {
        Self::nearest(self.value().sqrt())
    }

    fn is_finite(self) -> bool {
        self.value().is_finite()
    }

    fn floor_to_i32(self) -> i32 {
        self.value().floor_to_i32()
    }

    /// −0 as 0, every NaN alike.
    fn canonical_bits(self) -> u64 {
        let value = self.value();
        let canonical = if value == 0.0 {
            0.0
        } else if value.is_nan() {
            f64::NAN
        } else {
            value
        };
        bits::to_bits(MiniFormat::current(), canonical).into()
    }
}

impl Debug for Mini {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        Display::fmt(self, f)
    }
}

impl Display for Mini {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        Display::fmt(&self.value(), f)
    }
}

/// A sum in f64 that is rounded once, in `total`.
#[derive(Clone, Copy, Debug)]
pub struct MiniSum(f64);

impl Accumulator<Mini> for MiniSum {
    const ZERO: Self = Self(0.0);

    fn add(&mut self, term: Mini) {
        self.0 += term.value();
    }

    fn total(self) -> Mini {
        Mini::nearest(self.0)
    }

    fn scaled_total(self, a: Mini, b: Mini) -> Mini {
        Mini::nearest(a.value() * (b.value() * self.0))
    }
}
