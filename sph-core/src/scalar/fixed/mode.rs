//! What becomes of a result that is out of range: one zero-sized type for each mode.

use super::{Format, Sealed, Word};
use core::fmt::Debug;

/// A wide intermediate of the format F.
pub type Wide<F> = <<F as ::fixed::traits::Fixed>::Bits as Word>::Wide;

/// What becomes of a result that does not fit. Sealed: [`Wrap`], [`Saturate`] and [`Check`].
pub trait Overflow: Copy + Default + Debug + Send + Sync + Sealed + 'static {
    /// The place of the mode's name in [`Format::NAMES`].
    const NAME_INDEX: usize;
    /// Whether the largest number may be an honest result.
    const MAX_IS_FINITE: bool;
    /// Whether there is a NaR.
    const STICKY: bool;

    /// a + b
    fn add<F: Format>(a: F, b: F) -> F;
    /// a − b
    fn subtract<F: Format>(a: F, b: F) -> F;
    /// −a
    fn negate<F: Format>(a: F) -> F;
    /// A wide result as a number.
    fn narrow<F: Format>(wide: Wide<F>) -> F;
    /// A result beyond every wide integer, of which the low 64 bits are known.
    fn beyond<F: Format>(negative: bool, low_bits: i64) -> F;
    /// A result that no number is: 0/0, √−1, NaN.
    fn undefined<F: Format>() -> F;
    /// Whether this number says that it is none.
    fn is_nar<F: Format>(a: F) -> bool;
    /// Whether nothing overflowed here as far as the mode can tell.
    fn is_finite<F: Format>(a: F) -> bool;
}

/// Keep the low bits, as a processor's registers do: the fastest, and blind. [`is_finite`](crate::Scalar::is_finite)
/// is always true; what no number is becomes 0.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Wrap;

/// Stay at the nearest end of the range, −MAX or MAX, where `is_finite` is false. Not sticky: MAX − 1 is finite again.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Saturate;

/// Become NaR, *not a real*: the most negative bit pattern, which every later operation keeps, which equals nothing (itself
/// included) and is not finite. All other numbers are honest results.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Check;

impl Sealed for Wrap {}
impl Sealed for Saturate {}
impl Sealed for Check {}

impl Overflow for Wrap {
    const NAME_INDEX: usize = 1;
    const MAX_IS_FINITE: bool = true;
    const STICKY: bool = false;

    #[inline(always)]
    fn add<F: Format>(a: F, b: F) -> F {
        a.wrapping_add(b)
    }

    #[inline(always)]
    fn subtract<F: Format>(a: F, b: F) -> F {
        a.wrapping_sub(b)
    }

    #[inline(always)]
    fn negate<F: Format>(a: F) -> F {
        a.wrapping_neg()
    }

    #[inline(always)]
    fn narrow<F: Format>(wide: Wide<F>) -> F {
        F::from_bits(F::Bits::wrap(wide))
    }

    #[inline(always)]
    fn beyond<F: Format>(_negative: bool, low_bits: i64) -> F {
        F::from_bits(F::Bits::low_bits(low_bits))
    }

    #[inline(always)]
    fn undefined<F: Format>() -> F {
        F::ZERO
    }

    #[inline(always)]
    fn is_nar<F: Format>(_a: F) -> bool {
        false
    }

    #[inline(always)]
    fn is_finite<F: Format>(_a: F) -> bool {
        true
    }
}

impl Overflow for Saturate {
    const NAME_INDEX: usize = 0;
    const MAX_IS_FINITE: bool = false;
    const STICKY: bool = false;

    #[inline(always)]
    fn add<F: Format>(a: F, b: F) -> F {
        a.saturating_add(b)
    }

    #[inline(always)]
    fn subtract<F: Format>(a: F, b: F) -> F {
        a.saturating_sub(b)
    }

    #[inline(always)]
    fn negate<F: Format>(a: F) -> F {
        a.saturating_neg()
    }

    #[inline(always)]
    fn narrow<F: Format>(wide: Wide<F>) -> F {
        F::from_bits(F::Bits::saturate(wide))
    }

    #[inline(always)]
    fn beyond<F: Format>(negative: bool, _low_bits: i64) -> F {
        if negative { F::MAX.wrapping_neg() } else { F::MAX }
    }

    #[inline(always)]
    fn undefined<F: Format>() -> F {
        F::ZERO
    }

    #[inline(always)]
    fn is_nar<F: Format>(_a: F) -> bool {
        false
    }

    #[inline(always)]
    fn is_finite<F: Format>(a: F) -> bool {
        a < F::MAX && a > F::MAX.wrapping_neg()
    }
}

impl Overflow for Check {
    const NAME_INDEX: usize = 2;
    const MAX_IS_FINITE: bool = true;
    const STICKY: bool = true;

    #[inline(always)]
    fn add<F: Format>(a: F, b: F) -> F {
        a.checked_add(b).filter(|_| !Self::is_nar(a) && !Self::is_nar(b)).unwrap_or(F::MIN)
    }

    #[inline(always)]
    fn subtract<F: Format>(a: F, b: F) -> F {
        a.checked_sub(b).filter(|_| !Self::is_nar(a) && !Self::is_nar(b)).unwrap_or(F::MIN)
    }

    #[inline(always)]
    fn negate<F: Format>(a: F) -> F {
        a.wrapping_neg()
    }

    #[inline(always)]
    fn narrow<F: Format>(wide: Wide<F>) -> F {
        F::Bits::fit(wide).map_or(F::MIN, F::from_bits)
    }

    #[inline(always)]
    fn beyond<F: Format>(_negative: bool, _low_bits: i64) -> F {
        F::MIN
    }

    #[inline(always)]
    fn undefined<F: Format>() -> F {
        F::MIN
    }

    #[inline(always)]
    fn is_nar<F: Format>(a: F) -> bool {
        a == F::MIN
    }

    #[inline(always)]
    fn is_finite<F: Format>(a: F) -> bool {
        !Self::is_nar(a)
    }
}
