//! A format of few bits with a floating point, and the one that is in use on a thread.

use std::cell::Cell;
use std::fmt::{Display, Formatter};
use std::str::FromStr;

use thiserror::Error;

/// A format of 16 bits with a floating point.
///
/// ```
/// use sph_lab::MiniFormat;
/// assert_eq!("posit16".parse(), Ok(MiniFormat::POSIT16));
/// assert_eq!(MiniFormat::F16.to_string(), "f16");
/// assert!("f8".parse::<MiniFormat>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MiniFormat(pub(super) Kind);

/// How bits become a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// IEEE 754: so many bits of the significand, the hidden one included, and the exponents of normal numbers.
    Float { significand: i32, least: i32, most: i32 },
    /// A posit of 16 bits with so many exponent bits.
    Posit { exponent_bits: u32 },
}

/// A name that is none.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}: expected f16, bf16 or posit16")]
pub struct MiniFormatError(String);

thread_local! {
    static CURRENT: Cell<MiniFormat> = const { Cell::new(MiniFormat::F16) };
}

impl MiniFormat {
    /// IEEE 754 binary16: 11 significant bits, 6·10⁻⁸ to 65504. What a thread begins with.
    pub const F16: Self = Self(Kind::Float { significand: 11, least: -14, most: 15 });
    /// The upper half of an f32: 8 significant bits, the range of f32.
    pub const BF16: Self = Self(Kind::Float { significand: 8, least: -126, most: 127 });
    /// A posit of 16 bits with one exponent bit (J. L. Gustafson, I. Yonemoto, *Beating floating point at its own game*, 2017): up to 13
    /// significant bits near 1, 4·10⁻⁹ to 2.7·10⁸.
    pub const POSIT16: Self = Self(Kind::Posit { exponent_bits: 1 });
    /// A posit of 16 bits with two exponent bits, as the standard of 2022 has it: up to 12 significant bits near 1, 10⁻¹⁷ to 10¹⁷.
    pub const POSIT16_2022: Self = Self(Kind::Posit { exponent_bits: 2 });
    /// All of them.
    pub const ALL: [Self; 4] = [Self::F16, Self::BF16, Self::POSIT16, Self::POSIT16_2022];

    /// All bits of a number.
    #[must_use]
    pub const fn bits(self) -> u32 {
        16
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
        struct Restore(MiniFormat);
        impl Drop for Restore {
            fn drop(&mut self) {
                CURRENT.set(self.0);
            }
        }
        let _before = Restore(CURRENT.replace(self));
        work()
    }

    /// Uses this format on this thread from now on: what each thread of a pool does when it starts.
    pub fn enter(self) {
        CURRENT.set(self);
    }
}

impl Display for MiniFormat {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.pad(match *self {
            Self::F16 => "f16",
            Self::BF16 => "bf16",
            Self::POSIT16 => "posit16",
            _ => "posit16-2022",
        })
    }
}

/// By the names that [`Display`] gives.
impl FromStr for MiniFormat {
    type Err = MiniFormatError;

    fn from_str(name: &str) -> Result<Self, MiniFormatError> {
        let known = Self::ALL.into_iter().find(|format| format.to_string() == name);
        known.ok_or_else(|| MiniFormatError(name.to_owned()))
    }
}
