//! Sums: exact, whatever the partial sums do.

use super::*;
use crate::Accumulator;
use proptest::prelude::*;

fn half_range<F: Format, O: Overflow>() {
    let half = number::<F, O>(largest::<F>() as i64 / 2);
    let mut sum = Sum::<F, O>::ZERO;
    for _ in 0..100_000 {
        sum.add(half);
    }
    assert_eq!(count(sum.total()), narrowed::<F, O>(count(half) * 100_000));
    for _ in 0..99_999 {
        sum.add(-half);
    }
    assert_eq!(count(sum.total()), count(half));
}

#[test]
fn a_hundred_thousand_halves_of_the_range() {
    every!(half_range());
}

fn exact<F: Format, O: Overflow>(terms: &[i64]) {
    let mut sum = Sum::<F, O>::ZERO;
    let mut expected = 0i128;
    let mut poisoned = false;
    for &term in terms {
        let term = number::<F, O>(term);
        sum.add(term);
        expected += count(term);
        poisoned |= O::STICKY && !term.is_finite();
    }
    let expected = if poisoned { -largest::<F>() - 1 } else { narrowed::<F, O>(expected) };
    assert_eq!(count(sum.total()), expected);
}

proptest! {
    #[test]
    fn any_terms(terms in prop::collection::vec((any::<i64>(), 0..64u32).prop_map(|(t, s)| t >> s), 0..40)) {
        every!(exact(&terms));
    }
}

/// b · sum is rounded to a unit, a times that once more, and the result is narrowed.
fn scaled<F: Format, O: Overflow>(terms: &[i64], a: i64, b: i64) {
    let mut sum = Sum::<F, O>::ZERO;
    let mut exact = 0i128;
    let (a, b) = (number::<F, O>(a), number::<F, O>(b));
    let mut is_nar = O::STICKY && !(a.is_finite() && b.is_finite());
    for &term in terms {
        let term = number::<F, O>(term);
        sum.add(term);
        exact += count(term);
        is_nar |= O::STICKY && !term.is_finite();
    }
    let unit = 1i128 << F::FRAC_NBITS;
    let times = |number, exact: i128| {
        let product = count::<F, O>(number).checked_mul(exact)?;
        // what the sum of a word of up to 32 bits has room for
        Some(nearest(product, unit)).filter(|&product| i64::try_from(product).is_ok())
    };
    if let Some(expected) = times(b, exact).and_then(|scaled| times(a, scaled)) {
        let expected = if is_nar { -largest::<F>() - 1 } else { narrowed::<F, O>(expected) };
        assert_eq!(count(sum.scaled_total(a, b)), expected);
    }
}

proptest! {
    #[test]
    fn any_scaled_terms(
        terms in prop::collection::vec((any::<i64>(), 0..64u32).prop_map(|(t, s)| t >> s), 0..40),
        a in (any::<i64>(), 0..64u32).prop_map(|(t, s)| t >> s),
        b in (any::<i64>(), 0..64u32).prop_map(|(t, s)| t >> s),
    ) {
        every!(scaled(&terms, a, b));
    }
}

#[test]
fn a_scaled_sum_beyond_all_bounds_is_out_of_range() {
    let mut sum = Sum::<I4F28, Saturate>::ZERO;
    for _ in 0..100 {
        sum.add(Saturating::MAX);
    }
    assert_eq!(sum.scaled_total(Saturating::MAX, Saturating::MAX).get(), I4F28::MAX);
    assert_eq!(sum.scaled_total(Saturating::MAX, -Saturating::MAX).get(), -I4F28::MAX);
    let tiny = Saturating::<I4F28>::from_bits(1);
    assert_eq!(sum.scaled_total(tiny, tiny).get(), 0);
}

#[test]
fn a_checked_sum_remembers() {
    let mut sum = Sum::<I16F16, Check>::ZERO;
    for term in [Checked::ONE, Checked::NAR, Checked::ONE, -Checked::ONE] {
        sum.add(term);
    }
    assert!(!sum.total().is_finite());
    assert!(!sum.scaled_total(Checked::ZERO, Checked::ONE).is_finite());
    for term in [Checked::NAR, -Checked::ONE] {
        sum.add(term);
    }
    assert!(!sum.scaled_total(Checked::ZERO, Checked::ONE).is_finite(), "a negative term hides NaR");
    for term in
        core::iter::repeat_n(-Checked::MAX, 100_000).chain(core::iter::repeat_n(Checked::MAX, 200_000))
    {
        sum.add(term);
    }
    assert!(!sum.total().is_finite());
}
