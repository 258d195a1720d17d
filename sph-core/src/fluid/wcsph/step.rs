//! One step in time: kick, drift, kick.
//!
//! ```text
//! v½ = v + Δt/2 a        x½ = x + Δt/2 v̂        ρ′ = ρ + Δt dρ/dt(x½, v½)
//! x′ = x½ + Δt/2 v̂       walls and a′ at (x′, v½, ρ′)        v′ = v½ + Δt/2 a′
//! ```
//!
//! v̂ = v½ + δv, v½ itself without shifting. Second order, and the same backwards
//! in time where nothing dissipates.

use super::{Forces, Limits, Scheme, Search, Seen, State, WallState};
use crate::vector::{add, norm_squared, scale};
use crate::{Error, Influence, Parameter, Scalar, check};

/// How a loop over particles is run: one after another, or spread over threads. Each result depends on its number alone, so
/// every executor gives the same bits.
pub trait Executor {
    /// `out[i] = f(i)`
    fn fill<U: Send>(&self, out: &mut [U], f: impl Fn(usize) -> U + Sync);
}

/// One after another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sequential;

impl Executor for Sequential {
    #[inline(always)]
    fn fill<U: Send>(&self, out: &mut [U], f: impl Fn(usize) -> U + Sync) {
        for (i, slot) in out.iter_mut().enumerate() {
            *slot = f(i);
        }
    }
}

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
    /// p of the fluid.
    pub pressures: &'a mut [T],
    /// Forces on the fluid: their number says how many particles are fluid.
    pub forces: &'a mut [Forces<T, D>],
    /// δv, with which the fluid is shifted.
    pub drifts: &'a mut [[T; D]],
    /// dρ/dt of the fluid.
    pub rates: &'a mut [T],
    /// The states of the walls.
    pub walls: &'a mut [WallState<T, D>],
    /// Fluid and walls as their neighbours see them.
    pub seen: &'a mut [Seen<T, D>],
    /// What finds neighbours.
    pub search: S,
}

impl<T: Scalar, const D: usize, S> Particles<'_, T, D, S> {
    /// The lengths agree.
    fn check(&self) -> Result<(), Error> {
        let (all, fluid) = (self.positions.len(), self.forces.len());
        check::length(self.seen.len(), all, Parameter::Value)?;
        check::length(self.velocities.len(), fluid, Parameter::Velocity)?;
        check::length(self.densities.len(), fluid, Parameter::Density)?;
        check::length(self.pressures.len(), fluid, Parameter::Value)?;
        check::length(self.drifts.len(), fluid, Parameter::Velocity)?;
        check::length(self.rates.len(), fluid, Parameter::Density)?;
        check::length(self.walls.len(), all.saturating_sub(fluid), Parameter::Position)
    }

    /// The greatest speed and the greatest acceleration of the fluid.
    pub fn extremes(&self) -> (T, T) {
        let greatest = |squares: T, vector: &[T; D]| squares.max(norm_squared(vector));
        let speed = self.velocities.iter().fold(T::ZERO, greatest);
        let pull = self.forces.iter().map(|force| &force.acceleration).fold(T::ZERO, greatest);
        (speed.sqrt(), pull.sqrt())
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D> + Sync> Scheme<T, D, W> {
    /// Works out pressures, walls and forces from positions, velocities and densities: before the first step, and whenever the
    /// caller has changed any of these.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] where slices do not agree, and what [`Search::find`] reports: [`Error::NotFinite`] or
    /// [`Error::OutsideDomain`] for a particle that is nowhere.
    pub fn prepare<S: Search<T, D>>(
        &self,
        particles: &mut Particles<T, D, S>,
        executor: &impl Executor,
    ) -> Result<(), Error> {
        particles.check()?;
        particles.drifts.fill([T::ZERO; D]);
        self.update_forces(particles, executor)
    }

    /// One step of length Δt.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare); the particles are then lost.
    pub fn step<S: Search<T, D>>(
        &self,
        particles: &mut Particles<T, D, S>,
        dt: T,
        executor: &impl Executor,
    ) -> Result<(), Error> {
        particles.check()?;
        let half = dt * T::ratio(1, 2);
        kick(particles, half);
        for (drift, force) in particles.drifts.iter_mut().zip(particles.forces.iter()) {
            *drift = force.shift;
        }
        self.drift(particles, half);
        self.update_rates(particles, executor)?;
        for (density, &rate) in particles.densities.iter_mut().zip(particles.rates.iter()) {
            *density += dt * rate;
        }
        self.drift(particles, half);
        self.update_forces(particles, executor)?;
        kick(particles, half);
        Ok(())
    }

    /// The longest stable step from here.
    pub fn stable_step<S>(&self, particles: &Particles<T, D, S>, limits: &Limits<T>) -> T {
        let (speed, acceleration) = particles.extremes();
        self.longest_step(limits, speed, acceleration)
    }

    fn drift<S>(&self, particles: &mut Particles<T, D, S>, dt: T) {
        let moving = particles.velocities.iter().zip(particles.drifts.iter());
        for (position, (velocity, drift)) in particles.positions.iter_mut().zip(moving) {
            let moved = add(position, &scale(&add(velocity, drift), dt));
            *position = self.layout.domain().wrap(&moved);
        }
    }

    fn update_rates<S: Search<T, D>>(
        &self,
        particles: &mut Particles<T, D, S>,
        executor: &impl Executor,
    ) -> Result<(), Error> {
        for (seen, velocity) in particles.seen.iter_mut().zip(particles.velocities.iter()) {
            seen.velocity = *velocity;
        }
        let (forces, fluid) = (&*particles.forces, particles.forces.len());
        let pairs = particles.search.find(&self.layout, particles.positions, fluid)?;
        let state = State { fluid, seen: particles.seen, drifts: particles.drifts };
        executor.fill(particles.rates, |i| self.density_rate(&pairs, &state, forces, i).unwrap_or(T::ZERO));
        Ok(())
    }

    fn update_forces<S: Search<T, D>>(
        &self,
        particles: &mut Particles<T, D, S>,
        executor: &impl Executor,
    ) -> Result<(), Error> {
        let of_fluid = particles.pressures.iter_mut().zip(particles.densities.iter());
        for (pressure, &density) in of_fluid {
            *pressure = self.liquid.equation_of_state.pressure(density);
        }
        let states =
            particles.velocities.iter().zip(particles.densities.iter()).zip(particles.pressures.iter());
        for (seen, ((&velocity, &density), &pressure)) in particles.seen.iter_mut().zip(states) {
            *seen = Seen::new(self.mass, velocity, density, pressure);
        }
        let fluid = particles.forces.len();
        let pairs = particles.search.find(&self.layout, particles.positions, fluid)?;
        let state = State { fluid, seen: particles.seen, drifts: particles.drifts };
        let rest = WallState::at_rest(&self.liquid.equation_of_state);
        executor.fill(particles.walls, |wall| {
            self.wall(&pairs, &state, fluid.wrapping_add(wall)).unwrap_or(rest)
        });
        for (seen, wall) in particles.seen.iter_mut().skip(fluid).zip(particles.walls.iter()) {
            *seen = Seen::new(self.mass, wall.velocity, wall.density, wall.pressure);
        }
        let state = State { fluid, seen: particles.seen, drifts: particles.drifts };
        executor.fill(particles.forces, |i| self.forces(&pairs, &state, i).unwrap_or(Forces::NONE));
        Ok(())
    }
}

/// v + Δt a, of the fluid.
fn kick<T: Scalar, const D: usize, S>(particles: &mut Particles<T, D, S>, dt: T) {
    for (velocity, force) in particles.velocities.iter_mut().zip(particles.forces.iter()) {
        *velocity = add(velocity, &scale(&force.acceleration, dt));
    }
}
