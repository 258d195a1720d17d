//! Least squares over values that are not negative: gradient steps scaled by the diagonal, projected, with momentum.
//!
//! ```text
//! r = b + C(P(y))          x′ = (y + ω r / d)₊          y′ = (x′ + β (x′ − x))₊,   β = (t − 1)/t′,  t′ = ½ (1 + √(1 + 4 t²))
//! ```
//!
//! and y′ = x′, t′ = 1 where the step x′ − x goes back against y − x′. t begins at 4, as values begin near their end. It converges for
//! ω below one over the greatest eigenvalue of D⁻¹A, A = −C P: 2.6 to 2.9 in two dimensions and 4.1 to 4.4 in three, so a fixed ω = ½
//! diverges. The eigenvalue is estimated by power iteration, once, and stays what it is because d bounds what walls add: with
//! the diagonal of the fluid alone it is 4 on the lattice and 9 where particles have come close to a wall.

use super::{Particles, Scheme, Shape, Summation};
use crate::{Error, Influence, Scalar};

/// A particle with less of the density than this has no pressure: spray.
const SPRAY: (i32, i32) = (1, 2);

/// t in the first iteration.
const FIRST_T: i32 = 4;

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Solves for pressures whose b is in `sources`, from those that are there; P of the result is in `pushes`. Returns how many
    /// iterations it took.
    pub(super) fn solve<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<'_, T, D, S>,
        tolerance: f64,
    ) -> Result<u32, Error> {
        let enough = tolerance * particles.shapes.len() as f64;
        self.begin(particles);
        let mut t = T::ratio(FIRST_T, 1);
        let mut iterations = 0;
        loop {
            self.push_and_rate(particles)?;
            let next = (T::ONE + (T::ONE + (t * t).times(4)).sqrt()) * T::ratio(1, 2);
            let step = self.improve(particles, (t - T::ONE) / next);
            iterations += 1;
            t = next;
            if step.goes_back {
                t = T::ONE;
                particles.trial.copy_from_slice(particles.pressures);
            }
            let is_done = step.error <= enough && iterations >= self.tuning.least_iterations;
            if is_done || iterations >= self.tuning.most_iterations {
                break;
            }
        }
        let Particles { positions, shapes, pressures, pushes, sums, .. } = particles;
        sums.pushes(self, positions, shapes, pressures, pushes)?;
        Ok(iterations)
    }

    /// Spray has no pressure.
    fn begin<S>(&self, particles: &mut Particles<'_, T, D, S>) {
        for (pressure, shape) in particles.pressures.iter_mut().zip(particles.shapes.iter()) {
            if !self.has_pressure(shape) {
                *pressure = T::ZERO;
            }
        }
        particles.trial.copy_from_slice(particles.pressures);
    }

    /// Whether a particle is no spray.
    fn has_pressure(&self, shape: &Shape<T, D>) -> bool {
        let smallest = T::ratio(1, 1000) / (self.spacing * self.spacing);
        shape.density >= T::ratio(SPRAY.0, SPRAY.1) && shape.diagonal > smallest
    }

    /// C(P(y)) in `rates`.
    fn push_and_rate<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<'_, T, D, S>,
    ) -> Result<(), Error> {
        let Particles { positions, shapes, trial, pushes, rates, sums, .. } = particles;
        sums.pushes(self, positions, shapes, trial, pushes)?;
        sums.rates(self, positions, shapes, pushes, rates)
    }

    /// One step of all pressures, from `rates`.
    fn improve<S>(&self, particles: &mut Particles<'_, T, D, S>, momentum: T) -> Progress {
        let mut progress = Progress { error: 0.0, goes_back: false };
        let mut back = 0.0;
        let relaxation = self.tuning.relaxation;
        let known = particles.shapes.iter().zip(particles.sources.iter()).zip(particles.rates.iter());
        let unknown = particles.pressures.iter_mut().zip(particles.trial.iter_mut());
        for (((shape, &source), &rate), (value, trial)) in known.zip(unknown) {
            if !self.has_pressure(shape) {
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

    /// One over the greatest eigenvalue of D⁻¹A, a tenth less to be safe, by 40 steps of power iteration: for
    /// [`Tuning::relaxation`](super::Tuning::relaxation). Changes `trial`, `pushes` and `rates`.
    ///
    /// # Errors
    /// As [`Summation::shapes`], and [`Error::LengthMismatch`] where slices do not agree.
    pub fn estimate_relaxation<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
    ) -> Result<T, Error> {
        self.prepare(particles)?;
        let eigenvalue = self.greatest_eigenvalue(particles)?;
        Ok(if eigenvalue > T::ZERO { T::ratio(9, 10) / eigenvalue } else { self.tuning.relaxation })
    }

    fn greatest_eigenvalue<S: Summation<T, D, W>>(
        &self,
        particles: &mut Particles<T, D, S>,
    ) -> Result<T, Error> {
        const STEPS: u32 = 40;
        for (k, trial) in particles.trial.iter_mut().enumerate() {
            // of no pattern: a lattice has eigenvectors that a pattern may miss
            let number = (k as u32).wrapping_mul(2_654_435_761) >> 8;
            *trial = T::from_f64(f64::from(number) / f64::from(1_u32 << 24) - 0.4);
        }
        let mut eigenvalue = 0.0_f64;
        for _ in 0..STEPS {
            self.push_and_rate(particles)?;
            let (mut before, mut after) = (0.0, 0.0);
            for ((trial, &rate), shape) in
                particles.trial.iter_mut().zip(particles.rates.iter()).zip(particles.shapes.iter())
            {
                let image = if self.has_pressure(shape) { -rate / shape.diagonal } else { T::ZERO };
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
