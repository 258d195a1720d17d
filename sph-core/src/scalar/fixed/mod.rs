//! Fixed point over the types of the `fixed` crate; a type parameter says what overflow does.
//!
//! A number is an integer count of 2^−FRAC. [`Saturating<I16F16>`](Saturating), [`Wrapping<I8F24>`](Wrapping) and
//! [`Checked<I32F32>`](Checked) are all a [`Fixed`]; each is as large as the integer in it, and none ever panics.
//!
//! | | overflow | x/0 | 0/0, √−1, NaN | `is_finite` |
//! |---|---|---|---|---|
//! | [`Saturating`] | ±MAX | ±MAX by the sign of x | 0 | false at ±MAX and beyond |
//! | [`Checked`] | NaR | NaR | NaR | false for NaR, which stays NaR |
//! | [`Wrapping`] | the low bits | 0 | 0 | always true |
//!
//! Products, quotients, literals and conversions are exact in a wider integer and rounded once, to nearest, ties away from
//! zero: (−a)·b is −(a·b) to the bit for every a but the most negative pattern, which has no opposite. Square roots are
//! rounded to nearest: within half a unit. Sums ([`Sum`]) are exact and narrowed once, at their end.
//!
//! One computation in the three modes, 200 · 200 where the largest number is just under 32768:
//!
//! ```
//! use sph_core::Scalar;
//! use sph_core::scalar::fixed::{Checked, I16F16, Saturating, Wrapping};
//!
//! let held = Saturating::<I16F16>::from_f64(200.0);
//! assert_eq!((held * held).get(), I16F16::MAX);
//! assert!(!(held * held).is_finite());
//!
//! let checked = Checked::<I16F16>::from_f64(200.0);
//! let lost = checked * checked - checked;
//! assert!(!lost.is_finite());
//! assert_ne!(lost, lost);
//!
//! let wrapped = Wrapping::<I16F16>::from_f64(200.0);
//! assert_eq!((wrapped * wrapped).to_f64(), 40_000.0 - 65_536.0);
//! ```
//!
//! Constants need no code at run time:
//!
//! ```
//! use sph_core::scalar::fixed::{I16F16, Saturating};
//!
//! const GRAVITY: Saturating<I16F16> = Saturating::new(I16F16::lit("-9.81"));
//! assert_eq!(GRAVITY.to_string(), "-9.81");
//! ```

mod binary64;
mod compact;
mod format;
mod mode;
mod near;
mod operators;
mod packed;
mod sum;
mod word;

#[cfg(test)]
mod tests;

use crate::scalar::Table;
use crate::{Arithmetic, Scalar};
pub use ::fixed::types;
use binary64::Units;
use core::cmp::Ordering;
use core::marker::PhantomData;
pub use format::*; // the trait and the formats that are shown by name
pub use mode::{Check, Overflow, Saturate, Wide, Wrap};
pub use near::Near14;
pub use packed::Packed14;
pub use sum::Sum;
pub use word::Word;

/// Keeps the sets of formats, words and modes closed.
pub trait Sealed {}
impl Sealed for i8 {}
impl Sealed for i16 {}
impl Sealed for i32 {}
impl Sealed for i64 {}

/// Fixed point that stays at the end of its range, see [`Saturate`].
pub type Saturating<F> = Fixed<F, Saturate>;
/// Fixed point that becomes NaR where it leaves its range, see [`Check`].
pub type Checked<F> = Fixed<F, Check>;
/// Fixed point that keeps the low bits, see [`Wrap`].
pub type Wrapping<F> = Fixed<F, Wrap>;

/// A number of the format F under the overflow mode O; see the [module](self).
#[derive(Clone, Copy, Default)]
#[repr(transparent)]
pub struct Fixed<F, O> {
    value: F,
    mode: PhantomData<O>,
}

impl<F, O> Fixed<F, O> {
    /// The number as it is. Under [`Check`] the most negative pattern is NaR.
    #[inline(always)]
    pub const fn new(value: F) -> Self {
        Self { value, mode: PhantomData }
    }

    /// The number in the type of the `fixed` crate.
    #[inline(always)]
    pub const fn get(self) -> F
    where
        F: Copy,
    {
        self.value
    }
}

impl<F: Format, O: Overflow> Fixed<F, O> {
    /// The number whose count of units is `bits`.
    #[inline(always)]
    pub fn from_bits(bits: F::Bits) -> Self {
        Self::new(F::from_bits(bits))
    }

    /// The count of units.
    #[inline(always)]
    pub fn to_bits(self) -> F::Bits {
        self.value.to_bits()
    }

    #[inline(always)]
    fn narrow(wide: Wide<F>) -> Self {
        Self::new(O::narrow(wide))
    }

    /// The quotient, or where there is none what the sign of the numerator says.
    #[inline(always)]
    fn quotient(quotient: Option<Wide<F>>, numerator: Ordering) -> Self {
        match quotient {
            Some(quotient) => Self::narrow(quotient),
            None if numerator.is_eq() => Self::new(O::undefined()),
            None => Self::new(O::beyond(numerator.is_lt(), 0)),
        }
    }

    #[inline(always)]
    fn is_nar(self) -> bool {
        O::is_nar(self.value)
    }
}

impl<F: Format> Checked<F> {
    /// Not a real: what an overflow leaves behind.
    ///
    /// ```
    /// use sph_core::Scalar;
    /// use sph_core::scalar::fixed::{Checked, I8F24};
    /// let one = Checked::<I8F24>::from_f64(1.0);
    /// assert!(!(one / (one - one)).is_finite());
    /// assert_eq!((one / (one - one)).to_string(), "NaR");
    /// assert_eq!(Checked::<I8F24>::NAR.partial_cmp(&one), None);
    /// ```
    pub const NAR: Self = Self::new(F::MIN);
}

impl<F: Format, O: Overflow> Arithmetic for Fixed<F, O> {
    const ZERO: Self = Self::new(F::ZERO);
    const ONE: Self = Self::new(F::ONE);

    #[inline(always)]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        let shifted = F::Bits::shifted(numerator.into(), F::FRAC_NBITS);
        Self::quotient(F::Bits::quotient(shifted, denominator.into()), numerator.cmp(&0))
    }

    #[inline(always)]
    fn positive_part(self) -> Self {
        Self::from_bits(self.to_bits().positive_part(O::STICKY))
    }

    #[inline(always)]
    fn times(self, n: i32) -> Self {
        if self.is_nar() { self } else { Self::narrow(self.to_bits().scaled(n)) }
    }
}

impl<F: Format, O: Overflow> Scalar for Fixed<F, O> {
    type Sum = Sum<F, O>;

    const NAME: &'static str = F::NAMES[O::NAME_INDEX];
    const EPSILON: Self = Self::new(F::DELTA);
    const MAX: Self = Self::new(if O::MAX_IS_FINITE { F::MAX } else { F::BELOW_MAX });

    #[inline]
    fn from_f64(value: f64) -> Self {
        match binary64::units(value, F::FRAC_NBITS) {
            Units::Exact(count) => Self::narrow(F::Bits::from_i64(count)),
            Units::Beyond { negative, low_bits } => Self::new(O::beyond(negative, low_bits)),
            Units::Undefined => Self::new(O::undefined()),
        }
    }

    #[inline]
    fn to_f64(self) -> f64 {
        let unit = f64::from_bits(u64::from(1023u32.wrapping_sub(F::FRAC_NBITS)) << 52);
        if self.is_nar() { f64::NAN } else { self.to_bits().to_f64() * unit }
    }

    #[inline]
    fn sqrt(self) -> Self {
        if self.value < F::ZERO {
            return Self::new(O::undefined());
        }
        Self::from_bits(self.to_bits().root(F::FRAC_NBITS))
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        O::is_finite(self.value)
    }

    #[inline(always)]
    fn floor_to_i32(self) -> i32 {
        if self.is_nar() { 0 } else { self.to_bits().floor(F::FRAC_NBITS) }
    }

    #[inline(always)]
    fn canonical_bits(self) -> u64 {
        self.to_bits().bits()
    }

    #[inline(always)]
    fn split(self, bits: u32) -> (usize, Self) {
        let (index, rest) = self.to_bits().split(F::FRAC_NBITS, bits);
        (index, Self::from_bits(rest))
    }

    #[inline(always)]
    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        F::constant::<C, ROWS, N>(row, i).map(Self::new)
    }
}
