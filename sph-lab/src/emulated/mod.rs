//! Fixed point whose format is chosen when the program runs.
//!
//! A number is an integer count of 2^−F. Products, quotients and sums are exact in 128 bits and rounded once, as sph-core's compiled types
//! round them, so that a format gives here the bits that its compiled type would give.

mod compact;
mod exact;
mod format;
mod operators;
mod random;
mod sum;

pub use format::{Format, FormatError, Overflow, Rounding};
pub use sum::EmulatedSum;

use exact::{held, quotient};
use sph_core::scalar::Table;
use sph_core::{Arithmetic, Scalar};

/// A fixed-point number in the format that is in use on its thread; see [`Format::scope`].
///
/// Equal to the bit to [`Fixed`](sph_core::scalar::fixed::Fixed) where that has the format: sums, products, roots, refusals and
/// the fluid's short numbers. It costs about ten times the instructions of an f64.
///
/// ```
/// use sph_core::Scalar;
/// use sph_core::scalar::fixed::{I16F16, Saturating};
/// use sph_lab::{Emulated, Format};
///
/// let compiled = Saturating::<I16F16>::from_f64(2.0).sqrt();
/// let emulated = Format::new(16, 16)?.scope(|| Emulated::from_f64(2.0).sqrt().to_bits());
/// assert_eq!(emulated, i64::from(compiled.to_bits()));
/// # Ok::<(), sph_lab::FormatError>(())
/// ```
#[derive(Clone, Copy, Default)]
pub struct Emulated(Number);

/// A count of units, or a constant of the trait whose count depends on the format.
#[derive(Clone, Copy)]
enum Number {
    Count(i64),
    One,
    Epsilon,
    Max,
}

impl Default for Number {
    fn default() -> Self {
        Self::Count(0)
    }
}

impl Emulated {
    /// The number whose count of units is `bits`; what the format cannot hold is kept to its low bits.
    #[must_use]
    pub fn from_bits(bits: i64) -> Self {
        Self::of(exact::low_bits(Format::current(), bits.into()))
    }

    /// The count of units.
    #[must_use]
    pub fn to_bits(self) -> i64 {
        self.count(Format::current())
    }

    fn of(count: i64) -> Self {
        Self(Number::Count(count))
    }

    fn count(self, format: Format) -> i64 {
        match self.0 {
            Number::Count(count) => count,
            Number::One => exact::within(format, 1 << format.fraction_bits()),
            Number::Epsilon => 1,
            // a saturated result is never the largest finite one
            Number::Max => exact::max(format) - i64::from(format.overflow() == Overflow::Saturating),
        }
    }

    /// A wide result as a number of the format.
    fn narrow(format: Format, wide: i128) -> Self {
        Self::of(held(format, wide))
    }

    /// The quotient, or where there is none what the sign of the numerator says.
    fn of_quotient(format: Format, quotient: Option<i128>, numerator: i128) -> Self {
        match quotient {
            Some(quotient) => Self::narrow(format, quotient),
            None if numerator == 0 => Self::of(exact::undefined(format)),
            None => Self::of(exact::beyond(format, numerator < 0, 0)),
        }
    }
}

impl Arithmetic for Emulated {
    const ZERO: Self = Self(Number::Count(0));
    const ONE: Self = Self(Number::One);

    fn ratio(numerator: i32, denominator: i32) -> Self {
        let format = Format::current();
        let shifted = i128::from(numerator) << format.fraction_bits();
        Self::of_quotient(format, quotient(format, shifted, denominator.into()), numerator.into())
    }

    fn positive_part(self) -> Self {
        let format = Format::current();
        let count = self.count(format);
        if exact::is_nar(format, count) { self } else { Self::of(count.max(0)) }
    }

    fn times(self, n: i32) -> Self {
        let format = Format::current();
        let count = self.count(format);
        if exact::is_nar(format, count) {
            return self;
        }
        Self::narrow(format, i128::from(count) * i128::from(n))
    }
}

impl Scalar for Emulated {
    type Sum = EmulatedSum;

    const NAME: &'static str = "emulated";
    const EPSILON: Self = Self(Number::Epsilon);
    const MAX: Self = Self(Number::Max);

    fn from_f64(value: f64) -> Self {
        let format = Format::current();
        if value.is_nan() {
            return Self::of(exact::undefined(format));
        }
        let units = value * exact::power_of_two(format.fraction_bits());
        if units.abs() >= exact::power_of_two(63) {
            // of a number of 2¹²⁷ units and more the low 64 bits are zero
            let low_bits = if units.abs() < exact::power_of_two(127) { units as i128 as i64 } else { 0 };
            return Self::of(exact::beyond(format, units < 0.0, low_bits));
        }
        Self::narrow(format, exact::whole(format, units) as i128)
    }

    fn to_f64(self) -> f64 {
        let format = Format::current();
        let count = self.count(format);
        if exact::is_nar(format, count) {
            return f64::NAN;
        }
        count as f64 / exact::power_of_two(format.fraction_bits())
    }

    fn sqrt(self) -> Self {
        let format = Format::current();
        let count = self.count(format);
        if count < 0 {
            return Self::of(exact::undefined(format));
        }
        Self::of(exact::root(format, count))
    }

    fn is_finite(self) -> bool {
        let format = Format::current();
        let count = self.count(format);
        match format.overflow() {
            Overflow::Saturating => count < exact::max(format) && count > -exact::max(format),
            Overflow::Wrapping => true,
            Overflow::Checked => !exact::is_nar(format, count),
        }
    }

    fn floor_to_i32(self) -> i32 {
        let format = Format::current();
        let count = self.count(format);
        if exact::is_nar(format, count) {
            return 0;
        }
        // a shift by 64 has no meaning for 64 bits
        (i128::from(count) >> format.fraction_bits()).clamp(i32::MIN.into(), i32::MAX.into()) as i32
    }

    fn canonical_bits(self) -> u64 {
        let format = Format::current();
        self.count(format) as u64 & (u64::MAX >> (64 - format.bits()))
    }

    fn split(self, bits: u32) -> (usize, Self) {
        let format = Format::current();
        let count = self.count(format);
        let fraction = format.fraction_bits();
        let (below, above) = (fraction.saturating_sub(bits), bits.saturating_sub(fraction));
        let rest = i128::from(count) & ((1 << below) - 1);
        let place = (i128::from(count) >> below) as usize;
        (place.wrapping_shl(above), Self::of(exact::low_bits(format, rest << bits.min(63))))
    }

    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        let format = Format::current();
        let value = C::VALUES.get(row)?.get(i)?;
        let units = (value * exact::power_of_two(format.fraction_bits())).round();
        Some(Self::of(exact::within(format, units as i128)))
    }
}
