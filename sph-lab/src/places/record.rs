//! What happened at one place.

use super::place::Place;

/// The binary exponent that the histogram begins with.
const LOWEST: i32 = -64;
/// Exponents of the histogram.
const EXPONENTS: usize = 128;
/// A sum or difference is cancelled where it is smaller than its larger operand by so much.
const CANCELLED: f64 = 1.0 / 256.0;

/// Distances from the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// The largest error of the operation itself, on the operands as they were.
    pub local: f64,
    /// The largest distance of the result from the truth.
    pub global: f64,
    /// The sum of the squares of these distances.
    pub(super) squares: f64,
}

/// What happened at one place. Magnitudes are those of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The place.
    pub place: Place,
    /// How often it was passed.
    pub count: u64,
    /// The least result, with its sign; +∞ before there is one.
    pub lowest: f64,
    /// The greatest result, with its sign; −∞ before there is one.
    pub highest: f64,
    /// The smallest magnitude other than 0; +∞ where there is none.
    pub least: f64,
    /// Results that are 0 although no operand is, of products, quotients and roots: too small for the type.
    pub vanished: u64,
    /// Sums and differences smaller than their larger operand by 2⁸ and more.
    pub cancelled: u64,
    /// Results that left the range of the type, of operands that had not.
    pub saturated: u64,
    /// How many of these changed a comparison or reached a sum or a result.
    pub consequential: u64,
    /// Comparisons that the truth decides otherwise.
    pub decided_otherwise: u64,
    /// Distances from the truth, where it is known.
    pub errors: Errors,
    exponents: [u64; EXPONENTS],
}

impl Record {
    pub(super) fn new(place: Place) -> Self {
        Self {
            place,
            count: 0,
            lowest: f64::INFINITY,
            highest: f64::NEG_INFINITY,
            least: f64::INFINITY,
            vanished: 0,
            cancelled: 0,
            saturated: 0,
            consequential: 0,
            decided_otherwise: 0,
            errors: Errors::default(),
            exponents: [0; EXPONENTS],
        }
    }

    /// The largest magnitude; 0 before there is a result.
    #[must_use]
    pub fn largest(&self) -> f64 {
        if self.lowest <= self.highest { self.lowest.abs().max(self.highest.abs()) } else { 0.0 }
    }

    /// The root of the mean square distance from the truth.
    #[must_use]
    pub fn rms(&self) -> f64 {
        (self.errors.squares / self.count.max(1) as f64).sqrt()
    }

    /// How many results have a magnitude of 2^e to 2^(e+1), for each e that occurs; ends of the range take what is beyond.
    pub fn exponents(&self) -> impl Iterator<Item = (i32, u64)> + '_ {
        let counts = self.exponents.iter().enumerate().filter(|(_, count)| **count > 0);
        counts.map(|(index, count)| (LOWEST + index as i32, *count))
    }

    /// Bits from the largest magnitude down to the smallest: how many a number of this place has to have to hold the first bit of
    /// each.
    #[must_use]
    pub fn bits(&self) -> u32 {
        let (first, last) = (self.exponents().next(), self.exponents().last());
        first.zip(last).map_or(0, |((low, _), (high, _))| (high - low + 1).unsigned_abs())
    }

    /// Adds one result. `largest_operand` is that of a sum's or difference's operands, 0 for others.
    #[inline]
    pub(super) fn add(&mut self, result: f64, largest_operand: f64) {
        self.count += 1;
        if result < self.lowest {
            self.lowest = result;
        }
        if result > self.highest {
            self.highest = result;
        }
        let magnitude = result.abs();
        if magnitude != 0.0 {
            if magnitude < self.least {
                self.least = magnitude;
            }
            let exponent =
                ((magnitude.to_bits() >> 52) as i32 - 1023 - LOWEST).clamp(0, EXPONENTS as i32 - 1);
            self.exponents[exponent as usize] += 1;
            self.cancelled += u64::from(magnitude < largest_operand * CANCELLED);
        }
    }

    /// Adds what happened at the same place elsewhere.
    pub(super) fn merge(&mut self, more: &Self) {
        self.count += more.count;
        self.lowest = self.lowest.min(more.lowest);
        self.highest = self.highest.max(more.highest);
        self.least = self.least.min(more.least);
        self.vanished += more.vanished;
        self.cancelled += more.cancelled;
        self.saturated += more.saturated;
        self.consequential += more.consequential;
        self.decided_otherwise += more.decided_otherwise;
        self.errors.local = self.errors.local.max(more.errors.local);
        self.errors.global = self.errors.global.max(more.errors.global);
        self.errors.squares += more.errors.squares;
        self.exponents.iter_mut().zip(more.exponents).for_each(|(own, more)| *own += more);
    }
}
