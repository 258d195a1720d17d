//! What is summed over neighbours.

use crate::{Lane, Scalar};

/// Numbers in some arrangement that can be weighted and summed: one number, a vector or matrix `[S; N]` of summands, two of
/// them `(S, R)` side by side, or nothing, `()`.
///
/// A number is a scalar, or a [`Lane`] of several, each of a pair of its own.
pub trait Summand<T: Scalar, A: Lane<T> = T>: Copy {
    /// The running sums.
    type Sum: Copy;
    /// What they come to, in the same arrangement.
    type Total: Copy;
    /// Sums of nothing.
    const EMPTY: Self::Sum;

    /// Adds weight · self to the sums.
    fn add_weighted(self, sums: &mut Self::Sum, weight: A);
    /// Adds other sums, one for each number of a lane.
    fn join(sums: &mut Self::Sum, other: &Self::Sum);
    /// The sums of all terms of all pairs, rounded to the scalar once.
    fn total(sums: Self::Sum) -> Self::Total;
}

impl<T: Scalar, A: Lane<T>> Summand<T, A> for A {
    type Sum = A::Sum;
    type Total = T;
    const EMPTY: A::Sum = <A as Lane<T>>::EMPTY;

    #[inline(always)]
    #[track_caller]
    fn add_weighted(self, sum: &mut A::Sum, weight: A) {
        (self * weight).add_to(sum);
    }

    #[inline(always)]
    #[track_caller]
    fn join(sum: &mut A::Sum, other: &A::Sum) {
        <A as Lane<T>>::join(sum, *other);
    }

    #[inline(always)]
    #[track_caller]
    fn total(sum: A::Sum) -> T {
        <A as Lane<T>>::total(sum)
    }
}

impl<T: Scalar, A: Lane<T>, S: Summand<T, A>, const N: usize> Summand<T, A> for [S; N] {
    type Sum = [S::Sum; N];
    type Total = [S::Total; N];
    const EMPTY: Self::Sum = [S::EMPTY; N];

    #[inline(always)]
    #[track_caller]
    fn add_weighted(self, sums: &mut Self::Sum, weight: A) {
        for (component, sum) in self.iter().zip(sums) {
            component.add_weighted(sum, weight);
        }
    }

    #[inline(always)]
    #[track_caller]
    fn join(sums: &mut Self::Sum, other: &Self::Sum) {
        for (sum, other) in sums.iter_mut().zip(other) {
            S::join(sum, other);
        }
    }

    #[inline(always)]
    #[track_caller]
    fn total(sums: Self::Sum) -> Self::Total {
        // `map` is smaller on microcontrollers; several numbers side by side need a loop, which keeps the instructions of their registers
        if const { size_of::<A>() == size_of::<T>() } {
            return sums.map(S::total);
        }
        let mut total = [S::total(S::EMPTY); N];
        for (total, sum) in total.iter_mut().zip(sums) {
            *total = S::total(sum);
        }
        total
    }
}

impl<T: Scalar, A: Lane<T>, S: Summand<T, A>, R: Summand<T, A>> Summand<T, A> for (S, R) {
    type Sum = (S::Sum, R::Sum);
    type Total = (S::Total, R::Total);
    const EMPTY: Self::Sum = (S::EMPTY, R::EMPTY);

    #[inline(always)]
    #[track_caller]
    fn add_weighted(self, sums: &mut Self::Sum, weight: A) {
        self.0.add_weighted(&mut sums.0, weight);
        self.1.add_weighted(&mut sums.1, weight);
    }

    #[inline(always)]
    #[track_caller]
    fn join(sums: &mut Self::Sum, other: &Self::Sum) {
        S::join(&mut sums.0, &other.0);
        R::join(&mut sums.1, &other.1);
    }

    #[inline(always)]
    #[track_caller]
    fn total(sums: Self::Sum) -> Self::Total {
        (S::total(sums.0), R::total(sums.1))
    }
}

impl<T: Scalar, A: Lane<T>> Summand<T, A> for () {
    type Sum = ();
    type Total = ();
    const EMPTY: () = ();

    #[inline(always)]
    #[track_caller]
    fn add_weighted(self, (): &mut (), _: A) {}

    #[inline(always)]
    #[track_caller]
    fn join((): &mut (), (): &()) {}

    #[inline(always)]
    #[track_caller]
    fn total((): ()) {}
}
