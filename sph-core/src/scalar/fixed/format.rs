//! The formats: how many bits stand before the binary point and how many behind it.

use super::{Fixed, Sealed, Word, binary64};
use crate::scalar::Table;
use ::fixed::types::extra::{LeEqU8, LeEqU16, LeEqU32, LeEqU64};
use ::fixed::{FixedI8, FixedI16, FixedI32, FixedI64};
use core::fmt::{Debug, Display};

/// Calls a macro with the list of the formats that are shown and tested by name everywhere: type, name and description of each, and
/// then with what follows `;`. A new one is one line here; every other split of 8, 16, 32 or 64 bits is a [`Format`](crate::scalar::fixed::Format) as well.
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

macro_rules! exported {
    ([$($Format:ident $name:tt $about:tt;)+]) => { pub use ::fixed::types::{$($Format),+}; };
}
for_each_format!(exported);

/// A signed type of the `fixed` crate that [`Fixed`] can be made of: every split of 8, 16, 32 or 64 bits that leaves an integer bit,
/// which is the sign. [`types`](super::types) has their names. Sealed.
///
/// ```
/// use sph_core::Scalar;
/// use sph_core::scalar::fixed::{Saturating, types::I3F13};
/// type Real = Saturating<I3F13>;
/// assert_eq!(Real::NAME, "i3f13");
/// assert_eq!(Real::from_f64(5.0).to_f64(), 4.0 - 1.0 / 8192.0);
/// ```
///
/// A split without an integer bit does not compile:
///
/// ```compile_fail
/// # use sph_core::Arithmetic;
/// use sph_core::scalar::fixed::{Saturating, types::I0F16};
/// let one = Saturating::<I0F16>::ONE;
/// ```
pub trait Format: ::fixed::traits::FixedSigned<Bits: Word> + Debug + Display + Send + Sync + Sealed {
    /// 1, and the largest number where the format ends below it, as those of one integer bit do.
    const ONE: Self;
    /// One unit below the largest number.
    const BELOW_MAX: Self;
    /// Number i of a table's row, rounded to nearest when the program is compiled.
    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self>;
    /// The names of the saturating, the wrapping and the checked scalar.
    const NAMES: [&'static str; 3];
}

macro_rules! formats {
    ($($Fixed:ident of $Word:ty: $Fraction:ident;)+) => {$(
        impl<F: $Fraction> Sealed for $Fixed<F> {}

        impl<F: $Fraction + Send + Sync> Format for $Fixed<F> {
            const ONE: Self = {
                assert!(F::U32 < <$Word>::BITS, "expected at least 1 integer bit, which is the sign");
                if F::U32 + 1 < <$Word>::BITS { Self::from_bits(1 << F::U32) } else { Self::MAX }
            };
            const BELOW_MAX: Self = Self::from_bits(<$Word>::MAX - 1);
            const NAMES: [&'static str; 3] = [
                const { &Name::new("", <$Word>::BITS - F::U32, F::U32) }.as_str(),
                const { &Name::new("wrapping-", <$Word>::BITS - F::U32, F::U32) }.as_str(),
                const { &Name::new("checked-", <$Word>::BITS - F::U32, F::U32) }.as_str(),
            ];

            #[inline(always)]
            fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(
                row: usize,
                i: usize,
            ) -> Option<Self> {
                let table: &'static [[Self; N]; ROWS] = const {
                    let mut table = [[Self::ZERO; N]; ROWS];
                    let mut i = 0;
                    while i < ROWS * N {
                        let count = binary64::literal(C::VALUES[i / N][i % N], F::U32);
                        table[i / N][i % N] = Self::from_bits(within(count, <$Word>::MAX as i64) as $Word);
                        i += 1;
                    }
                    &{ table }
                };
                table.get(row)?.get(i).copied()
            }
        }

        impl<F: $Fraction, O> From<Fixed<$Fixed<F>, O>> for $Fixed<F> {
            fn from(number: Fixed<$Fixed<F>, O>) -> Self {
                number.get()
            }
        }
    )+};
}

formats! {
    FixedI8 of i8: LeEqU8;
    FixedI16 of i16: LeEqU16;
    FixedI32 of i32: LeEqU32;
    FixedI64 of i64: LeEqU64;
}

/// The count, held at −`max` and `max`: ±1 in a format that ends below it.
const fn within(count: i64, max: i64) -> i64 {
    if count > max {
        max
    } else if count < -max {
        -max
    } else {
        count
    }
}

/// A scalar's name, put together when the program is compiled.
struct Name {
    letters: [u8; 16],
    length: usize,
}

impl Name {
    const fn new(mode: &str, integer_bits: u32, fraction_bits: u32) -> Self {
        let mut name = Self { letters: [0; 16], length: 0 };
        let mut i = 0;
        while i < mode.len() {
            name = name.with(mode.as_bytes()[i]);
            i += 1;
        }
        name.with(b'i').with_number(integer_bits).with(b'f').with_number(fraction_bits)
    }

    const fn with(mut self, letter: u8) -> Self {
        self.letters[self.length] = letter;
        self.length += 1;
        self
    }

    const fn with_number(self, number: u32) -> Self {
        let last = b'0' + (number % 10) as u8;
        if number < 10 { self.with(last) } else { self.with(b'0' + (number / 10) as u8).with(last) }
    }

    const fn as_str(&self) -> &str {
        match core::str::from_utf8(self.letters.split_at(self.length).0) {
            Ok(name) => name,
            Err(_) => unreachable!(),
        }
    }
}
