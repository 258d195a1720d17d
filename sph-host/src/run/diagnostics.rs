//! What is measured in every case: energies, momentum, density, spacing.

use sph_core::fluid::EquationOfState;
use sph_core::vector::{dot, norm_squared};
use sph_core::{CellGrid, CellLayout, Neighbours};

use crate::engine::{Setup, Snapshot};
use crate::parallel;

/// What every row of the series begins with, after the time.
pub(super) const COLUMNS: [&str; 6] = [
    "kinetic_energy",
    "potential_energy",
    "max_speed",
    "mean_density_error",
    "max_density_error",
    "min_spacing",
];

/// What every row ends with.
pub(super) const LAST_COLUMNS: [&str; 4] =
    ["compression_energy", "momentum_error", "angular_momentum_error", "outside"];

/// A distance at which particles count as near, in first spacings.
pub(super) const NEAR: f64 = 0.6;

/// Measures the fluid of one case.
pub(super) struct Diagnostics<const D: usize> {
    mass: f64,
    spacing: f64,
    rest_density: f64,
    gravity: [f64; D],
    /// `None` for a fluid without energy of compression.
    state: Option<EquationOfState<f64>>,
    layout: Option<CellLayout<f64, D>>,
    /// Σ m v and Σ m x × v at the start.
    momentum: [f64; D],
    spin: [f64; 3],
    /// Σ m |v| and Σ m |x| |v| at the start; where these are zero, they are taken now.
    scale: f64,
    spin_scale: f64,
    inside: [(f64, f64); D],
}

impl<const D: usize> Diagnostics<D> {
    /// The diagnostics of a case that starts so; particles beyond `inside` have escaped.
    pub(super) fn new(
        setup: &Setup<D>,
        inside: [(f64, f64); D],
        has_equation_of_state: bool,
    ) -> Result<Self, sph_core::Error> {
        let mass = setup.mass();
        let momentum = momentum(mass, &setup.velocities);
        let spin = spin(mass, &setup.positions, &setup.velocities);
        let [scale, spin_scale] = scales(mass, &setup.positions, &setup.velocities);
        Ok(Self {
            mass,
            spacing: setup.spacing,
            rest_density: setup.rest_density,
            gravity: setup.gravity,
            state: if has_equation_of_state { Some(setup.liquid::<f64>()?.equation_of_state) } else { None },
            layout: crate::engine::layout(setup, 2.0 * setup.spacing).ok(),
            momentum,
            spin,
            scale,
            spin_scale,
            inside,
        })
    }

    /// The values of [`COLUMNS`].
    pub(super) fn measure(&self, now: &Snapshot<D>) -> [f64; COLUMNS.len()] {
        let squares = now.velocities.iter().map(norm_squared);
        let potential: f64 = now.positions.iter().map(|x| -self.mass * dot(&self.gravity, x)).sum();
        let excess = now.densities.iter().map(|density| density / self.rest_density - 1.0);
        // Without, the density is the kernel's sum, which misses what lies beyond the surface: only compression counts.
        let error = |excess: f64| if self.state.is_some() { excess.abs() } else { excess.max(0.0) };
        [
            squares.clone().map(|square| 0.5 * self.mass * square).sum(),
            potential,
            squares.fold(0.0, f64::max).sqrt(),
            excess.clone().map(error).sum::<f64>() / now.densities.len() as f64,
            excess.map(error).fold(0.0, f64::max),
            self.least_spacing(now),
        ]
    }

    /// The values of [`LAST_COLUMNS`].
    pub(super) fn measure_last(&self, now: &Snapshot<D>) -> [f64; LAST_COLUMNS.len()] {
        let energy = |state: EquationOfState<f64>| {
            now.densities.iter().map(|&density| self.mass * state.energy(density)).sum()
        };
        let compression = self.state.map_or(0.0, energy);
        let momentum = momentum(self.mass, &now.velocities);
        let spin = spin(self.mass, &now.positions, &now.velocities);
        let change = |now: &[f64], then: &[f64]| {
            now.iter().zip(then).map(|(now, then)| (now - then).powi(2)).sum::<f64>().sqrt()
        };
        let [scale, spin_scale] = scales(self.mass, &now.positions, &now.velocities);
        let relative = |change: f64, scales: [f64; 2]| {
            scales.iter().find(|&&scale| scale > 0.0).map_or(change, |scale| change / scale)
        };
        [
            compression,
            relative(change(&momentum, &self.momentum), [self.scale, scale]),
            relative(change(&spin, &self.spin), [self.spin_scale, spin_scale]),
            self.outside(now) as f64,
        ]
    }

    /// Particles behind the first layer of wall particles, or with a coordinate that is not finite. One that hits a wall hard may
    /// come as far as that layer.
    fn outside(&self, now: &Snapshot<D>) -> usize {
        let layer = self.spacing;
        let is_inside = |x: &&[f64; D]| {
            let mut sides = x.iter().zip(&self.inside);
            sides.all(|(x, &(lower, upper))| (lower - layer..=upper + layer).contains(x))
        };
        now.positions.len() - now.positions.iter().filter(is_inside).count()
    }

    /// The least distance of two particles, in first spacings; 2 where none are nearer than that.
    fn least_spacing(&self, now: &Snapshot<D>) -> f64 {
        self.nearest(now).map_or(f64::NAN, |nearest| nearest.into_iter().fold(2.0, f64::min))
    }

    /// The share of particles that have another nearer than [`NEAR`].
    pub(super) fn share_of_near(&self, now: &Snapshot<D>) -> Option<f64> {
        let nearest = self.nearest(now)?;
        Some(nearest.iter().filter(|&&nearest| nearest < NEAR).count() as f64 / nearest.len() as f64)
    }

    /// The distance of each particle to the nearest other, in first spacings; 2 where none is nearer than that.
    fn nearest(&self, now: &Snapshot<D>) -> Option<Vec<f64>> {
        let layout = self.layout?;
        let mut starts = vec![0_u32; layout.cells() + 1];
        let mut entries = vec![0_u32; now.positions.len()];
        let search = CellGrid::build(layout, &now.positions, &mut starts, &mut entries).ok()?;
        let reach = 2.0 * self.spacing;
        let mut nearest = vec![0.0; now.positions.len()];
        parallel::fill(&mut nearest, |i| {
            let mut least = reach * reach;
            search.for_each(&now.positions[i], reach, |neighbour| {
                if neighbour.index != i {
                    least = least.min(neighbour.distance_squared);
                }
            });
            least.sqrt() / self.spacing
        });
        Some(nearest)
    }
}

/// Σ m |v| and Σ m |x| |v|
fn scales<const D: usize>(mass: f64, positions: &[[f64; D]], velocities: &[[f64; D]]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (x, v) in positions.iter().zip(velocities) {
        let momentum = mass * norm_squared(v).sqrt();
        sums[0] += momentum;
        sums[1] += momentum * norm_squared(x).sqrt();
    }
    sums
}

/// Σ m v
fn momentum<const D: usize>(mass: f64, velocities: &[[f64; D]]) -> [f64; D] {
    std::array::from_fn(|axis| velocities.iter().map(|v| mass * v[axis]).sum())
}

/// Σ m x × v; in two dimensions along the third axis.
fn spin<const D: usize>(mass: f64, positions: &[[f64; D]], velocities: &[[f64; D]]) -> [f64; 3] {
    let part = |v: &[f64; D], axis: usize| v.get(axis).copied().unwrap_or(0.0);
    let mut spin = [0.0; 3];
    for (x, v) in positions.iter().zip(velocities) {
        for (axis, total) in spin.iter_mut().enumerate() {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            *total += mass * (part(x, a) * part(v, b) - part(x, b) * part(v, a));
        }
    }
    spin
}
