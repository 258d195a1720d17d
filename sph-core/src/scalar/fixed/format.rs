//! The formats: how many bits stand before the binary point and how many behind it.

use super::{Fixed, Sealed, Word, binary64};
use crate::scalar::Table;
use core::fmt::{Debug, Display};

pub use ::fixed::types::{I4F12, I4F28, I8F24, I12F20, I16F16, I16F48, I20F12, I32F32};

/// A signed type of the `fixed` crate that [`Fixed`] can be made of. Sealed: one line of the table in this file each.
pub trait Format: ::fixed::traits::FixedSigned<Bits: Word> + Debug + Display + Send + Sync + Sealed {
    /// 1
    const ONE: Self;
    /// One unit below the largest number.
    const BELOW_MAX: Self;
    /// Number i of a table's row, rounded to nearest when the program is compiled.
    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self>;
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

            #[inline(always)]
            fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(
                row: usize,
                i: usize,
            ) -> Option<Self> {
                let table: &'static [[Self; N]; ROWS] = const {
                    let mut table = [[Self::ZERO; N]; ROWS];
                    let mut i = 0;
                    while i < ROWS * N {
                        table[i / N][i % N] = Self::from_bits(binary64::literal(C::VALUES[i / N][i % N], Self::FRAC_NBITS) as _);
                        i += 1;
                    }
                    &{ table }
                };
                table.get(row)?.get(i).copied()
            }
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
