//! What accelerates a particle.

use super::gradient::DensityGradient;
use super::{Pairs, Scheme, Seen, State};
use crate::field::Quantity;
use crate::vector::{add, dot, norm_squared, scale, sub};
use crate::{Influence, Neighbour, Scalar};

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

/// The sums of one particle.
struct Sums<T: Scalar, const D: usize> {
    pull: [T::Sum; D],
    shift: [T::Sum; D],
    density_gradient: DensityGradient<T, D>,
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// What accelerates fluid particle i; `None` where there is no such particle.
    pub fn forces(&self, pairs: &impl Pairs<T, D>, state: &State<T, D>, i: usize) -> Option<Forces<T, D>> {
        let own = state.seen.get(i)?;
        let own_drift = state.drifts.get(i)?;
        let liquid = &self.liquid;
        let none = <[T; D] as Quantity<T>>::EMPTY;
        let mut sums = Sums { pull: none, shift: none, density_gradient: DensityGradient::EMPTY };
        pairs.for_each_of(i, self.influence.support_radius(), |neighbour| {
            let Some(other) = state.seen.get(neighbour.index) else { return };
            let slope = self.influence.slope(neighbour.distance_squared);
            let is_fluid = neighbour.index < state.fluid;
            let stress = self.stress(own, other, &neighbour, is_fluid);
            neighbour.offset.add_to(&mut sums.pull, -(self.mass * stress * slope));
            if liquid.kinematic_viscosity > T::ZERO {
                let factor = liquid.kinematic_viscosity * (own.volume + other.volume) * slope;
                sub(&own.velocity, &other.velocity).add_to(&mut sums.pull, factor);
            }
            if liquid.density_diffusion > T::ZERO {
                let excess = other.density - own.density;
                sums.density_gradient.add(&neighbour.offset, other.volume * slope, excess);
            }
            if liquid.shift_speed > T::ZERO {
                let drift = state.drifts.get(neighbour.index);
                sums.shift(own, other, own_drift, drift, &scale(&neighbour.offset, slope));
            }
        });
        let pull = <[T; D]>::total(sums.pull);
        Some(Forces {
            acceleration: add(&pull, &liquid.gravity),
            shift: self.limited_shift(&<[T; D]>::total(sums.shift)),
            density_gradient: sums.density_gradient.total(),
        })
    }

    /// p_i/ρ_i² + p_j/ρ_j² + Π_ij; of a wall without Π and not below zero, for walls push and do not pull.
    #[inline(always)]
    fn stress(&self, own: &Seen<T, D>, other: &Seen<T, D>, pair: &Neighbour<T, D>, is_fluid: bool) -> T {
        let pressure = own.push + other.push;
        let approach = dot(&sub(&own.velocity, &other.velocity), &pair.offset).min(T::ZERO);
        let length = self.length();
        let softened = pair.distance_squared + length * length * T::ratio(1, 100);
        let mean_density = (own.density + other.density) * T::ratio(1, 2);
        let strength =
            self.liquid.artificial_viscosity * self.liquid.equation_of_state.sound_speed() * length;
        let viscous = pressure - strength * approach / (softened * mean_density);
        if is_fluid { viscous } else { pressure.positive_part() }
    }

    /// −u_s h Σ V_j ∇W, no longer than u_s/2.
    fn limited_shift(&self, sum: &[T; D]) -> [T; D] {
        let speed = self.liquid.shift_speed;
        let shift = scale(sum, -speed * self.influence.support_radius());
        let (length, most) = (norm_squared(&shift).sqrt(), speed * T::ratio(1, 2));
        if length > most { scale(&shift, most / length) } else { shift }
    }
}

impl<T: Scalar, const D: usize> Sums<T, D> {
    /// Σ V_j ∇W, and the stress of what is carried by the shifts.
    #[inline(always)]
    fn shift(
        &mut self,
        own: &Seen<T, D>,
        other: &Seen<T, D>,
        own_drift: &[T; D],
        drift: Option<&[T; D]>,
        gradient: &[T; D],
    ) {
        gradient.add_to(&mut self.shift, other.volume);
        own.velocity.add_to(&mut self.pull, dot(own_drift, gradient) * own.volume);
        if let Some(drift) = drift {
            other.velocity.add_to(&mut self.pull, dot(drift, gradient) * other.volume);
        }
    }
}
