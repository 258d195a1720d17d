//! How fast the density changes: the continuity equation in difference form, and the diffusion of δ-SPH.

use super::{Forces, Pairs, Scheme, State};
use crate::vector::{add, dot, sub};
use crate::{Accumulator, Influence, Scalar};

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// dρ_i/dt of fluid particle i; `forces` brings the density gradients. `None` where there is no such particle.
    ///
    /// The diffusion acts between fluid particles alone, so it moves mass from one to another and makes none. Where ∇ρ is zero it
    /// is that of Molteni and Colagrossi.
    pub fn density_rate(
        &self,
        pairs: &impl Pairs<T, D>,
        state: &State<T, D>,
        forces: &[Forces<T, D>],
        i: usize,
    ) -> Option<T> {
        let own = state.seen.get(i)?;
        let own_gradient = forces.get(i)?.density_gradient;
        let (mut compression, mut diffusion) = (T::Sum::ZERO, T::Sum::ZERO);
        pairs.for_each_of(i, self.influence.support_radius(), |neighbour| {
            let j = neighbour.index;
            let Some(other) = state.seen.get(j) else { return };
            let slope = self.influence.slope(neighbour.distance_squared);
            if j >= state.fluid {
                let rate = slope * dot(&own.velocity, &neighbour.offset);
                // A wall that does not pull does not thin the fluid that leaves it.
                if rate > T::ZERO || own.push + other.push > T::ZERO {
                    compression.add(rate);
                }
                return;
            }
            compression.add(slope * dot(&sub(&own.velocity, &other.velocity), &neighbour.offset));
            let gradient =
                forces.get(j).map_or(own_gradient, |force| add(&own_gradient, &force.density_gradient));
            let expected = dot(&gradient, &neighbour.offset) * T::ratio(1, 2);
            diffusion.add((own.density - other.density - expected) * slope * other.volume);
        });
        let strength = self.liquid.density_diffusion
            * self.length()
            * self.liquid.equation_of_state.sound_speed().times(2);
        let shifted = state.drifts.get(i).map_or(T::ZERO, |drift| dot(drift, &own_gradient));
        Some(self.mass * compression.total() + strength * diffusion.total() + shifted)
    }
}
