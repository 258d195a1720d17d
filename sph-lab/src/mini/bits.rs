//! Numbers of a format as f64, rounded to it, and as their 16 bits.

use super::format::{Kind, MiniFormat};

/// 2^n for an n of normal numbers.
fn power_of_two(n: i32) -> f64 {
    f64::from_bits(((1023 + n) as u64) << 52)
}

/// ⌊log₂|x|⌋ of a normal number; less for a subnormal one.
fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// x to the nearest multiple of 2^step, ties to even.
fn to_multiple(x: f64, step: i32) -> f64 {
    let unit = power_of_two(step);
    (x / unit).round_ties_even() * unit
}

/// The number of the format that is nearest to x.
pub(super) fn rounded(format: MiniFormat, x: f64) -> f64 {
    if x == 0.0 || x.is_nan() {
        return x;
    }
    match format.0 {
        Kind::Float { significand, least, most } => {
            let nearest = to_multiple(x, exponent(x).max(least) + 1 - significand);
            if nearest.abs() < power_of_two(most + 1) { nearest } else { f64::INFINITY.copysign(x) }
        }
        Kind::Posit { exponent_bits } => from_posit(posit(x, exponent_bits), exponent_bits),
    }
}

/// The largest number.
pub(super) fn largest(format: MiniFormat) -> f64 {
    match format.0 {
        Kind::Float { significand, most, .. } => (2.0 - power_of_two(1 - significand)) * power_of_two(most),
        Kind::Posit { exponent_bits } => power_of_two(14 << exponent_bits),
    }
}

/// The distance from 1 to the next larger number.
pub(super) fn epsilon(format: MiniFormat) -> f64 {
    match format.0 {
        Kind::Float { significand, .. } => power_of_two(1 - significand),
        Kind::Posit { exponent_bits } => power_of_two(exponent_bits as i32 - 13),
    }
}

/// The 16 bits of a number of the format.
pub(super) fn to_bits(format: MiniFormat, x: f64) -> u16 {
    match format.0 {
        Kind::Float { significand, least, most } => {
            let sign = u16::from(x.is_sign_negative()) << 15;
            let fraction_bits = (significand - 1) as u32;
            if !x.is_finite() {
                let infinity = ((most - least + 2) as u16) << fraction_bits;
                return sign | infinity | u16::from(x.is_nan()) << (fraction_bits - 1);
            }
            let units = (x.abs() / power_of_two(exponent(x).max(least) + 1 - significand)) as u16;
            let above = (exponent(x) - least).max(0) as u16;
            // the hidden bit of a normal number counts one up in the exponent's field
            sign | ((above << fraction_bits) + units)
        }
        Kind::Posit { exponent_bits } => posit(x, exponent_bits),
    }
}

/// The number whose bits these are.
pub(super) fn from_bits(format: MiniFormat, bits: u16) -> f64 {
    match format.0 {
        Kind::Float { significand, least, most } => {
            let fraction_bits = (significand - 1) as u32;
            let (field, fraction) = ((bits & 0x7fff) >> fraction_bits, bits & ((1 << fraction_bits) - 1));
            let magnitude = match i32::from(field) {
                0 => f64::from(fraction) * power_of_two(least + 1 - significand),
                field if field > most - least + 1 => {
                    if fraction == 0 {
                        f64::INFINITY
                    } else {
                        f64::NAN
                    }
                }
                field => {
                    (1.0 + f64::from(fraction) / power_of_two(significand - 1))
                        * power_of_two(field - 1 + least)
                }
            };
            if bits >> 15 == 1 { -magnitude } else { magnitude }
        }
        Kind::Posit { exponent_bits } => from_posit(bits, exponent_bits),
    }
}

/// The bits of the posit nearest to x: the exact bits of |x| behind the regime, cut at 15 and rounded to even; never to 0 nor to NaR.
fn posit(x: f64, exponent_bits: u32) -> u16 {
    if x == 0.0 {
        return 0;
    }
    if !x.is_finite() {
        return 0x8000;
    }
    let exponent = exponent(x).clamp(-200, 200);
    let regime = exponent >> exponent_bits;
    // a run of ones and a zero, or a run of zeros and a one
    let (run, run_bits) =
        if regime >= 0 { ((1_u128 << (regime + 2)) - 2, regime + 2) } else { (1, 1 - regime) };
    let magnitude = if run_bits > 15 {
        if regime >= 0 { 0x7fff } else { 1 }
    } else {
        let low = (exponent - (regime << exponent_bits)) as u128;
        let fraction = u128::from(x.to_bits() & ((1 << 52) - 1));
        let all = ((run << exponent_bits) | low) << 52 | fraction;
        let beyond = run_bits as u32 + exponent_bits + 52 - 15;
        let (kept, rest, half) = (all >> beyond, all & ((1 << beyond) - 1), 1_u128 << (beyond - 1));
        let up = rest > half || (rest == half && kept & 1 == 1);
        (kept as u16 + u16::from(up)).clamp(1, 0x7fff)
    };
    if x < 0.0 { magnitude.wrapping_neg() } else { magnitude }
}

/// (−1)^s · 2^(2^es k + e) · (1 + f); the regime k is told by a run of equal bits.
fn from_posit(bits: u16, exponent_bits: u32) -> f64 {
    match bits {
        0 => return 0.0,
        0x8000 => return f64::NAN,
        _ => {}
    }
    let is_negative = bits >> 15 == 1;
    let body = (if is_negative { bits.wrapping_neg() } else { bits }) << 1;
    let run = if body >> 15 == 1 { body.leading_ones() } else { body.leading_zeros() };
    let regime = if body >> 15 == 1 { run as i32 - 1 } else { -(run as i32) };
    let rest = u32::from(body) << 16 << (run + 1).min(31);
    let low = if exponent_bits == 0 { 0 } else { rest >> (32 - exponent_bits) };
    let fraction = f64::from(rest << exponent_bits) / power_of_two(32);
    let magnitude = (1.0 + fraction) * power_of_two((regime << exponent_bits) + low as i32);
    if is_negative { -magnitude } else { magnitude }
}
