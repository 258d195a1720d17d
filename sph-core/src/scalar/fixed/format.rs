//! The formats: how many bits stand before the binary point and how many behind it.

use super::{Fixed, Sealed, Word};
use core::fmt::{Debug, Display};

pub use ::fixed::types::{I4F12, I4F28, I8F24, I12F20, I16F16, I16F48, I20F12, I32F32};

/// A signed type of the `fixed` crate that [`Fixed`] can be made of. Sealed: one line of the table in this file each.
pub trait Format: ::fixed::traits::FixedSigned<Bits: Word> + Debug + Display + Send + Sync + Sealed {
    /// 1
    const ONE: Self;
    /// One unit below the largest number.
    const BELOW_MAX: Self;
    /// The names of the saturating, the wrapping and the checked scalar.
    const NAMES: [&'static str; 3];
}

macro_rules! formats {
    ($($Format:ident $name:literal),+ $(,)?) => {$(
        impl Sealed for $Format {}

        impl Format for $Format {
            const ONE: Self = Self::ONE;
            const BELOW_MAX: Self = Self::from_bits(Self::MAX.to_bits() - 1);
            const NAMES: [&'static str; 3] =
                [$name, concat!("wrapping-", $name), concat!("checked-", $name)];
        }

        impl<O> From<Fixed<$Format, O>> for $Format {
            fn from(number: Fixed<$Format, O>) -> Self {
                number.get()
            }
        }
    )+};
}

formats! {
    I4F12 "i4f12",
    I4F28 "i4f28",
    I8F24 "i8f24",
    I12F20 "i12f20",
    I16F16 "i16f16",
    I20F12 "i20f12",
    I16F48 "i16f48",
    I32F32 "i32f32",
}
