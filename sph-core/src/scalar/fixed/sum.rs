//! The sum of many fixed-point numbers.

use super::{Fixed, Format, Overflow, Wide, Word};
use crate::Accumulator;
use core::marker::PhantomData;

/// An exact running sum: 64 bits under a 32-bit word, 128 under a 64-bit one, narrowed by the mode once, in `total`.
///
/// Room for 2³² terms of any size (2⁶⁴ of a 64-bit word). Partial sums may leave the type's range and come back; the
/// order of the terms cannot change the result. Under [`Check`](super::Check) one NaR among the terms makes the total NaR.
///
/// ```
/// use sph_core::scalar::fixed::{I16F16, Saturating, Sum};
/// use sph_core::{Accumulator, Scalar};
/// let mut sum = Sum::ZERO;
/// for term in [30_000.0, 30_000.0, -32_000.0, 0.5] {
///     sum.add(Saturating::<I16F16>::from_f64(term));
/// }
/// assert_eq!(sum.total().to_f64(), 28_000.5);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sum<F: Format, O> {
    wide: Wide<F>,
    mode: PhantomData<O>,
}

impl<F: Format, O: Overflow> Accumulator<Fixed<F, O>> for Sum<F, O> {
    const ZERO: Self = Self { wide: F::Bits::EMPTY_SUM, mode: PhantomData };

    #[inline(always)]
    fn add(&mut self, term: Fixed<F, O>) {
        self.wide = if O::is_nar(term.value) { F::Bits::POISON } else { term.to_bits().added_to(self.wide) };
    }

    #[inline(always)]
    fn total(self) -> Fixed<F, O> {
        Fixed::narrow(self.wide)
    }

    #[inline]
    fn scaled_total(self, a: Fixed<F, O>, b: Fixed<F, O>) -> Fixed<F, O> {
        if O::STICKY && (a.is_nar() || b.is_nar() || F::Bits::is_poisoned(self.wide)) {
            return Fixed::new(O::undefined());
        }
        let scaled = b.to_bits().times_sum(self.wide, F::FRAC_NBITS);
        Fixed::narrow(a.to_bits().times_sum(scaled, F::FRAC_NBITS))
    }
}

/// The sum so far as [`Accumulator::total`] gives it.
#[cfg(feature = "defmt")]
impl<F: Format, O: Overflow> defmt::Format for Sum<F, O> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{}", Accumulator::<Fixed<F, O>>::total(*self));
    }
}
