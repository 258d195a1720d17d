//! What accelerates a particle.

use super::gradient::DensityGradient;
use super::{Lane, Pair, Pairs, ParticleStates, Scheme, Seen};
use crate::lane::{add, add_vector, join_vector, scale, sub, total_vector};
use crate::vector::{dot, norm_squared};
use crate::{Influence, Scalar};

/// What the sums over its neighbours give a fluid particle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Forces<T, const D: usize> {
    /// dv/dt, gravity included.
    pub acceleration: [T; D],
    /// δv = −u_s h Σ V_j ∇W, no longer than u_s/2: towards where particles are few.
    pub shift: [T; D],
    /// ∇ρ by the first-order corrected form, for the diffusion of density; zero without diffusion, and where neighbours are too
    /// few for it.
    pub density_gradient: [T; D],
}

impl<T: Scalar, const D: usize> Forces<T, D> {
    /// No force.
    pub const NONE: Self =
        Self { acceleration: [T::ZERO; D], shift: [T::ZERO; D], density_gradient: [T::ZERO; D] };
}

/// The sums of one particle that make its [`Forces`].
#[derive(Clone, Copy)]
pub struct ForceSums<T, A: Lane<T>, const D: usize> {
    pull: [A::Sum; D],
    shift: [A::Sum; D],
    density_gradient: DensityGradient<T, A, D>,
}

impl<T: Scalar, A: Lane<T>, const D: usize> ForceSums<T, A, D> {
    /// Without neighbours.
    pub const EMPTY: Self =
        Self { pull: [A::EMPTY; D], shift: [A::EMPTY; D], density_gradient: DensityGradient::EMPTY };

    /// Adds the sums over other neighbours of the same particle.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        join_vector::<T, A, D>(&mut self.pull, &other.pull);
        join_vector::<T, A, D>(&mut self.shift, &other.shift);
        self.density_gradient.join(&other.density_gradient);
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// What accelerates fluid particle i; `None` where there is no such particle.
    pub fn forces(
        &self,
        pairs: &impl Pairs<T, D>,
        state: &ParticleStates<T, D>,
        i: usize,
    ) -> Option<Forces<T, D>> {
        let own = state.seen.get(i)?;
        let mut sums = ForceSums::EMPTY;
        pairs.for_each_of(i, self.influence.support_radius(), |neighbour| {
            if let Some(other) = state.seen.get(neighbour.index) {
                let slope = self.influence.slope(neighbour.distance_squared);
                let pair = Pair { offset: neighbour.offset, slope };
                self.add_force(&mut sums, own, other, &pair, neighbour.index < state.fluid);
            }
        });
        Some(self.total_forces(sums))
    }

    /// Adds the terms of a pair, or of several side by side, to the sums of its first particle; the second is fluid or a wall.
    #[inline(always)]
    pub fn add_force<A: Lane<T>>(
        &self,
        sums: &mut ForceSums<T, A, D>,
        own: &Seen<A, D>,
        other: &Seen<A, D>,
        pair: &Pair<A, D>,
        is_fluid: bool,
    ) {
        let liquid = &self.liquid;
        let stress = self.stress(own, other, pair, is_fluid);
        add_vector::<T, A, D>(&mut sums.pull, &pair.offset, -(A::splat(self.mass) * stress * pair.slope));
        if liquid.kinematic_viscosity > T::ZERO {
            let factor = A::splat(liquid.kinematic_viscosity) * (own.volume + other.volume) * pair.slope;
            add_vector::<T, A, D>(&mut sums.pull, &sub(&own.velocity, &other.velocity), factor);
        }
        if liquid.density_diffusion > T::ZERO {
            let excess = other.density - own.density;
            sums.density_gradient.add(&pair.offset, other.volume * pair.slope, excess);
        }
        if liquid.shift_speed > T::ZERO {
            sums.shift(own, other, &scale(&pair.offset, pair.slope));
        }
    }

    /// The forces that sums over all neighbours make.
    #[inline(always)]
    pub fn total_forces<A: Lane<T>>(&self, sums: ForceSums<T, A, D>) -> Forces<T, D> {
        Forces {
            acceleration: add(&total_vector::<T, A, D>(&sums.pull), &self.liquid.gravity),
            shift: if self.liquid.shift_speed > T::ZERO {
                self.limited_shift(&total_vector::<T, A, D>(&sums.shift))
            } else {
                [T::ZERO; D]
            },
            density_gradient: if self.liquid.density_diffusion > T::ZERO {
                sums.density_gradient.total()
            } else {
                [T::ZERO; D]
            },
        }
    }

    /// p_i/ρ_i² + p_j/ρ_j² + Π_ij; of a wall without Π and not below zero, for walls push and do not pull.
    #[inline(always)]
    fn stress<A: Lane<T>>(
        &self,
        own: &Seen<A, D>,
        other: &Seen<A, D>,
        pair: &Pair<A, D>,
        is_fluid: bool,
    ) -> A {
        let pressure = own.pressure_term + other.pressure_term;
        if !is_fluid {
            return pressure.positive_part();
        }
        let approach = (-dot(&sub(&own.velocity, &other.velocity), &pair.offset)).positive_part();
        let length = self.length();
        let softened = norm_squared(&pair.offset) + A::splat(length * length * T::ratio(1, 100));
        let mean_density = (own.density + other.density) * A::ratio(1, 2);
        let strength =
            self.liquid.artificial_viscosity * self.liquid.equation_of_state.sound_speed() * length;
        pressure + A::splat(strength) * approach / (softened * mean_density)
    }

    /// −u_s h Σ V_j ∇W, no longer than u_s/2.
    #[inline]
    fn limited_shift(&self, sum: &[T; D]) -> [T; D] {
        let speed = self.liquid.shift_speed;
        let shift = scale(sum, -speed * self.influence.support_radius());
        let (length, most) = (norm_squared(&shift).sqrt(), speed * T::ratio(1, 2));
        if length > most { scale(&shift, most / length) } else { shift }
    }
}

impl<T: Scalar, A: Lane<T>, const D: usize> ForceSums<T, A, D> {
    /// Σ V_j ∇W, and the stress of what is carried by the shifts.
    #[inline(always)]
    fn shift(&mut self, own: &Seen<A, D>, other: &Seen<A, D>, gradient: &[A; D]) {
        add_vector::<T, A, D>(&mut self.shift, gradient, other.volume);
        add_vector::<T, A, D>(&mut self.pull, &own.velocity, dot(&own.shift_velocity, gradient) * own.volume);
        add_vector::<T, A, D>(
            &mut self.pull,
            &other.velocity,
            dot(&other.shift_velocity, gradient) * other.volume,
        );
    }
}
