//! The differences between modes and between formats.

use super::*;
use std::string::ToString;

fn layout<F: Format, O: Overflow>() {
    assert_eq!(size_of::<Fixed<F, O>>(), size_of::<F>());
    assert_eq!(count(Fixed::<F, O>::ONE), (1 << F::FRAC_NBITS).min(largest::<F>()));
    assert_eq!(count(Fixed::<F, O>::EPSILON), 1);
    assert_eq!(count(Fixed::<F, O>::default()), 0);
    assert!(Fixed::<F, O>::MAX.is_finite());
    assert!(count(Fixed::<F, O>::MAX) >= largest::<F>() - 1);
    assert_eq!(Fixed::<F, O>::from(F::ONE).get(), F::ONE);
}

#[test]
fn as_large_as_the_word_and_honest_about_it() {
    every!(layout());
    assert_eq!(I16F16::from(Checked::<I16F16>::ONE), I16F16::ONE);
}

#[test]
fn names() {
    assert_eq!(Saturating::<I16F16>::NAME, "i16f16");
    assert_eq!(Wrapping::<I32F32>::NAME, "wrapping-i32f32");
    assert_eq!(Checked::<I4F12>::NAME, "checked-i4f12");
    assert_eq!(Saturating::<I1F7>::NAME, "i1f7");
    assert_eq!(Wrapping::<I32F0>::NAME, "wrapping-i32f0");
}

fn division_by_zero<F: Format, O: Overflow>() {
    let (zero, one) = (Fixed::<F, O>::ZERO, Fixed::<F, O>::ONE);
    let numerators = [one, -one, zero];
    let expected = match O::NAME_INDEX {
        0 => [largest::<F>(), -largest::<F>(), 0],
        1 => [0; 3],
        _ => [-largest::<F>() - 1; 3],
    };
    assert_eq!(numerators.map(|numerator| count(numerator / zero)), expected);
    let ratios = [(1, 0), (-1, 0), (0, 0)].map(|(n, d)| count(Fixed::<F, O>::ratio(n, d)));
    assert_eq!(ratios, expected);
    let infinities = [f64::INFINITY, f64::NEG_INFINITY, f64::NAN].map(|x| count(Fixed::<F, O>::from_f64(x)));
    assert_eq!(infinities, expected);
}

#[test]
fn what_no_number_is() {
    every!(division_by_zero());
    assert_eq!(Saturating::<I8F24>::from_f64(-2.0).sqrt().to_f64(), 0.0);
    assert_eq!(Wrapping::<I8F24>::from_f64(-2.0).sqrt().to_f64(), 0.0);
    assert!(!Checked::<I8F24>::from_f64(-2.0).sqrt().is_finite());
}

#[test]
fn saturation_reports_itself_at_both_ends() {
    let x = Saturating::<I8F24>::from_f64(100.0);
    for end in [x + x, -x - x, x * x, -x * x, x.times(2), x / Saturating::ratio(1, 2)] {
        assert!(!end.is_finite(), "{end}");
        assert!(end.to_f64().abs() > 127.99);
    }
    assert!(x.is_finite() && (x * Saturating::ratio(127, 100)).is_finite());
    assert!(!Saturating::new(I8F24::MIN).is_finite());
    assert!((-Saturating::<I8F24>::MAX).is_finite());
}

#[test]
fn a_wrapped_number_has_nothing_to_report() {
    let x = Wrapping::<I8F24>::from_f64(100.0);
    assert_eq!((x + x).to_f64(), 200.0 - 256.0);
    assert!((x + x).is_finite());
    assert_eq!(Wrapping::<I8F24>::from_f64(1000.5).to_f64(), 1000.5 - 1024.0);
    assert!(Wrapping::new(I8F24::MIN).is_finite());
}

#[test]
fn an_overflow_sticks_through_a_computation() {
    let large = Checked::<I16F16>::from_f64(30_000.0);
    let lost = ((large + large) - large - large).positive_part().sqrt().times(0);
    assert!(!lost.is_finite());
    assert!(lost.partial_cmp(&large).is_none() && lost != lost);
    assert_eq!(lost.canonical_bits(), Checked::<I16F16>::NAR.canonical_bits());
    assert_eq!(Scalar::min(lost, large).to_f64(), 30_000.0);
}

#[test]
fn prints_decimals() {
    assert_eq!(Saturating::<I16F16>::from_f64(-1.25).to_string(), "-1.25");
    assert_eq!(std::format!("{:8.2}|", Checked::<I8F24>::ratio(1, 3)), "    0.33|");
    assert_eq!(std::format!("{:>5?}|", Checked::<I8F24>::NAR), "  NaR|");
}

struct Ends;

impl Table<1, 2> for Ends {
    const VALUES: [[f64; 2]; 1] = [[1.0, -1.0]];
}

fn table_of_ends<F: Format, O: Overflow>() {
    let entry = |i| count(Fixed::<F, O>::constant::<Ends, 1, 2>(0, i).unwrap());
    assert_eq!(entry(0), (1 << F::FRAC_NBITS).min(largest::<F>()));
    assert_eq!(entry(1), -entry(0));
}

#[test]
fn a_table_keeps_to_the_range() {
    every!(table_of_ends());
}

/// The negative end is told from NaR by `to_bits` alone, so other values never share bits.
#[test]
fn canonical_bits_tell_numbers_apart() {
    assert_eq!(Saturating::<I16F16>::from_bits(-1).canonical_bits(), 0xffff_ffff);
    assert_eq!(Saturating::<I4F12>::from_bits(-1).canonical_bits(), 0xffff);
    assert_eq!(Saturating::<I32F32>::from_bits(-1).canonical_bits(), u64::MAX);
    assert_eq!((-Saturating::<I16F16>::ZERO).canonical_bits(), 0);
}
