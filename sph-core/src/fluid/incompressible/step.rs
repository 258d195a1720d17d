//! One step in time: forces, projection, and the shapes at the new positions.

use super::{Scheme, Shape, Summation, Tuning};
use crate::lane::{add, scale};
use crate::vector::norm_squared;
use crate::{Error, Influence, Parameter, Scalar, check};

/// What the constraint may be off in the mean at most, however few rows there are.
const LARGEST_TOLERANCE: f64 = 8e-5;

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
    pub iterations: u32,
    /// Particles that were put back into the box.
    pub put_back: u32,
}

impl<T: Scalar, const D: usize, S> Particles<'_, T, D, S> {
    /// The lengths agree.
    fn check(&self) -> Result<(), Error> {
        let (all, fluid) = (self.positions.len(), self.shapes.len());
        check::length(self.velocities.len(), fluid, Parameter::Velocity)?;
        check::length(self.pushes.len(), fluid, Parameter::Velocity)?;
        for numbers in [&*self.pressures, self.rates, self.sources, self.trial] {
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
        let iterations = self.project(particles, dt)?;
        let put_back = self.drift(particles, dt);
        self.prepare(particles)?;
        Ok(Outcome { iterations, put_back })
    }

    /// v′ = v + Δt (forces + P(q))
    fn project<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<'_, T, D, S>,
        dt: T,
    ) -> Result<u32, Error> {
        let Particles { positions, velocities, pressures, shapes, sources, sums, .. } = particles;
        for (velocity, shape) in velocities.iter_mut().zip(shapes.iter()) {
            *velocity = add(velocity, &scale(&shape.force, dt));
        }
        sums.rates(self, positions, shapes, velocities, sources)?;
        let Tuning { closing, opening, .. } = self.tuning;
        for (source, shape) in sources.iter_mut().zip(shapes.iter()) {
            let excess = shape.density - T::ONE;
            *source = dt * *source + if excess > T::ZERO { opening } else { closing } * excess;
        }
        // the values are p/ρ₀ Δt², as b is C Δt
        let square = dt * dt;
        let (begin, end) = (square / self.rest_density, self.rest_density / square);
        pressures.iter_mut().for_each(|value| *value = *value * begin);
        let iterations = self.solve(particles, self.tolerance(particles, dt))?;
        for (velocity, push) in particles.velocities.iter_mut().zip(particles.pushes.iter()) {
            *velocity = add(velocity, &scale(push, T::ONE / dt));
        }
        particles.pressures.iter_mut().for_each(|value| *value = *value * end);
        Ok(iterations)
    }

    /// The mean of |r| at which the solution ends: of each row what [`Tuning`] allows one, over the rows.
    fn tolerance<S>(&self, particles: &Particles<'_, T, D, S>, dt: T) -> f64 {
        let rows = libm::pow(particles.shapes.len() as f64, 1.0 / D as f64);
        let moved = particles.greatest_speed() * dt / self.spacing;
        let [at_rest, in_flow] = self.tuning.tolerances;
        ((at_rest + in_flow * moved).to_f64() / rows.max(1.0)).min(LARGEST_TOLERANCE)
    }

    /// x′ = x + v Δt, inside the box. Returns how many were put back.
    fn drift<S>(&self, particles: &mut Particles<'_, T, D, S>, dt: T) -> u32 {
        let mut put_back = 0;
        for (position, velocity) in particles.positions.iter_mut().zip(particles.velocities.iter_mut()) {
            let mut is_outside = false;
            for axis in 0..D {
                let moved = position[axis] + dt * velocity[axis];
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
