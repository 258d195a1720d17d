//! Floating point of 16 bits against the definitions of the formats, pattern by pattern.

use sph_core::{Accumulator, Arithmetic, Scalar};
use sph_lab::{Mini, MiniFormat};

/// The number of a pattern by the definition of the format, digit by digit; `None` for what is no number.
fn decoded(format: MiniFormat, bits: u16) -> Option<f64> {
    let digits: Vec<u16> = (0..16).rev().map(|place| bits >> place & 1).collect();
    match format {
        MiniFormat::F16 => ieee(&digits, 5),
        MiniFormat::BF16 => ieee(&digits, 8),
        MiniFormat::POSIT16 => posit(bits, 1),
        _ => posit(bits, 2),
    }
}

fn ieee(digits: &[u16], exponent_bits: usize) -> Option<f64> {
    let number = |digits: &[u16]| digits.iter().fold(0.0, |number, &digit| 2.0 * number + f64::from(digit));
    let (exponent, fraction) = (number(&digits[1..=exponent_bits]), &digits[exponent_bits + 1..]);
    let fraction = number(fraction) / 2_f64.powi(fraction.len() as i32);
    let bias = 2_f64.powi(exponent_bits as i32 - 1) - 1.0;
    let magnitude = if exponent == 0.0 {
        fraction * 2_f64.powf(1.0 - bias)
    } else if exponent == 2.0 * bias + 1.0 {
        return None;
    } else {
        (1.0 + fraction) * 2_f64.powf(exponent - bias)
    };
    Some(if digits[0] == 1 { -magnitude } else { magnitude })
}

fn posit(bits: u16, exponent_bits: usize) -> Option<f64> {
    if bits == 0x8000 {
        return None;
    }
    if bits > 0x8000 {
        return posit(bits.wrapping_neg(), exponent_bits).map(|magnitude| -magnitude);
    }
    if bits == 0 {
        return Some(0.0);
    }
    let digits: Vec<u16> = (0..15).rev().map(|place| bits >> place & 1).collect();
    let run = digits.iter().take_while(|&&digit| digit == digits[0]).count();
    let regime = if digits[0] == 1 { run as i32 - 1 } else { -(run as i32) };
    let mut rest = digits.into_iter().skip(run + 1).chain(std::iter::repeat(0));
    let exponent = (0..exponent_bits).fold(0, |exponent, _| 2 * exponent + i32::from(rest.next().unwrap()));
    let fraction = (1..=16).map(|place| f64::from(rest.next().unwrap()) / 2_f64.powi(place)).sum::<f64>();
    Some((1.0 + fraction) * 2_f64.powi(regime * (1 << exponent_bits) + exponent))
}

#[test]
fn every_pattern_is_the_number_that_the_definition_says() {
    for format in MiniFormat::ALL {
        format.scope(|| {
            for bits in 0..=u16::MAX {
                let number = Mini::from_bits(bits);
                match decoded(format, bits) {
                    Some(value) => {
                        assert_eq!(number.to_f64(), value, "{format} {bits:#06x}");
                        assert_eq!(number.to_bits(), bits, "{format} {value}");
                        assert_eq!(Mini::from_f64(value).to_bits(), bits, "{format} {value}");
                    }
                    None => assert!(!number.is_finite(), "{format} {bits:#06x}"),
                }
            }
        });
    }
}

/// The next number above a positive one.
fn above(bits: u16) -> u16 {
    bits + 1
}

#[test]
fn between_two_numbers_the_nearer_one_is_taken_and_of_two_as_near_the_even_one() {
    for format in [MiniFormat::F16, MiniFormat::BF16] {
        let last = format.scope(|| Mini::MAX.to_bits());
        for bits in (0..last).step_by(7) {
            let [low, high] = [bits, above(bits)].map(|bits| decoded(format, bits).unwrap());
            let middle = low + (high - low) / 2.0;
            let even = if bits % 2 == 0 { bits } else { above(bits) };
            for (value, expected) in
                [(middle.next_down(), bits), (middle.next_up(), above(bits)), (middle, even)]
            {
                let found = format.scope(|| Mini::from_f64(value).to_bits());
                assert_eq!(found, expected, "{format} {value:e}");
                assert_eq!(format.scope(|| Mini::from_f64(-value).to_bits()), expected | 0x8000);
            }
        }
    }
}

/// A posit is rounded as its bits are: the place between two patterns is the pattern of one bit more.
#[test]
fn posits_are_rounded_by_their_patterns() {
    let middle = |bits: u16, exponent_bits: usize| {
        // the pattern of 17 bits between this one and the next, decoded as a longer posit
        let digits: Vec<u32> = (0..15).rev().map(|place| u32::from(bits >> place & 1)).chain([1]).collect();
        let run = digits.iter().take_while(|&&digit| digit == digits[0]).count();
        let regime = if digits[0] == 1 { run as i32 - 1 } else { -(run as i32) };
        let mut rest = digits.into_iter().skip(run + 1).chain(std::iter::repeat(0));
        let exponent = (0..exponent_bits).fold(0, |exponent, _| 2 * exponent + rest.next().unwrap() as i32);
        let fraction = (1..=16).map(|place| f64::from(rest.next().unwrap()) / 2_f64.powi(place)).sum::<f64>();
        (1.0 + fraction) * 2_f64.powi(regime * (1 << exponent_bits) + exponent)
    };
    for (format, exponent_bits) in [(MiniFormat::POSIT16, 1), (MiniFormat::POSIT16_2022, 2)] {
        for bits in 1..0x7fff_u16 {
            let middle = middle(bits, exponent_bits);
            let even = if bits % 2 == 0 { bits } else { above(bits) };
            for (value, expected) in
                [(middle.next_down(), bits), (middle.next_up(), above(bits)), (middle, even)]
            {
                let found = format.scope(|| Mini::from_f64(value).to_bits());
                assert_eq!(found, expected, "{format} {bits:#06x} {value:e}");
            }
        }
    }
}

#[test]
fn known_patterns() {
    let bits = |format: MiniFormat, value: f64| format.scope(|| Mini::from_f64(value).to_bits());
    for (value, f16, bf16, posit16) in [
        (1.0, 0x3c00, 0x3f80, 0x4000),
        (-2.0, 0xc000, 0xc000, 0xb000),
        (0.5, 0x3800, 0x3f00, 0x3000),
        (65504.0, 0x7bff, 0x4780, 0x7fc0),
    ] {
        assert_eq!(bits(MiniFormat::F16, value), f16, "{value}");
        assert_eq!(bits(MiniFormat::BF16, value), bf16, "{value}");
        assert_eq!(bits(MiniFormat::POSIT16, value), posit16, "{value}");
    }
}

#[test]
fn ends_of_the_range() {
    let number = |format: MiniFormat, value: f64| format.scope(|| Mini::from_f64(value).to_f64());
    assert_eq!(number(MiniFormat::F16, 65519.9), 65504.0);
    assert_eq!(number(MiniFormat::F16, 65520.0), f64::INFINITY);
    assert_eq!(number(MiniFormat::F16, 2_f64.powi(-25)), 0.0);
    assert_eq!(number(MiniFormat::F16, 1.1 * 2_f64.powi(-25)), 2_f64.powi(-24));
    assert_eq!(number(MiniFormat::POSIT16, 1e30), 2_f64.powi(28));
    assert_eq!(number(MiniFormat::POSIT16, -1e-30), -2_f64.powi(-28));
    for format in MiniFormat::ALL {
        assert!(number(format, f64::NAN).is_nan());
        format.scope(|| {
            assert!(!Mini::from_f64(f64::INFINITY).is_finite());
            assert!(!(Mini::ZERO / Mini::ZERO).is_finite());
            assert!(!Scalar::sqrt(-Mini::ONE).is_finite());
            assert!(Mini::MAX.is_finite() && Mini::ONE + Mini::EPSILON > Mini::ONE);
            assert_eq!(Mini::from_f64(Mini::MAX.to_f64()), Mini::MAX);
            assert_eq!(Mini::ONE + Mini::EPSILON / Mini::from_f64(2.5), Mini::ONE);
            assert_eq!((-Mini::ZERO).canonical_bits(), Mini::ZERO.canonical_bits());
        });
    }
}

#[test]
fn a_sum_is_rounded_once() {
    MiniFormat::BF16.scope(|| {
        let mut sum = <Mini as Scalar>::Sum::ZERO;
        for _ in 0..1000 {
            sum.add(Mini::ONE);
        }
        assert_eq!(sum.total().to_f64(), 1000.0, "in bf16 itself the sum would end at 256");
        assert_eq!(sum.scaled_total(Mini::ratio(1, 2), Mini::ratio(1, 2)).to_f64(), 250.0);
    });
}
