//! The formats: how many bits stand before the binary point and how many behind it.

use super::{Fixed, Sealed, Word, binary64};
use crate::scalar::Table;
use core::fmt::{Debug, Display};

/// Calls a macro with the list of the formats: type, name and description of each, and then with what follows `;`. A new format
/// is one line here.
///
/// ```
/// macro_rules! names {
///     ([$($Format:ident $name:tt $about:tt;)+]) => { [$($name),+] };
/// }
/// assert!(sph_core::for_each_format!(names).contains(&"i16f16"));
/// ```
#[macro_export]
macro_rules! for_each_format {
    ($($callback:tt)::+ $(; $($context:tt)*)?) => {
        $($callback)::+! {
            [
                I4F12 "i4f12" "fixed point, 4 integer and 12 fraction bits, saturating";
                I4F28 "i4f28" "fixed point, 4 integer and 28 fraction bits, saturating";
                I8F24 "i8f24" "fixed point, 8 integer and 24 fraction bits, saturating";
                I12F20 "i12f20" "fixed point, 12 integer and 20 fraction bits, saturating";
                I16F16 "i16f16" "fixed point, 16 integer and 16 fraction bits, saturating";
                I20F12 "i20f12" "fixed point, 20 integer and 12 fraction bits, saturating";
                I16F48 "i16f48" "fixed point, 16 integer and 48 fraction bits, saturating";
                I32F32 "i32f32" "fixed point, 32 integer and 32 fraction bits, saturating";
            ]
            $($($context)*)?
        }
    };
}

/// A signed type of the `fixed` crate that [`Fixed`] can be made of. Sealed: one line of [`for_each_format`](crate::for_each_format)
/// each.
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
    ([$($Format:ident $name:tt $about:tt;)+]) => {$(
        pub use ::fixed::types::$Format;

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

for_each_format!(formats);
