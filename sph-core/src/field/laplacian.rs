//! Second derivatives from the first derivative of the kernel.
//!
//! ```text
//! Brookshaw  ∇²A_i       = 2 Σ V_j (A_i − A_j) F_ij
//! Morris     ∇·(μ∇A)_i   = Σ V_j (μ_i + μ_j) (A_i − A_j) F_ij
//! F_ij = x_ij · ∇W_ij / r²  ≤ 0,  left out at r = 0
//! ```
//!
//! Sources: L. Brookshaw, Proc. Astron. Soc. Aust. 6 (1985) 207; J. P. Morris, P. J. Fox, Y. Zhu, *Modeling low Reynolds number
//! incompressible flows using SPH*, J. Comput. Phys. 136 (1997) 214, eq. (22), there divided by ρ_i and with 0.01 h² added to
//! r², which the kernels' bounded slope makes needless here.

use super::{Field, Quantity};
use crate::vector::dot;
use crate::{Influence, InfluenceOf, Neighbours, PerSample, Scalar, Uniform};

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V> Field<'_, T, D, N, M, V> {
    /// ∇²A at sample i by Brookshaw's form, for scalar or vector values; `None` where there is no such sample.
    pub fn laplacian<Q: Quantity<T>>(&self, w: impl InfluenceOf<T, D>, i: usize) -> Option<Q>
    where
        V: PerSample<Q>,
    {
        self.diffusion(w, Uniform(T::ONE), i)
    }

    /// ∇·(μ∇A) at sample i by Morris' form, μ_j from `coefficient`; `None` where there is no such sample.
    pub fn diffusion<Q: Quantity<T>>(
        &self,
        w: impl InfluenceOf<T, D>,
        coefficient: impl PerSample<T>,
        i: usize,
    ) -> Option<Q>
    where
        V: PerSample<Q>,
    {
        let (x, own) = self.sample::<Q>(i)?;
        let own_coefficient = coefficient.get(i)?;
        let mut sum = Q::EMPTY;
        self.sources.for_each(w, &x, |neighbour, volume, influence| {
            if neighbour.distance_squared == T::ZERO {
                return;
            }
            if let (Some(value), Some(coefficient)) =
                (self.values.get(neighbour.index), coefficient.get(neighbour.index))
            {
                let slope = influence.gradient(&neighbour.offset, neighbour.distance_squared);
                let factor = dot(&neighbour.offset, &slope) / neighbour.distance_squared;
                let weight = volume * factor * (own_coefficient + coefficient);
                own.add_weighted(&mut sum, weight);
                value.add_weighted(&mut sum, -weight);
            }
        });
        Some(Q::total(sum))
    }
}
