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

#[test]
fn a_checked_sum_remembers() {
    let mut sum = Sum::<I16F16, Check>::ZERO;
    for term in [Checked::ONE, Checked::NAR, Checked::ONE, -Checked::ONE] {
        sum.add(term);
    }
    assert!(!sum.total().is_finite());
    for term in
        core::iter::repeat_n(-Checked::MAX, 100_000).chain(core::iter::repeat_n(Checked::MAX, 200_000))
    {
        sum.add(term);
    }
    assert!(!sum.total().is_finite());
}
