//! What accelerates a particle.

use super::{Scheme, Seen, State};
use crate::field::{Field, Quantity};
use crate::vector::{dot, norm_squared, scale, sub};
use crate::{Influence, Neighbour, Neighbours, PerSample, Scalar, Sources};

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

/// V_j = m / ρ_j
#[derive(Clone, Copy)]
struct Volumes<'a, T> {
    mass: T,
    densities: &'a [T],
}

impl<T: Scalar> PerSample<T> for Volumes<'_, T> {
    #[inline(always)]
    fn get(&self, j: usize) -> Option<T> {
        self.densities.get(j).map(|&density| self.mass / density)
    }

    fn count(&self) -> Option<usize> {
        Some(self.densities.len())
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// What accelerates fluid particle i; `None` where there is no such particle.
    pub fn forces<N: Neighbours<T, D>>(
        &self,
        search: &N,
        state: &State<T, D>,
        i: usize,
    ) -> Option<Forces<T, D>> {
        let own = state.seen(i)?;
        let x = search.positions().get(i)?;
        let own_drift = state.drifts.get(i)?;
        let shifting = self.liquid.shift_speed > T::ZERO;
        let mut pull = <[T; D] as Quantity<T>>::EMPTY;
        let mut shift = <[T; D] as Quantity<T>>::EMPTY;
        search.for_each(x, self.influence.support_radius(), |neighbour| {
            let Some(other) = state.seen(neighbour.index) else { return };
            let slope = self.influence.gradient(&neighbour.offset, neighbour.distance_squared);
            let is_fluid = neighbour.index < state.fluid;
            slope.add_to(&mut pull, -self.stress(&own, &other, &neighbour, is_fluid));
            if self.liquid.kinematic_viscosity > T::ZERO {
                let factor = self.friction(&own, &other, &neighbour, &slope);
                sub(&own.velocity, &other.velocity).add_to(&mut pull, factor);
            }
            if shifting {
                let (a, b) = (T::ONE / own.density, T::ONE / other.density);
                slope.add_to(&mut shift, b);
                own.velocity.add_to(&mut pull, dot(own_drift, &slope) * a);
                if let Some(drift) = state.drifts.get(neighbour.index) {
                    other.velocity.add_to(&mut pull, dot(drift, &slope) * b);
                }
            }
        });
        let pull = <[T; D]>::total(pull);
        let gravity = &self.liquid.gravity;
        Some(Forces {
            acceleration: core::array::from_fn(|axis| self.mass * pull[axis] + gravity[axis]),
            shift: self.limited_shift(&<[T; D]>::total(shift)),
            density_gradient: self.density_gradient(search, state, i),
        })
    }

    /// p_i/ρ_i² + p_j/ρ_j² + Π_ij; of a wall without Π and not below zero, for walls push and do not pull.
    #[inline(always)]
    fn stress(&self, own: &Seen<T, D>, other: &Seen<T, D>, pair: &Neighbour<T, D>, is_fluid: bool) -> T {
        let pressure = own.push() + other.push();
        if !is_fluid {
            return pressure.positive_part();
        }
        let approach = dot(&sub(&own.velocity, &other.velocity), &pair.offset);
        let approaching = approach < T::ZERO;
        if !approaching || self.liquid.artificial_viscosity == T::ZERO {
            return pressure;
        }
        let length = self.length();
        let softened = pair.distance_squared + length * length * T::ratio(1, 100);
        let mean_density = (own.density + other.density) * T::ratio(1, 2);
        let strength =
            self.liquid.artificial_viscosity * self.liquid.equation_of_state.sound_speed() * length;
        pressure - strength * approach / softened / mean_density
    }

    /// −u_s h m Σ ∇W/ρ_j, no longer than u_s/2.
    fn limited_shift(&self, sum: &[T; D]) -> [T; D] {
        let speed = self.liquid.shift_speed;
        let shift = scale(sum, -speed * self.influence.support_radius() * self.mass);
        let (length, most) = (norm_squared(&shift).sqrt(), speed * T::ratio(1, 2));
        if length > most { scale(&shift, most / length) } else { shift }
    }

    /// ν (1/ρ_i + 1/ρ_j) F_ij
    #[inline(always)]
    fn friction(&self, own: &Seen<T, D>, other: &Seen<T, D>, pair: &Neighbour<T, D>, slope: &[T; D]) -> T {
        if pair.distance_squared == T::ZERO {
            return T::ZERO;
        }
        let factor = dot(&pair.offset, slope) / pair.distance_squared;
        self.liquid.kinematic_viscosity * (T::ONE / own.density + T::ONE / other.density) * factor
    }

    fn density_gradient<N: Neighbours<T, D>>(&self, search: &N, state: &State<T, D>, i: usize) -> [T; D] {
        if self.liquid.density_diffusion == T::ZERO {
            return [T::ZERO; D];
        }
        let volumes = Volumes { mass: self.mass, densities: state.densities };
        let sources = Sources::assume_checked(search, volumes);
        let gradient = Field::new(&sources, state.densities)
            .ok()
            .and_then(|field| field.corrected_gradient(&self.influence, i));
        gradient.unwrap_or([T::ZERO; D])
    }
}
