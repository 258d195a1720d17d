//! Integer arithmetic in 128 bits, rounded once to a format; in 64 where the numbers of a format are narrow enough, with the same bits.

use super::format::{Format, Overflow, Rounding};
use super::random;

/// 2^n
pub(super) fn power_of_two(n: u32) -> f64 {
    f64::from_bits(u64::from(1023 + n) << 52)
}

/// The largest count.
pub(super) fn max(format: Format) -> i64 {
    i64::MAX >> (64 - format.bits())
}

/// The most negative count: NaR where results are checked.
fn min(format: Format) -> i64 {
    i64::MIN >> (64 - format.bits())
}

pub(super) fn is_nar(format: Format, count: i64) -> bool {
    format.overflow() == Overflow::Checked && count == min(format)
}

/// A result that no number is: 0/0, √−1, NaN.
pub(super) fn undefined(format: Format) -> i64 {
    if format.overflow() == Overflow::Checked { min(format) } else { 0 }
}

/// A result beyond every wide integer, of which the low 64 bits are known.
pub(super) fn beyond(format: Format, negative: bool, low: i64) -> i64 {
    match format.overflow() {
        Overflow::Saturating if negative => -max(format),
        Overflow::Saturating => max(format),
        Overflow::Wrapping => low_bits(format, low.into()),
        Overflow::Checked => min(format),
    }
}

/// The low bits of a wide integer, the highest of them its sign.
pub(super) fn low_bits(format: Format, wide: i128) -> i64 {
    let above = 64 - format.bits();
    (wide as i64) << above >> above
}

/// A constant that is at most 1, held in the symmetric range whatever overflow does.
pub(super) fn within(format: Format, wide: i128) -> i64 {
    let most = i128::from(max(format));
    wide.clamp(-most, most) as i64
}

/// A wide result, held in the symmetric range −MAX to MAX as the format's answer to overflow says.
pub(super) fn held(format: Format, wide: i128) -> i64 {
    let most = i128::from(max(format));
    match format.overflow() {
        Overflow::Saturating => wide.clamp(-most, most) as i64,
        Overflow::Wrapping => low_bits(format, wide),
        Overflow::Checked if wide.unsigned_abs() <= most.unsigned_abs() => wide as i64,
        Overflow::Checked => min(format),
    }
}

/// A sum, difference or opposite: saturation ends at the most negative count, as that of the processor's integers does.
pub(super) fn held_sum(format: Format, wide: i128) -> i64 {
    match format.overflow() {
        Overflow::Saturating => wide.clamp(min(format).into(), max(format).into()) as i64,
        _ => held(format, wide),
    }
}

/// As [`held`], for a narrow format.
#[inline]
pub(super) fn held_narrow(format: Format, wide: i64) -> i64 {
    let most = max(format);
    match format.overflow() {
        Overflow::Saturating => wide.clamp(-most, most),
        Overflow::Wrapping => low_bits(format, wide.into()),
        Overflow::Checked if wide.abs() <= most => wide,
        Overflow::Checked => min(format),
    }
}

/// As [`held_sum`], for a narrow format.
#[inline]
pub(super) fn held_narrow_sum(format: Format, wide: i64) -> i64 {
    match format.overflow() {
        Overflow::Saturating => wide.clamp(min(format), max(format)),
        _ => held_narrow(format, wide),
    }
}

/// product / 2^F, for a narrow format.
#[inline]
pub(super) fn rounded_narrow(format: Format, product: i64) -> i64 {
    let bits = format.fraction_bits();
    if bits == 0 {
        return product;
    }
    let below = match format.rounding() {
        Rounding::Nearest => (1 << (bits - 1)) - i64::from(product < 0),
        Rounding::TowardZero if product < 0 => (1 << bits) - 1,
        Rounding::Floor | Rounding::TowardZero => 0,
        Rounding::Stochastic { .. } => (random::next() >> (64 - bits)) as i64,
    };
    (product + below) >> bits
}

/// wide / 2^`bits`
pub(super) fn rounded(format: Format, wide: i128, bits: u32) -> i128 {
    rounded_as(format, wide, bits, wide < 0)
}

/// wide / 2^`bits`, the low part of a number of this sign.
pub(super) fn rounded_as(format: Format, wide: i128, bits: u32, is_negative: bool) -> i128 {
    if bits == 0 {
        return wide;
    }
    let below = match format.rounding() {
        Rounding::Nearest => (1 << (bits - 1)) - i128::from(is_negative),
        Rounding::Floor => 0,
        Rounding::TowardZero if is_negative => (1 << bits) - 1,
        Rounding::TowardZero => 0,
        Rounding::Stochastic { .. } => i128::from(random::next() >> (64 - bits)),
    };
    (wide + below) >> bits
}

/// numerator / denominator; `None` for a denominator of 0.
pub(super) fn quotient(format: Format, numerator: i128, denominator: i128) -> Option<i128> {
    let divisor = denominator.unsigned_abs();
    let is_negative = (numerator < 0) != (denominator < 0);
    let size = numerator.unsigned_abs();
    let floor = size.checked_div(divisor)?;
    let rest = size % divisor;
    let away = match format.rounding() {
        Rounding::Nearest => rest >= divisor - rest,
        Rounding::Floor => is_negative && rest > 0,
        Rounding::TowardZero => false,
        Rounding::Stochastic { .. } => is_random_below(rest, divisor),
    };
    let rounded = (floor + u128::from(away)) as i128;
    Some(if is_negative { -rounded } else { rounded })
}

/// True with the probability part / whole, for a whole of 64 bits; never for a part of 0.
fn is_random_below(part: u128, whole: u128) -> bool {
    (u128::from(random::next()) * whole) >> 64 < part
}

/// √ of a count that is not negative.
pub(super) fn root(format: Format, count: i64) -> i64 {
    let square = u128::from(count.unsigned_abs()) << format.fraction_bits();
    let floor = square.isqrt();
    let rest = square - floor * floor;
    let is_above = match format.rounding() {
        Rounding::Nearest => rest > floor,
        // √(f² + rest) − f is rest / (2 f + √(f² + rest) − f)
        Rounding::Stochastic { .. } => {
            let (floor, rest) = (floor as f64, rest as f64);
            let first = rest / (2.0 * floor + 1.0);
            random::unit() < rest / (2.0 * floor + first).max(1.0)
        }
        Rounding::Floor | Rounding::TowardZero => false,
    };
    (floor + u128::from(is_above)) as i64
}

/// An f64 as a whole number.
pub(super) fn whole(format: Format, units: f64) -> f64 {
    match format.rounding() {
        Rounding::Nearest => units.round(),
        Rounding::Floor => units.floor(),
        Rounding::TowardZero => units.trunc(),
        Rounding::Stochastic { .. } => {
            units.floor() + f64::from(u8::from(random::unit() < units - units.floor()))
        }
    }
}
