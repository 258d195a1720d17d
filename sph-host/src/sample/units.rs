//! Units in which numbers stay near 1, for scalars of a small range.
//!
//! Floats keep the file's own units, so that results are bit for bit those of a program that links sph-core and feeds it
//! the same numbers. Fixed point takes lengths in units of h from the middle of the particles, masses such that densities are
//! near 1, and each quantity in units of its largest magnitude.

use sph_core::Scalar;

use super::load::{self, Particles, Support};
use crate::failure::Failure;

/// The units of one run, as multiples of the file's.
#[derive(Clone, Debug)]
pub(super) struct Units<const D: usize> {
    pub(super) origin: [f64; D],
    pub(super) length: f64,
    pub(super) mass: f64,
    pub(super) quantities: Vec<f64>,
}

impl<const D: usize> Units<D> {
    /// The units that suit the scalar T.
    pub(super) fn of<T: Scalar>(particles: &Particles) -> Self {
        if T::MAX.to_f64() > 1e30 {
            let quantities = vec![1.0; particles.quantities.len()];
            return Self { origin: [0.0; D], length: 1.0, mass: 1.0, quantities };
        }
        let length = match &particles.support {
            Support::Uniform(h) => *h,
            Support::PerParticle(radii) => load::bounds(radii).1,
        };
        let boxes: [(f64, f64); D] = std::array::from_fn(|axis| load::bounds(&particles.coordinates[axis]));
        let volume: f64 = boxes.iter().map(|(lower, upper)| ((upper - lower) / length).max(1.0)).product();
        let magnitude = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        Self {
            origin: boxes.map(|(lower, upper)| lower + (upper - lower) / 2.0),
            length,
            mass: match (&particles.masses, &particles.densities) {
                (Some(masses), _) => load::bounds(masses).1 * particles.len() as f64 / volume,
                // weights 1 / ρ: the largest density becomes 1
                (None, Some(densities)) => load::bounds(densities).1 * length.powi(D as i32),
                (None, None) => 1.0,
            },
            quantities: particles
                .quantities
                .iter()
                .map(|quantity| Some(magnitude(&quantity.values)).filter(|&most| most > 0.0).unwrap_or(1.0))
                .collect(),
        }
    }

    /// The unit of density.
    pub(super) fn density(&self) -> f64 {
        self.mass / self.length.powi(D as i32)
    }

    /// A position in these units.
    pub(super) fn position<T: Scalar>(&self, x: [f64; D]) -> [T; D] {
        std::array::from_fn(|axis| T::from_f64((x[axis] - self.origin[axis]) / self.length))
    }
}

/// A number in T, or an error that says what does not fit.
pub(super) fn fitted<T: Scalar>(value: f64, what: &str, source: &str) -> Result<T, Failure> {
    let fitted = T::from_f64(value);
    if fitted.is_finite() {
        return Ok(fitted);
    }
    Err(Failure::input(format!(
        "{source}: {what} {value} is outside the range of {} in the units used",
        T::NAME
    )))
}
