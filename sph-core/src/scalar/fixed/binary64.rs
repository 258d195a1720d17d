//! Converts an f64 with integer operations alone, so that a processor without floating point links no floating-point code.

/// What an f64 is in units of 2^−`fraction_bits`, rounded to nearest, ties away from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Units {
    /// So many units.
    Exact(i64),
    /// At least 2⁶³ units either way, infinity included; the low 64 bits of the two's complement are these.
    Beyond { negative: bool, low_bits: i64 },
    /// NaN.
    Undefined,
}

/// IEEE 754 binary64: (−1)^sign · significand · 2^(exponent − 1075), whose top bit is hidden. Zero and the
/// subnormals have none, and are far below half a unit with it or without.
pub(super) const fn units(value: f64, fraction_bits: u32) -> Units {
    const SIGNIFICAND_BITS: u32 = 52;
    let bits = value.to_bits();
    let negative = bits >> 63 == 1;
    let exponent = (bits >> SIGNIFICAND_BITS) as u32 & 0x7ff;
    let fraction = bits & ((1 << SIGNIFICAND_BITS) - 1);
    if exponent == 0x7ff && fraction != 0 {
        return Units::Undefined;
    }
    let significand = 1 << SIGNIFICAND_BITS | fraction;
    let left = exponent.wrapping_add(fraction_bits).wrapping_sub(1075) as i32;
    match left {
        11.. => {
            let magnitude = match significand.checked_shl(left as u32) {
                Some(magnitude) => magnitude,
                None => 0,
            };
            Units::Beyond { negative, low_bits: signed(negative, magnitude) }
        }
        0..11 => Units::Exact(signed(negative, significand.wrapping_shl(left as u32))),
        -54..0 => {
            let right = left.unsigned_abs();
            let half = 1u64.wrapping_shl(right.wrapping_sub(1));
            Units::Exact(signed(negative, significand.wrapping_add(half).wrapping_shr(right)))
        }
        _ => Units::Exact(0),
    }
}

const fn signed(negative: bool, magnitude: u64) -> i64 {
    let magnitude = magnitude as i64;
    if negative { magnitude.wrapping_neg() } else { magnitude }
}

/// The units of a number that is known to be within ±1: a table's entry.
pub(super) const fn literal(value: f64, fraction_bits: u32) -> i64 {
    match units(value, fraction_bits) {
        Units::Exact(count) if value >= -1.0 && value <= 1.0 => count,
        _ => panic!("the entries of a table lie within -1 and 1"),
    }
}
