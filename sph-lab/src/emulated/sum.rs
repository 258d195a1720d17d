//! The sum of many emulated numbers.

use sph_core::Accumulator;

use super::exact::{is_nar, rounded_as, undefined};
use super::{Emulated, Format};

/// So far out that a sum put here when it meets a NaR stays out of range, whatever terms follow, of either sign.
const POISON: i128 = i128::MIN / 4 * 3;

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
        let is_poisoned = self.0 < i128::MIN / 2 && super::Overflow::Checked == format.overflow();
        if is_nar(format, a) || is_nar(format, b) || is_poisoned {
            return Emulated::of(undefined(format));
        }
        Emulated::narrow(format, times_sum(format, a, times_sum(format, b, self.0)))
    }
}

/// factor · sum / 2^F, rounded, and held at the ends of the wide integer under the compiled type: 64 bits under a word of up to 32,
/// 128 under one of 64.
fn times_sum(format: Format, factor: i64, sum: i128) -> i128 {
    let above = if format.bits() <= 32 { 64 } else { 0 };
    let (least, most) = (i128::MIN >> above, i128::MAX >> above);
    let (fraction, factor) = (format.fraction_bits(), i128::from(factor));
    if fraction == 0 {
        return sum.saturating_mul(factor).clamp(least, most);
    }
    let word = format.bits().next_power_of_two();
    let (high, low) = ((sum >> word).wrapping_mul(factor), (sum & ((1 << word) - 1)).wrapping_mul(factor));
    let is_negative = (sum < 0) != (factor < 0);
    let low = rounded_as(format, low, fraction, is_negative);
    let up = word - fraction;
    let lifted = high.wrapping_shl(up) << above >> above;
    if lifted >> up == high {
        lifted.saturating_add(low).clamp(least, most)
    } else if high < 0 {
        least
    } else {
        most
    }
}
