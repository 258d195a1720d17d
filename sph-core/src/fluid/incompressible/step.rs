//! One step in time: forces, projection, correction, and the shapes at the new positions.

use super::{Constraint, Scheme, Shape, Summation};
use crate::lane::{add, scale};
use crate::vector::norm_squared;
use crate::{Error, Influence, Parameter, Scalar, check};

/// The most that the correction moves a particle along an axis, in spacings.
const LONGEST_SHIFT: (i32, i32) = (1, 10);

/// The particles, in slices that the caller owns: n fluid particles first, then walls.
///
/// The caller sets positions, velocities and, where they are known, pressures; all else is worked out from them.
#[derive(Debug)]
pub struct Particles<'a, T, const D: usize, S> {
    /// x of fluid and walls.
    pub positions: &'a mut [[T; D]],
    /// v of the fluid.
    pub velocities: &'a mut [[T; D]],
    /// p of the fluid.
    pub pressures: &'a mut [T],
    /// s, the values of the last correction; zero to begin with.
    pub shifts: &'a mut [T],
    /// Shapes of the fluid: their number says how many particles are fluid.
    pub shapes: &'a mut [Shape<T, D>],
    /// A vector for each fluid particle.
    pub pushes: &'a mut [[T; D]],
    /// A number for each fluid particle.
    pub rates: &'a mut [T],
    /// Another.
    pub sources: &'a mut [T],
    /// Another.
    pub trial: &'a mut [T],
    /// What sums over neighbours.
    pub sums: &'a mut S,
}

/// What a step took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Outcome {
    /// Iterations of the projection.
    pub projection: u32,
    /// Iterations of the correction.
    pub correction: u32,
    /// Particles that were put back into the box.
    pub put_back: u32,
}

impl<T: Scalar, const D: usize, S> Particles<'_, T, D, S> {
    /// The lengths agree.
    fn check(&self) -> Result<(), Error> {
        let (all, fluid) = (self.positions.len(), self.shapes.len());
        check::length(self.velocities.len(), fluid, Parameter::Velocity)?;
        check::length(self.pushes.len(), fluid, Parameter::Velocity)?;
        for numbers in [&*self.pressures, self.shifts, self.rates, self.sources, self.trial] {
            check::length(numbers.len(), fluid, Parameter::Value)?;
        }
        if fluid > all { check::length(all, fluid, Parameter::Position) } else { Ok(()) }
    }

    /// The greatest speed of the fluid.
    pub fn greatest_speed(&self) -> T {
        let greatest = |squares: T, vector: &[T; D]| squares.max(norm_squared(vector));
        self.velocities.iter().fold(T::ZERO, greatest).sqrt()
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Works out shapes from positions and velocities: before the first step, and whenever the caller has changed any of these.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] where slices do not agree, and what the [`Summation`] reports: [`Error::NotFinite`] or
    /// [`Error::OutsideDomain`] for a particle that is nowhere.
    pub fn prepare<S: Summation<T, D, W>>(&self, particles: &mut Particles<T, D, S>) -> Result<(), Error> {
        particles.check()?;
        let Particles { positions, velocities, shapes, sums, .. } = particles;
        sums.shapes(self, positions, velocities, shapes)
    }

    /// One step of length Δt. The scheme's gravity is that at its end; what the last step or [`prepare`](Self::prepare) was told
    /// acts in this one.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare); the particles are then lost.
    pub fn step<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        dt: T,
    ) -> Result<Outcome, Error> {
        particles.check()?;
        let projection = self.project(particles, dt)?;
        let correction = self.correct(particles, dt)?;
        let put_back = self.drift(particles, dt);
        self.prepare(particles)?;
        Ok(Outcome { projection, correction, put_back })
    }

    /// v′ = v + Δt (forces + P(q))
    fn project<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        dt: T,
    ) -> Result<u32, Error> {
        let tuning = &self.tuning;
        for (velocity, shape) in particles.velocities.iter_mut().zip(particles.shapes.iter()) {
            *velocity = add(velocity, &scale(&shape.force, dt));
        }
        self.source_of_velocities(particles, Constraint::Projection)?;
        for (source, shape) in particles.sources.iter_mut().zip(particles.shapes.iter()) {
            let lack = (T::ONE - shape.density).positive_part();
            *source = dt * *source - tuning.closing * lack;
        }
        // the values are p/ρ₀ Δt², as b is C Δt
        let square = dt * dt;
        let start = square * tuning.warm_start[0] / self.rest_density;
        particles.pressures.iter_mut().for_each(|value| *value = *value * start);
        let fall = norm_squared(&self.gravity).sqrt() * square / self.spacing;
        let mut tolerance = tuning.projection_tolerance;
        if fall > T::ZERO {
            tolerance = tolerance.min(tuning.fall_tolerance * fall);
        }
        let iterations = self.solve(particles, Constraint::Projection, tolerance)?;
        for (velocity, push) in particles.velocities.iter_mut().zip(particles.pushes.iter()) {
            *velocity = add(velocity, &scale(push, T::ONE / dt));
        }
        let end = self.rest_density / square;
        particles.pressures.iter_mut().for_each(|value| *value = *value * end);
        Ok(iterations)
    }

    /// s and P(s), with which [`drift`](Self::drift) moves particles.
    fn correct<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        dt: T,
    ) -> Result<u32, Error> {
        let start = self.tuning.warm_start[1];
        self.source_of_velocities(particles, Constraint::Correction)?;
        for (source, shape) in particles.sources.iter_mut().zip(particles.shapes.iter()) {
            *source = shape.density - T::ONE + dt * *source;
        }
        particles.shifts.iter_mut().for_each(|value| *value = *value * start);
        self.solve(particles, Constraint::Correction, self.tuning.correction_tolerance)
    }

    fn source_of_velocities<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        constraint: Constraint,
    ) -> Result<(), Error> {
        let Particles { positions, velocities, shapes, sources, sums, .. } = particles;
        sums.rates(self, constraint, positions, shapes, velocities, sources)
    }

    /// x′ = x + v Δt + P(s), the last no longer than a tenth of the spacing, and inside the box. Returns how many were put back.
    fn drift<S>(&self, particles: &mut Particles<T, D, S>, dt: T) -> u32 {
        let most = self.spacing * T::ratio(LONGEST_SHIFT.0, LONGEST_SHIFT.1);
        let mut put_back = 0;
        let moving = particles.velocities.iter_mut().zip(particles.pushes.iter());
        for (position, (velocity, push)) in particles.positions.iter_mut().zip(moving) {
            let mut is_outside = false;
            for axis in 0..D {
                let shift = push[axis].max(-most).min(most);
                let moved = position[axis] + (dt * velocity[axis] + shift);
                let [lower, upper] = self.inside[axis];
                position[axis] = moved;
                if moved < lower || moved > upper {
                    is_outside = true;
                    position[axis] = if moved < lower { lower } else { upper };
                    velocity[axis] = T::ZERO;
                }
            }
            put_back += u32::from(is_outside);
            *position = self.layout.domain().wrap(position);
        }
        put_back
    }
}
