//! One step in time: kick, drift, kick.
//!
//! ```text
//! v½ = v + Δt/2 a        x½ = x + Δt/2 v̂        ρ′ = ρ + Δt dρ/dt(x½, v½)
//! x′ = x½ + Δt/2 v̂       walls and a′ at (x′, v½, ρ′)        v′ = v½ + Δt/2 a′
//! ```
//!
//! v̂ = v½ + δv, v½ itself without shifting. Second order, and the same backwards
//! in time where nothing dissipates.

use super::{Forces, Limits, Scheme, State, WallState};
use crate::vector::{add, norm_squared, scale};
use crate::{CellGrid, CellLayout, Error, Index, Influence, Parameter, Scalar, check};

/// How a loop over particles is run: one after another, or spread over threads. Each result depends on its number alone, so
/// every executor gives the same bits.
pub trait Executor {
    /// `out[i] = f(i)`
    fn fill<U: Send>(&self, out: &mut [U], f: impl Fn(usize) -> U + Sync);
}

/// One after another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
pub struct Particles<'a, T, const D: usize, I> {
    /// x of fluid and walls.
    pub positions: &'a mut [[T; D]],
    /// v of fluid and walls.
    pub velocities: &'a mut [[T; D]],
    /// ρ of fluid and walls.
    pub densities: &'a mut [T],
    /// p of fluid and walls.
    pub pressures: &'a mut [T],
    /// Forces on the fluid: their number says how many particles are fluid.
    pub forces: &'a mut [Forces<T, D>],
    /// δv, with which the fluid is shifted.
    pub drifts: &'a mut [[T; D]],
    /// dρ/dt of the fluid.
    pub rates: &'a mut [T],
    /// The states of the walls.
    pub walls: &'a mut [WallState<T, D>],
    /// Cells + 1 indices of the search.
    pub starts: &'a mut [I],
    /// An index of the search for each particle.
    pub entries: &'a mut [I],
}

/// The search and the state that the sums read, and the slices that they fill.
struct Parts<'a, T, const D: usize, I> {
    search: CellGrid<'a, T, I, D>,
    state: State<'a, T, D>,
    forces: &'a mut [Forces<T, D>],
    rates: &'a mut [T],
    walls: &'a mut [WallState<T, D>],
}

impl<T: Scalar, const D: usize, I: Index> Particles<'_, T, D, I> {
    /// The lengths agree.
    fn check(&self) -> Result<(), Error> {
        let (all, fluid) = (self.positions.len(), self.forces.len());
        check::length(self.velocities.len(), all, Parameter::Velocity)?;
        check::length(self.densities.len(), all, Parameter::Density)?;
        check::length(self.pressures.len(), all, Parameter::Value)?;
        check::length(self.drifts.len(), fluid, Parameter::Velocity)?;
        check::length(self.rates.len(), fluid, Parameter::Density)?;
        check::length(self.walls.len(), all.saturating_sub(fluid), Parameter::Position)
    }

    /// What the sums read, and beside it the slices that they fill.
    fn parts(&mut self, layout: CellLayout<T, D>) -> Parts<'_, T, D, I> {
        let state = State {
            fluid: self.forces.len(),
            velocities: self.velocities,
            densities: self.densities,
            pressures: self.pressures,
            drifts: self.drifts,
        };
        let search = CellGrid::from_sorted(layout, self.positions, self.starts, self.entries);
        Parts { search, state, forces: self.forces, rates: self.rates, walls: self.walls }
    }

    /// The greatest speed and the greatest acceleration of the fluid.
    pub fn extremes(&self) -> (T, T) {
        let greatest = |squares: T, vector: &[T; D]| squares.max(norm_squared(vector));
        let fluid = self.velocities.iter().take(self.forces.len());
        let speed = fluid.fold(T::ZERO, greatest);
        let pull = self.forces.iter().map(|force| &force.acceleration).fold(T::ZERO, greatest);
        (speed.sqrt(), pull.sqrt())
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D> + Sync> Scheme<T, D, W> {
    /// Works out pressures, walls and forces from positions, velocities and densities: before the first step, and whenever the
    /// caller has changed any of these.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] where slices do not agree, and what [`CellGrid::build`] reports: [`Error::NotFinite`] or
    /// [`Error::OutsideDomain`] for a particle that is nowhere.
    pub fn prepare<I: Index>(
        &self,
        particles: &mut Particles<T, D, I>,
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
    pub fn step<I: Index>(
        &self,
        particles: &mut Particles<T, D, I>,
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
    pub fn stable_step<I: Index>(&self, particles: &Particles<T, D, I>, limits: &Limits<T>) -> T {
        let (speed, acceleration) = particles.extremes();
        self.longest_step(limits, speed, acceleration)
    }

    fn drift<I>(&self, particles: &mut Particles<T, D, I>, dt: T) {
        let moving = particles.velocities.iter().zip(particles.drifts.iter());
        for (position, (velocity, drift)) in particles.positions.iter_mut().zip(moving) {
            let moved = add(position, &scale(&add(velocity, drift), dt));
            *position = self.layout.domain().wrap(&moved);
        }
    }

    fn update_rates<I: Index>(
        &self,
        particles: &mut Particles<T, D, I>,
        executor: &impl Executor,
    ) -> Result<(), Error> {
        CellGrid::build(self.layout, particles.positions, particles.starts, particles.entries)?;
        let Parts { search, state, forces, rates, .. } = particles.parts(self.layout);
        executor.fill(rates, |i| self.density_rate(&search, &state, forces, i).unwrap_or(T::ZERO));
        Ok(())
    }

    fn update_forces<I: Index>(
        &self,
        particles: &mut Particles<T, D, I>,
        executor: &impl Executor,
    ) -> Result<(), Error> {
        CellGrid::build(self.layout, particles.positions, particles.starts, particles.entries)?;
        let of_fluid = particles.pressures.iter_mut().zip(particles.densities.iter());
        for (pressure, &density) in of_fluid.take(particles.forces.len()) {
            *pressure = self.liquid.equation_of_state.pressure(density);
        }
        self.update_walls(particles, executor);
        let Parts { search, state, forces, .. } = particles.parts(self.layout);
        executor.fill(forces, |i| self.forces(&search, &state, i).unwrap_or(Forces::NONE));
        Ok(())
    }

    fn update_walls<I: Index>(&self, particles: &mut Particles<T, D, I>, executor: &impl Executor) {
        let Parts { search, state, walls, .. } = particles.parts(self.layout);
        let rest = WallState::at_rest(&self.liquid.equation_of_state);
        executor
            .fill(walls, |wall| self.wall(&search, &state, state.fluid.wrapping_add(wall)).unwrap_or(rest));
        let of_walls = particles.velocities.iter_mut().zip(particles.densities.iter_mut());
        let of_walls = of_walls.zip(particles.pressures.iter_mut()).skip(particles.forces.len());
        for (((velocity, density), pressure), wall) in of_walls.zip(particles.walls.iter()) {
            (*velocity, *density, *pressure) = (wall.velocity, wall.density, wall.pressure);
        }
    }
}

/// v + Δt a, of the fluid.
fn kick<T: Scalar, const D: usize, I>(particles: &mut Particles<T, D, I>, dt: T) {
    for (velocity, force) in particles.velocities.iter_mut().zip(particles.forces.iter()) {
        *velocity = add(velocity, &scale(&force.acceleration, dt));
    }
}
