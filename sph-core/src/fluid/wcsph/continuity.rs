//! How fast the density changes: the continuity equation in difference form, and the diffusion of δ-SPH.

use super::{Lane, Pair, Pairs, ParticleStates, Scheme, Seen};
use crate::lane::{add, sub};
use crate::vector::dot;
use crate::{Influence, Scalar};

/// The sums of one particle that make dρ/dt.
#[derive(Clone, Copy)]
pub struct RateSums<T, A: Lane<T>> {
    compression: A::Sum,
    diffusion: A::Sum,
}

impl<T: Scalar, A: Lane<T>> RateSums<T, A> {
    /// Without neighbours.
    pub const EMPTY: Self = Self { compression: A::EMPTY, diffusion: A::EMPTY };

    /// Adds the sums over other neighbours of the same particle.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        A::join(&mut self.compression, other.compression);
        A::join(&mut self.diffusion, other.diffusion);
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// dρ_i/dt of fluid particle i; `None` where there is no such particle.
    ///
    /// The diffusion acts between fluid particles alone, so it moves mass from one to another and makes none. Where ∇ρ is zero it
    /// is that of Molteni and Colagrossi.
    pub fn density_rate(
        &self,
        pairs: &impl Pairs<T, D>,
        state: &ParticleStates<T, D>,
        i: usize,
    ) -> Option<T> {
        let own = state.seen.get(i)?;
        let mut sums = RateSums::EMPTY;
        pairs.for_each_of(i, self.influence.support_radius(), |neighbour| {
            if let Some(other) = state.seen.get(neighbour.index) {
                let slope = self.influence.slope(neighbour.distance_squared);
                let pair = Pair { offset: neighbour.offset, slope };
                self.add_rate(&mut sums, own, other, &pair, neighbour.index < state.fluid);
            }
        });
        Some(self.total_rate(own, sums))
    }

    /// Adds the terms of a pair, or of several side by side, to the sums of its first particle; the second is fluid or a wall.
    #[inline(always)]
    pub fn add_rate<A: Lane<T>>(
        &self,
        sums: &mut RateSums<T, A>,
        own: &Seen<A, D>,
        other: &Seen<A, D>,
        pair: &Pair<A, D>,
        is_fluid: bool,
    ) {
        if is_fluid {
            let approach = dot(&sub(&own.velocity, &other.velocity), &pair.offset);
            (pair.slope * approach).add_to(&mut sums.compression);
            let gradient = add(&own.density_gradient, &other.density_gradient);
            let expected = dot(&gradient, &pair.offset) * A::ratio(1, 2);
            let excess = own.density - other.density - expected;
            (excess * pair.slope * other.volume).add_to(&mut sums.diffusion);
        } else {
            // A wall that does not pull does not thin the fluid that leaves it.
            let rate = pair.slope * dot(&own.velocity, &pair.offset);
            let thinning = (-rate).positive_part().where_above_zero(own.pressure_term + other.pressure_term);
            (rate.positive_part() - thinning).add_to(&mut sums.compression);
        }
    }

    /// dρ/dt of a particle from the sums over all its neighbours.
    #[inline(always)]
    pub fn total_rate<A: Lane<T>>(&self, own: &Seen<T, D>, sums: RateSums<T, A>) -> T {
        let strength = self.liquid.density_diffusion
            * self.length()
            * self.liquid.equation_of_state.sound_speed().times(2);
        let shifted = dot(&own.shift_velocity, &own.density_gradient);
        self.mass * A::total(sums.compression) + strength * A::total(sums.diffusion) + shifted
    }
}
