//! One step in time: kick, drift, kick.
//!
//! ```text
//! v½ = v + Δt/2 a        x½ = x + Δt/2 v̂        ρ′ = ρ + Δt dρ/dt(x½, v½)
//! x′ = x½ + Δt/2 v̂       p′, walls and a′ at (x′, v½, ρ′)        v′ = v½ + Δt/2 a′
//! ```
//!
//! v̂ = v½ + δv, v½ itself without shifting. Second order, and the same backwards
//! in time where nothing dissipates.

use super::{Forces, Limits, Scheme, Seen, Summation};
use crate::lane::{add, scale};
use crate::vector::norm_squared;
use crate::{Error, Influence, Parameter, Scalar, check};

/// The particles, in slices that the caller owns: n fluid particles first, then walls.
///
/// The caller sets positions, fluid velocities and fluid densities; all else is worked out from them.
#[derive(Debug)]
pub struct Particles<'a, T, const D: usize, S> {
    /// x of fluid and walls.
    pub positions: &'a mut [[T; D]],
    /// v of the fluid.
    pub velocities: &'a mut [[T; D]],
    /// ρ of the fluid.
    pub densities: &'a mut [T],
    /// Forces on the fluid: their number says how many particles are fluid.
    pub forces: &'a mut [Forces<T, D>],
    /// dρ/dt of the fluid.
    pub rates: &'a mut [T],
    /// Fluid and walls as their neighbours see them.
    pub seen: &'a mut [Seen<T, D>],
    /// What sums over neighbours.
    pub sums: &'a mut S,
}

impl<T: Scalar, const D: usize, S> Particles<'_, T, D, S> {
    /// The lengths agree.
    fn check(&self) -> Result<(), Error> {
        let (all, fluid) = (self.positions.len(), self.forces.len());
        check::length(self.seen.len(), all, Parameter::Value)?;
        check::length(self.velocities.len(), fluid, Parameter::Velocity)?;
        check::length(self.densities.len(), fluid, Parameter::Density)?;
        check::length(self.rates.len(), fluid, Parameter::Density)?;
        if fluid > all { check::length(all, fluid, Parameter::Position) } else { Ok(()) }
    }

    /// The greatest speed and the greatest acceleration of the fluid.
    pub fn extremes(&self) -> (T, T) {
        let greatest = |squares: T, vector: &[T; D]| squares.max(norm_squared(vector));
        let speed = self.velocities.iter().fold(T::ZERO, greatest);
        let pull = self.forces.iter().map(|force| &force.acceleration).fold(T::ZERO, greatest);
        (speed.sqrt(), pull.sqrt())
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Works out pressures, walls and forces from positions, velocities and densities: before the first step, and whenever the
    /// caller has changed any of these.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] where slices do not agree, and what the [`Summation`] reports: [`Error::NotFinite`] or
    /// [`Error::OutsideDomain`] for a particle that is nowhere.
    pub fn prepare<S: Summation<T, D, W>>(&self, particles: &mut Particles<T, D, S>) -> Result<(), Error> {
        particles.check()?;
        particles.seen.iter_mut().for_each(|seen| seen.shift_velocity = [T::ZERO; D]);
        self.update_forces(particles)
    }

    /// One step of length Δt.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare); the particles are then lost.
    pub fn step<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        dt: T,
    ) -> Result<(), Error> {
        particles.check()?;
        let half = dt * T::ratio(1, 2);
        kick(particles, half);
        self.drift(particles, half);
        self.update_rates(particles)?;
        for (density, &rate) in particles.densities.iter_mut().zip(particles.rates.iter()) {
            *density += dt * rate;
        }
        self.drift(particles, half);
        self.update_forces(particles)?;
        kick(particles, half);
        Ok(())
    }

    /// The longest stable step from here.
    pub fn stable_step<S>(&self, particles: &Particles<T, D, S>, limits: &Limits<T>) -> T {
        let (speed, acceleration) = particles.extremes();
        self.longest_step(limits, speed, acceleration)
    }

    fn drift<S>(&self, particles: &mut Particles<T, D, S>, dt: T) {
        let moving = particles.velocities.iter().zip(particles.forces.iter());
        for (position, (velocity, force)) in particles.positions.iter_mut().zip(moving) {
            let moved = add(position, &scale(&add(velocity, &force.shift), dt));
            *position = self.layout.domain().wrap(&moved);
        }
    }

    fn update_rates<S: Summation<T, D, W>>(&self, particles: &mut Particles<T, D, S>) -> Result<(), Error> {
        let moving = particles.velocities.iter().zip(particles.forces.iter());
        for (seen, (&velocity, force)) in particles.seen.iter_mut().zip(moving) {
            let (density_gradient, shift_velocity) = (force.density_gradient, force.shift);
            *seen = Seen { velocity, density_gradient, shift_velocity, ..*seen };
        }
        particles.sums.rates(self, particles.positions, particles.seen, particles.rates)
    }

    fn update_forces<S: Summation<T, D, W>>(&self, particles: &mut Particles<T, D, S>) -> Result<(), Error> {
        let states = particles.velocities.iter().zip(particles.densities.iter());
        for (seen, (&velocity, &density)) in particles.seen.iter_mut().zip(states) {
            let pressure = self.liquid.equation_of_state.pressure(density);
            *seen = Seen {
                shift_velocity: seen.shift_velocity,
                ..Seen::new(self.mass, velocity, density, pressure)
            };
        }
        particles.sums.forces(self, particles.positions, particles.seen, particles.forces)
    }
}

/// v + Δt a, of the fluid.
fn kick<T: Scalar, const D: usize, S>(particles: &mut Particles<T, D, S>, dt: T) {
    for (velocity, force) in particles.velocities.iter_mut().zip(particles.forces.iter()) {
        *velocity = add(velocity, &scale(&force.acceleration, dt));
    }
}
