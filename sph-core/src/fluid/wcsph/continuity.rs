//! How fast the density changes: the continuity equation in difference form, and the diffusion of δ-SPH.

use super::{Forces, Scheme, State};
use crate::vector::{add, dot, sub};
use crate::{Accumulator, Influence, Neighbours, Scalar};

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// dρ_i/dt of fluid particle i; `forces` brings the density gradients. `None` where there is no such particle.
    ///
    /// The diffusion acts between fluid particles alone, so it moves mass from one to another and makes none. Where ∇ρ is zero it
    /// is that of Molteni and Colagrossi.
    pub fn density_rate(
        &self,
        search: &impl Neighbours<T, D>,
        state: &State<T, D>,
        forces: &[Forces<T, D>],
        i: usize,
    ) -> Option<T> {
        let own = state.seen(i)?;
        let own_gradient = forces.get(i)?.density_gradient;
        let x = search.positions().get(i)?;
        let (mut compression, mut diffusion) = (T::Sum::ZERO, T::Sum::ZERO);
        let diffusive = self.liquid.density_diffusion > T::ZERO;
        search.for_each(x, self.influence.support_radius(), |neighbour| {
            let j = neighbour.index;
            let slope = self.influence.gradient(&neighbour.offset, neighbour.distance_squared);
            let Some(other) = state.seen(j) else { return };
            if j >= state.fluid {
                let rate = dot(&own.velocity, &slope);
                // A wall that does not pull does not thin the fluid that leaves it.
                if rate > T::ZERO || own.push() + other.push() > T::ZERO {
                    compression.add(rate);
                }
                return;
            }
            compression.add(dot(&sub(&own.velocity, &other.velocity), &slope));
            if diffusive && neighbour.distance_squared > T::ZERO {
                let gradient =
                    forces.get(j).map_or(own_gradient, |force| add(&own_gradient, &force.density_gradient));
                let expected = dot(&gradient, &neighbour.offset) * T::ratio(1, 2);
                let excess = own.density - other.density - expected;
                let factor = dot(&neighbour.offset, &slope) / neighbour.distance_squared;
                diffusion.add(excess * factor / other.density);
            }
        });
        let strength = self.liquid.density_diffusion
            * self.length()
            * self.liquid.equation_of_state.sound_speed().times(2);
        let shifted = state.drifts.get(i).map_or(T::ZERO, |drift| dot(drift, &own_gradient));
        Some(self.mass * (compression.total() + strength * diffusion.total()) + shifted)
    }
}
