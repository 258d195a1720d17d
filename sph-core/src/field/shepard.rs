//! Shepard's form: A(x) = Σ V_j A_j W / Σ V_j W, exact for constants, and the gradient of that quotient.
//!
//! ```text
//! ∇A = (Σ V_j A_j ∇W − A Σ V_j ∇W) / Σ V_j W
//! ```
//!
//! Source: D. Shepard, *A two-dimensional interpolation function for irregularly-spaced data*, Proc. ACM Nat. Conf. (1968) 517.

use super::{Estimate, Field, Plain, PlainWithGradient, Quantity, Reads, SumOf, Summand, Term};
use crate::{InfluenceOf, Lane, Neighbours, PerSample, Scalar};

/// A(x) = Σ V_j A_j W / Σ V_j W, in the unit of A.
#[derive(Clone, Copy, Debug)]
pub struct Shepard;

/// Shepard's form and its gradient.
#[derive(Clone, Copy, Debug)]
pub struct ShepardWithGradient;

impl<T: Scalar, const D: usize> Estimate<T, D> for Shepard {
    const READS: Reads = Reads::INFLUENCE;
    /// Σ V_j W
    type Moments<A: Lane<T>> = A;
    /// Σ V_j A_j W
    type Sums<A: Lane<T>> = A;
    type Basis = T;

    #[inline(always)]
    fn add_moments<A: Lane<T>>(weights: &mut A::Sum, term: &impl Term<A, D>) {
        (term.weight() * term.influence()).add_to(weights);
    }

    #[inline(always)]
    fn add<A: Lane<T>>(sum: &mut A::Sum, term: &impl Term<A, D>, value: A) {
        Plain::add(sum, term, value);
    }

    #[inline(always)]
    fn basis(weights: T, _: T) -> Option<T> {
        weights.is_above_zero().then_some(weights)
    }

    #[inline(always)]
    fn finish(weights: &T, values: T) -> Option<(T, [T; D])> {
        Some((values / *weights, [T::ZERO; D]))
    }
}

impl<T: Scalar, const D: usize> Estimate<T, D> for ShepardWithGradient {
    const READS: Reads = Reads::BOTH;
    /// Σ V_j W and Σ V_j ∇W
    type Moments<A: Lane<T>> = (A, [A; D]);
    /// Σ V_j A_j W and Σ V_j A_j ∇W
    type Sums<A: Lane<T>> = (A, [A; D]);
    type Basis = (T, [T; D]);

    #[inline(always)]
    fn add_moments<A: Lane<T>>(
        (weights, slopes): &mut SumOf<T, A, Self::Moments<A>>,
        term: &impl Term<A, D>,
    ) {
        let (influence, gradient) = term.influence_and_gradient();
        (term.weight() * influence).add_to(weights);
        gradient.add_weighted(slopes, term.weight());
    }

    #[inline(always)]
    fn add<A: Lane<T>>(sums: &mut SumOf<T, A, Self::Sums<A>>, term: &impl Term<A, D>, value: A) {
        PlainWithGradient::add(sums, term, value);
    }

    #[inline(always)]
    fn basis(moments: (T, [T; D]), _: T) -> Option<(T, [T; D])> {
        moments.0.is_above_zero().then_some(moments)
    }

    #[inline(always)]
    fn finish((weights, weight_slopes): &(T, [T; D]), (values, slopes): (T, [T; D])) -> Option<(T, [T; D])> {
        let value = values / *weights;
        let slope = |axis: usize| (slopes[axis] - value * weight_slopes[axis]) / *weights;
        Some((value, core::array::from_fn(slope)))
    }
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V> Field<'_, T, D, N, M, V> {
    /// A(x) in the unit of A, for scalar or vector values; `None` where no sample is in reach.
    pub fn shepard_at<Q: Quantity<T>>(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> Option<Q>
    where
        V: PerSample<Q>,
    {
        self.value_at::<Shepard, Q>(w, x)
    }

    /// A(x) and ∇A(x) of a scalar field; `None` where no sample is in reach.
    pub fn shepard_gradient_at(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> Option<(T, [T; D])>
    where
        V: PerSample<T>,
    {
        self.estimate_at::<ShepardWithGradient>(w, x)
    }
}
