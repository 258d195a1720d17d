//! Shepard's form: A(x) = Σ V_j A_j W / Σ V_j W, exact for constants, and the gradient of that quotient.
//!
//! ```text
//! ∇A = (Σ V_j A_j ∇W − A Σ V_j ∇W) / Σ V_j W
//! ```
//!
//! Source: D. Shepard, *A two-dimensional interpolation function for irregularly-spaced data*, Proc. ACM Nat. Conf. (1968) 517.

use super::{Field, Quantity};
use crate::{Influence, InfluenceOf, Neighbours, PerSample, Scalar};

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V> Field<'_, T, D, N, M, V> {
    /// A(x) in the unit of A, for scalar or vector values; `None` where no sample is in reach.
    pub fn shepard_at<Q: Quantity<T>>(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> Option<Q>
    where
        V: PerSample<Q>,
    {
        let (mut values, mut weights) = (Q::EMPTY, <T as Quantity<T>>::EMPTY);
        self.sources.for_each(w, x, |neighbour, volume, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                let w = influence.influence(neighbour.distance_squared);
                value.add_to(&mut values, volume * w);
                volume.add_to(&mut weights, w);
            }
        });
        let weights = T::total(weights);
        (weights > T::ZERO).then(|| Q::total(values).divided(weights))
    }

    /// A(x) and ∇A(x) of a scalar field; `None` where no sample is in reach.
    pub fn shepard_gradient_at(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> Option<(T, [T; D])>
    where
        V: PerSample<T>,
    {
        let mut sum = <[T; 2] as Quantity<T>>::EMPTY;
        let mut slope = <[T; D] as Quantity<T>>::EMPTY;
        let mut weight_slope = slope;
        self.sources.for_each(w, x, |neighbour, volume, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                let (w, gradient) =
                    influence.value_and_gradient(&neighbour.offset, neighbour.distance_squared);
                [value, T::ONE].add_to(&mut sum, volume * w);
                gradient.add_to(&mut slope, volume * value);
                gradient.add_to(&mut weight_slope, volume);
            }
        });
        let [values, weights] = <[T; 2]>::total(sum);
        if !weights.is_above_zero() {
            return None;
        }
        let value = values / weights;
        let (slope, weight_slope) = (<[T; D]>::total(slope), <[T; D]>::total(weight_slope));
        Some((value, core::array::from_fn(|axis| (slope[axis] - value * weight_slope[axis]) / weights)))
    }
}
