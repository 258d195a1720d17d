//! A format, and the one that is in use on a thread.

use std::cell::Cell;
use std::fmt::{Display, Formatter};
use std::str::FromStr;

use thiserror::Error;

use super::random;

/// How a result between two numbers of the format becomes one of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// To the nearest, ties away from zero, as sph-core's compiled types do.
    #[default]
    Nearest,
    /// Towards −∞: what a bare shift does.
    Floor,
    /// Towards zero.
    TowardZero,
    /// Up or down, by chance, so that the mean is the exact result. The chances begin anew with the seed where the format comes into
    /// use, so that the same work gives the same bits.
    Stochastic {
        /// What the chances begin with.
        seed: u32,
    },
}

/// What becomes of a result that is out of range; see [`sph_core::scalar::fixed`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overflow {
    /// The nearest end of the range.
    #[default]
    Saturating,
    /// The low bits.
    Wrapping,
    /// NaR, not a real, which every later operation keeps.
    Checked,
}

/// A fixed-point format: a number is a count of 2^−F in I + F bits, the sign among the I.
///
/// ```
/// use sph_lab::{Format, Overflow};
/// let format: Format = "wrapping-i3f13".parse()?;
/// assert_eq!((format.integer_bits(), format.fraction_bits()), (3, 13));
/// assert_eq!(format.overflow(), Overflow::Wrapping);
/// assert_eq!(format.to_string(), "wrapping-i3f13");
/// assert_eq!(Format::new(0, 16).unwrap_err().to_string(), "i0f16: expected at least 1 integer bit, which is the sign");
/// # Ok::<(), sph_lab::FormatError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    integer_bits: u32,
    fraction_bits: u32,
    rounding: Rounding,
    overflow: Overflow,
}

/// Why there is no such format.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FormatError {
    /// No room for the sign.
    #[error("i{integer_bits}f{fraction_bits}: expected at least 1 integer bit, which is the sign")]
    NoIntegerBit {
        /// What was asked for.
        integer_bits: u32,
        /// What was asked for.
        fraction_bits: u32,
    },
    /// Fewer bits than 8, or more than 64.
    #[error("i{integer_bits}f{fraction_bits}: expected 8 to 64 bits together")]
    Bits {
        /// What was asked for.
        integer_bits: u32,
        /// What was asked for.
        fraction_bits: u32,
    },
    /// A name that is none.
    #[error("{0}: expected a format such as i16f16, with 8 to 64 bits together")]
    Name(String),
    /// A name of no rounding.
    #[error("{0}: expected nearest, floor, zero or stochastic")]
    Rounding(String),
    /// A name of no answer to overflow.
    #[error("{0}: expected saturating, wrapping or checked")]
    Overflow(String),
}

macro_rules! names {
    ($Type:ident { $($pattern:pat => $value:expr, $name:literal;)+ }) => {
        impl Display for $Type {
            fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
                f.pad(match self {
                    $($pattern => $name,)+
                })
            }
        }

        impl FromStr for $Type {
            type Err = FormatError;

            fn from_str(name: &str) -> Result<Self, FormatError> {
                match name {
                    $($name => Ok($value),)+
                    _ => Err(FormatError::$Type(name.to_owned())),
                }
            }
        }
    };
}
names! {
    Rounding {
        Self::Nearest => Self::Nearest, "nearest";
        Self::Floor => Self::Floor, "floor";
        Self::TowardZero => Self::TowardZero, "zero";
        Self::Stochastic { .. } => Self::Stochastic { seed: 0 }, "stochastic";
    }
}
names! {
    Overflow {
        Self::Saturating => Self::Saturating, "saturating";
        Self::Wrapping => Self::Wrapping, "wrapping";
        Self::Checked => Self::Checked, "checked";
    }
}

thread_local! {
    static CURRENT: Cell<Format> = const { Cell::new(Format::COMMON) };
}

impl Format {
    /// 16 integer and 16 fraction bits: what a thread begins with.
    const COMMON: Self = Self {
        integer_bits: 16,
        fraction_bits: 16,
        rounding: Rounding::Nearest,
        overflow: Overflow::Saturating,
    };

    /// So many bits before the binary point, the sign among them, and so many behind it; rounded to nearest, saturating.
    ///
    /// # Errors
    /// [`FormatError`] where there is no integer bit, or fewer than 8 or more than 64 bits together.
    pub const fn new(integer_bits: u32, fraction_bits: u32) -> Result<Self, FormatError> {
        if integer_bits == 0 {
            return Err(FormatError::NoIntegerBit { integer_bits, fraction_bits });
        }
        match integer_bits.checked_add(fraction_bits) {
            Some(8..=64) => Ok(Self { integer_bits, fraction_bits, ..Self::COMMON }),
            _ => Err(FormatError::Bits { integer_bits, fraction_bits }),
        }
    }

    /// The same, rounded in another way.
    #[must_use]
    pub const fn with_rounding(self, rounding: Rounding) -> Self {
        Self { rounding, ..self }
    }

    /// The same, with another answer to results that are out of range.
    #[must_use]
    pub const fn with_overflow(self, overflow: Overflow) -> Self {
        Self { overflow, ..self }
    }

    /// Bits before the binary point, the sign among them.
    #[must_use]
    pub const fn integer_bits(self) -> u32 {
        self.integer_bits
    }

    /// Bits behind the binary point.
    #[must_use]
    pub const fn fraction_bits(self) -> u32 {
        self.fraction_bits
    }

    /// All bits.
    #[must_use]
    pub const fn bits(self) -> u32 {
        self.integer_bits + self.fraction_bits
    }

    /// Whether 64 bits hold the product of two numbers, with a unit more.
    #[inline]
    pub(super) const fn is_narrow(self) -> bool {
        self.bits() <= 32
    }

    /// How results are rounded.
    #[must_use]
    pub const fn rounding(self) -> Rounding {
        self.rounding
    }

    /// What becomes of results that are out of range.
    #[must_use]
    pub const fn overflow(self) -> Overflow {
        self.overflow
    }

    /// The format in use on this thread.
    #[must_use]
    pub fn current() -> Self {
        CURRENT.get()
    }

    /// Does some work with this format in use on this thread. The format before it is in use again afterwards, after a panic too.
    ///
    /// Numbers do not remember their format: those of one scope mean nothing in another.
    pub fn scope<R>(self, work: impl FnOnce() -> R) -> R {
        struct Restore(Format, u64);
        impl Drop for Restore {
            fn drop(&mut self) {
                CURRENT.set(self.0);
                random::seed(self.1);
            }
        }
        let _before = Restore(Self::current(), random::state());
        self.enter();
        work()
    }

    /// Uses this format on this thread from now on: what each thread of a pool does when it starts.
    pub fn enter(self) {
        CURRENT.set(self);
        if let Rounding::Stochastic { seed } = self.rounding {
            random::seed(seed.into());
        }
    }
}

impl Display for Format {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let mode = match self.overflow {
            Overflow::Saturating => "",
            Overflow::Wrapping => "wrapping-",
            Overflow::Checked => "checked-",
        };
        f.pad(&format!("{mode}i{}f{}", self.integer_bits, self.fraction_bits))
    }
}

/// The names of sph-core's compiled types: `i16f16`, `wrapping-i16f16`, `checked-i16f16`.
impl FromStr for Format {
    type Err = FormatError;

    fn from_str(name: &str) -> Result<Self, FormatError> {
        let modes = [("wrapping-", Overflow::Wrapping), ("checked-", Overflow::Checked)];
        let (overflow, rest) = modes
            .iter()
            .find_map(|&(prefix, mode)| Some((mode, name.strip_prefix(prefix)?)))
            .unwrap_or((Overflow::Saturating, name));
        let is_number = |digits: &str| digits.bytes().all(|digit| digit.is_ascii_digit());
        let bits = rest.strip_prefix('i').and_then(|rest| rest.split_once('f'));
        let bits = bits.filter(|(integer, fraction)| is_number(integer) && is_number(fraction));
        let bits = bits.and_then(|(integer, fraction)| Some((integer.parse().ok()?, fraction.parse().ok()?)));
        let (integer, fraction) = bits.ok_or_else(|| FormatError::Name(name.to_owned()))?;
        Ok(Self::new(integer, fraction)?.with_overflow(overflow))
    }
}
