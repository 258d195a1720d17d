//! What the terms of a pair are worked out on.

use crate::{Accumulator, Arithmetic, Scalar};

/// One scalar, or several side by side, each of a pair of its own: the terms of all sums are written once for both.
pub trait Lane<T>: Arithmetic {
    /// Running sums of terms, one for each scalar.
    type Sum: Copy;
    /// Sums of nothing.
    const EMPTY: Self::Sum;

    /// The same number for all pairs.
    fn splat(value: T) -> Self;

    /// Adds a term.
    fn add_to(self, sum: &mut Self::Sum);

    /// Adds other sums, one for each scalar.
    fn join(sum: &mut Self::Sum, other: Self::Sum);

    /// The sum of all terms of all pairs.
    fn total(sum: Self::Sum) -> T;

    /// This number where `condition` > 0, zero elsewhere.
    fn where_above_zero(self, condition: Self) -> Self;
}

impl<T: Scalar> Lane<T> for T {
    type Sum = T::Sum;
    const EMPTY: T::Sum = T::Sum::ZERO;

    #[inline(always)]
    fn splat(value: T) -> T {
        value
    }

    #[inline(always)]
    #[track_caller]
    fn add_to(self, sum: &mut T::Sum) {
        sum.add(self);
    }

    #[inline(always)]
    #[track_caller]
    fn join(sum: &mut T::Sum, other: T::Sum) {
        sum.add(other.total());
    }

    #[inline(always)]
    #[track_caller]
    fn total(sum: T::Sum) -> T {
        sum.total()
    }

    #[inline(always)]
    fn where_above_zero(self, condition: T) -> T {
        if condition.is_above_zero() { self } else { T::ZERO }
    }
}

/// x − y. As in `crate::vector`, but in a loop, like what follows: compilers keep what closures make of several numbers in memory.
#[inline(always)]
#[track_caller]
pub(crate) fn sub<A: Arithmetic, const D: usize>(x: &[A; D], y: &[A; D]) -> [A; D] {
    let mut difference = *x;
    for axis in 0..D {
        difference[axis] -= y[axis];
    }
    difference
}

/// x + y
#[inline(always)]
#[track_caller]
pub(crate) fn add<A: Arithmetic, const D: usize>(x: &[A; D], y: &[A; D]) -> [A; D] {
    let mut sum = *x;
    for axis in 0..D {
        sum[axis] += y[axis];
    }
    sum
}

/// s x
#[inline(always)]
#[track_caller]
pub(crate) fn scale<A: Arithmetic, const D: usize>(x: &[A; D], s: A) -> [A; D] {
    let mut scaled = *x;
    for axis in 0..D {
        scaled[axis] = scaled[axis] * s;
    }
    scaled
}

/// x w, added axis by axis.
#[inline(always)]
pub(crate) fn add_vector<T, A: Lane<T>, const D: usize>(sum: &mut [A::Sum; D], x: &[A; D], weight: A) {
    for axis in 0..D {
        (x[axis] * weight).add_to(&mut sum[axis]);
    }
}

/// Adds other sums, axis by axis.
#[inline(always)]
pub(crate) fn join_vector<T, A: Lane<T>, const D: usize>(sum: &mut [A::Sum; D], other: &[A::Sum; D]) {
    for axis in 0..D {
        A::join(&mut sum[axis], other[axis]);
    }
}

/// The sums axis by axis.
#[inline(always)]
pub(crate) fn total_vector<T: Scalar, A: Lane<T>, const D: usize>(sum: &[A::Sum; D]) -> [T; D] {
    let mut total = [T::ZERO; D];
    for axis in 0..D {
        total[axis] = A::total(sum[axis]);
    }
    total
}

/// The same vector for all pairs.
#[inline(always)]
pub(crate) fn splat_vector<T: Copy, A: Lane<T>, const D: usize>(x: &[T; D]) -> [A; D] {
    let mut wide = [A::ZERO; D];
    for axis in 0..D {
        wide[axis] = A::splat(x[axis]);
    }
    wide
}
