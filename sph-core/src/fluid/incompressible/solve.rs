//! Least squares over values that are not negative: gradient steps scaled by the diagonal, projected, with momentum.
//!
//! ```text
//! r = b + C(P(y))          x′ = (y + ω r / d)₊          y′ = (x′ + β (x′ − x))₊,   β = (t − 1)/t′,  t′ = ½ (1 + √(1 + 4 t²))
//! ```
//!
//! and y′ = x′, t′ = 1 where the step x′ − x goes back against y − x′. It converges for ω below one over the greatest eigenvalue of
//! D⁻¹A, A = −C P: 2.6 to 2.8 in two dimensions and 4.1 to 4.4 in three, so a fixed ω = ½ diverges. The eigenvalue is
//! estimated by power iteration.

use super::{Particles, Scheme, Shape, Summation};
use crate::{Error, Influence, Scalar};

/// Which of the two constraints is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Constraint {
    /// Of velocities: walls have the pressure of the fluid before them.
    Projection,
    /// Of densities: walls have none.
    Correction,
}

/// A particle with less of the density than this has no pressure: spray.
const SPRAY: (i32, i32) = (1, 2);

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Solves a constraint whose b is in `sources`, from the values that are there; P of the result is in `pushes`. Returns how many
    /// iterations it took.
    pub(super) fn solve<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        constraint: Constraint,
        tolerance: T,
    ) -> Result<u32, Error> {
        let (relaxation, least) = match constraint {
            Constraint::Projection => (self.tuning.relaxation[0], self.tuning.least_iterations[0]),
            Constraint::Correction => (self.tuning.relaxation[1], self.tuning.least_iterations[1]),
        };
        let enough = tolerance.to_f64() * particles.shapes.len() as f64;
        self.begin(particles, constraint);
        let mut t = T::ONE;
        let mut iterations = 0;
        loop {
            self.push_and_rate(particles, constraint)?;
            let next = (T::ONE + (T::ONE + (t * t).times(4)).sqrt()) * T::ratio(1, 2);
            let step = self.improve(particles, constraint, relaxation, (t - T::ONE) / next);
            iterations += 1;
            t = next;
            if step.goes_back {
                t = T::ONE;
                particles.trial.copy_from_slice(values(particles.pressures, particles.shifts, constraint));
            }
            let is_done = step.error <= enough && iterations >= least;
            if is_done || iterations >= self.tuning.most_iterations {
                break;
            }
        }
        particles.trial.copy_from_slice(values(particles.pressures, particles.shifts, constraint));
        let (positions, shapes) = (&*particles.positions, &*particles.shapes);
        particles.sums.pushes(self, constraint, positions, shapes, particles.trial, particles.pushes)?;
        Ok(iterations)
    }

    /// Particles that cannot have a value have none.
    fn begin<S>(&self, particles: &mut Particles<T, D, S>, constraint: Constraint) {
        let values = values_mut(particles.pressures, particles.shifts, constraint);
        for (value, shape) in values.iter_mut().zip(particles.shapes.iter()) {
            if !self.has_value(shape) {
                *value = T::ZERO;
            }
        }
        particles.trial.copy_from_slice(values);
    }

    /// Whether a particle is no spray.
    fn has_value(&self, shape: &Shape<T, D>) -> bool {
        let smallest = T::ratio(1, 1000) / (self.spacing * self.spacing);
        shape.density >= T::ratio(SPRAY.0, SPRAY.1) && shape.diagonal > smallest
    }

    /// C(P(y)) in `rates`.
    fn push_and_rate<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        constraint: Constraint,
    ) -> Result<(), Error> {
        let Particles { positions, shapes, trial, pushes, rates, sums, .. } = particles;
        sums.pushes(self, constraint, positions, shapes, trial, pushes)?;
        sums.rates(self, constraint, positions, shapes, pushes, rates)
    }

    /// One step of all values, from `rates`.
    fn improve<S>(
        &self,
        particles: &mut Particles<T, D, S>,
        constraint: Constraint,
        relaxation: T,
        momentum: T,
    ) -> Progress {
        let mut progress = Progress { error: 0.0, goes_back: false };
        let mut back = 0.0;
        let values = values_mut(particles.pressures, particles.shifts, constraint);
        let known = particles.shapes.iter().zip(particles.sources.iter()).zip(particles.rates.iter());
        for (((shape, &source), &rate), (value, trial)) in
            known.zip(values.iter_mut().zip(particles.trial.iter_mut()))
        {
            if !self.has_value(shape) {
                continue;
            }
            let residual = source + rate;
            let error = if *trial > T::ZERO { residual.max(-residual) } else { residual.positive_part() };
            let next = (*trial + relaxation * residual / shape.diagonal).positive_part();
            let change = next - *value;
            progress.error += error.to_f64();
            back += (change * (*trial - next)).to_f64() * shape.diagonal.to_f64();
            *trial = (next + momentum * change).positive_part();
            *value = next;
        }
        progress.goes_back = back > 0.0;
        progress
    }

    /// One over the greatest eigenvalue of D⁻¹A of both constraints, a tenth less to be safe, by 40 steps of power iteration: for
    /// [`Tuning::relaxation`](super::Tuning::relaxation). Changes `trial`, `pushes` and `rates`.
    ///
    /// # Errors
    /// As [`Summation::shapes`], and [`Error::LengthMismatch`] where slices do not agree.
    pub fn estimate_relaxation<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
    ) -> Result<[T; 2], Error> {
        let mut relaxation = self.tuning.relaxation;
        self.prepare(particles)?;
        for (relaxation, constraint) in
            relaxation.iter_mut().zip([Constraint::Projection, Constraint::Correction])
        {
            let eigenvalue = self.greatest_eigenvalue(particles, constraint)?;
            if eigenvalue > T::ZERO {
                *relaxation = T::ratio(9, 10) / eigenvalue;
            }
        }
        Ok(relaxation)
    }

    fn greatest_eigenvalue<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
        constraint: Constraint,
    ) -> Result<T, Error> {
        const STEPS: u32 = 40;
        for (k, trial) in particles.trial.iter_mut().enumerate() {
            // of no pattern: a lattice has eigenvectors that a pattern may miss
            let number = (k as u32).wrapping_mul(2_654_435_761) >> 8;
            *trial = T::from_f64(f64::from(number) / f64::from(1_u32 << 24) - 0.4);
        }
        let mut eigenvalue = 0.0_f64;
        for _ in 0..STEPS {
            self.push_and_rate(particles, constraint)?;
            let (mut before, mut after) = (0.0, 0.0);
            for ((trial, &rate), shape) in
                particles.trial.iter_mut().zip(particles.rates.iter()).zip(particles.shapes.iter())
            {
                let image = if self.has_value(shape) { -rate / shape.diagonal } else { T::ZERO };
                before += trial.to_f64() * trial.to_f64();
                after += image.to_f64() * image.to_f64();
                *trial = image;
            }
            if after <= 0.0 {
                return Ok(T::ZERO);
            }
            eigenvalue = libm::sqrt(after / before);
            let size = T::from_f64(libm::sqrt(after / particles.shapes.len() as f64));
            particles.trial.iter_mut().for_each(|trial| *trial = *trial / size);
        }
        Ok(T::from_f64(eigenvalue))
    }
}

/// What one step came to.
struct Progress {
    /// Σ |r| where the value is positive, Σ r₊ elsewhere.
    error: f64,
    /// Whether the step goes back.
    goes_back: bool,
}

fn values<'a, T>(pressures: &'a [T], shifts: &'a [T], constraint: Constraint) -> &'a [T] {
    match constraint {
        Constraint::Projection => pressures,
        Constraint::Correction => shifts,
    }
}

fn values_mut<'a, T>(pressures: &'a mut [T], shifts: &'a mut [T], constraint: Constraint) -> &'a mut [T] {
    match constraint {
        Constraint::Projection => pressures,
        Constraint::Correction => shifts,
    }
}
