//! The sum of many emulated numbers.

use sph_core::Accumulator;

use super::exact::{is_nar, undefined};
use super::{Emulated, Format, Rounding};

/// So far out that a sum put here when it meets a NaR stays out of range.
const POISON: i128 = i128::MIN;

/// An exact running sum in 128 bits, narrowed once, in `total`: room for 2⁶⁴ terms.
#[derive(Clone, Copy, Debug)]
pub struct EmulatedSum(i128);

impl Accumulator<Emulated> for EmulatedSum {
    const ZERO: Self = Self(0);

    fn add(&mut self, term: Emulated) {
        let format = Format::current();
        let count = term.count(format);
        self.0 = if is_nar(format, count) { POISON } else { self.0.wrapping_add(count.into()) };
    }

    fn total(self) -> Emulated {
        Emulated::narrow(Format::current(), self.0)
    }

    fn scaled_total(self, a: Emulated, b: Emulated) -> Emulated {
        let format = Format::current();
        let (a, b) = (a.count(format), b.count(format));
        let is_poisoned = self.0 < POISON / 2 && super::Overflow::Checked == format.overflow();
        if is_nar(format, a) || is_nar(format, b) || is_poisoned {
            return Emulated::of(undefined(format));
        }
        Emulated::narrow(format, times_sum(format, a, times_sum(format, b, self.0)))
    }
}

/// factor · sum / 2^F, rounded, and held at the ends of the wide integer under the compiled type: 64 bits under a word of up to 32,
/// 128 under one of 64.
fn times_sum(format: Format, factor: i64, sum: i128) -> i128 {
    let word = if format.bits() <= 16 { 16 } else { (format.bits().div_ceil(32)) * 32 };
    let (fraction, factor) = (format.fraction_bits(), i128::from(factor));
    let high = (sum >> word).wrapping_mul(factor);
    let low = (sum & ((1 << word) - 1)).wrapping_mul(factor);
    let is_negative = (sum < 0) != (factor < 0);
    let low = match format.rounding() {
        _ if fraction == 0 => low,
        Rounding::Nearest => (low + (1 << (fraction - 1)) - i128::from(is_negative)) >> fraction,
        Rounding::Floor => low >> fraction,
        Rounding::TowardZero => (low + if is_negative { (1 << fraction) - 1 } else { 0 }) >> fraction,
    };
    let wide = if word == 64 { 128 } else { 64 };
    let above = 128 - wide;
    let up = word - fraction;
    let lifted = high.wrapping_shl(up) << above >> above;
    let (least, most) = (i128::MIN >> above, i128::MAX >> above);
    if up < 128 && lifted >> up == high {
        lifted.saturating_add(low).clamp(least, most)
    } else if high < 0 {
        least
    } else {
        most
    }
}
