//! The particles in one scalar and one dimension, sorted into cells.

use sph_core::{CellGrid, CellLayout, Scalar, Sources, field};

use super::load::{Particles, Support};
use super::units::{Units, fitted};
use crate::failure::Failure;
use crate::kernel_choice::{AnyInfluence, Influences, KernelName};
use crate::parallel;

/// Everything that the sums need, particles in the order of their cells.
///
/// The sort is stable, so the order in which a sum visits its neighbours is that of sph-core's cell grid over the particles
/// as they were read.
pub(super) struct Scene<T, const D: usize> {
    pub(super) layout: CellLayout<T, D>,
    pub(super) positions: Vec<[T; D]>,
    /// One for all, or one each.
    influences: Vec<AnyInfluence<T, D>>,
    is_uniform: bool,
    /// m_j, where there are masses.
    pub(super) masses: Option<Vec<T>>,
    /// V_j; empty where no field is asked for.
    pub(super) volumes: Vec<T>,
    /// A_j, field by field.
    pub(super) values: Vec<Vec<T>>,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl<T: Scalar, const D: usize> Scene<T, D> {
    /// Converts and sorts the particles, and sums densities where fields need them.
    pub(super) fn new(particles: &Particles, kernel: KernelName, units: &Units<D>) -> Result<Self, Failure> {
        if particles.len() > u32::MAX as usize {
            return Err(Failure::input(format!("{}: more than 2³² particles", particles.source)));
        }
        let source = &particles.source;
        let failed = |error: sph_core::Error| Failure::input(format!("{source}: {error}"));
        let read: Vec<[T; D]> = positions(particles, units)?;
        let layout = layout(&read, reach(particles, units)).map_err(|error| {
            let (name, h) = (T::NAME, units.length);
            Failure::input(format!(
                "{source}: what the particles span, in units of {h}, does not fit {name}: {error}"
            ))
        })?;
        let (mut starts, mut entries) = (vec![0; layout.cells() + 1], vec![0; read.len()]);
        let order =
            CellGrid::build(layout, &read, &mut starts, &mut entries).map_err(failed)?.entries().to_vec();
        let sorted = |values: &[f64], unit: f64, what: &str| -> Result<Vec<T>, Failure> {
            order.iter().map(|&j| fitted(values[j as usize] / unit, what, source)).collect()
        };
        let positions: Vec<[T; D]> = order.iter().map(|&j| read[j as usize]).collect();
        let influence = |h: f64| AnyInfluence::new(kernel, T::from_f64(h / units.length));
        let influences: Result<Vec<_>, _> = match &particles.support {
            Support::Uniform(h) => influence(*h).map(|influence| vec![influence]),
            Support::PerParticle(radii) => order.iter().map(|&j| influence(radii[j as usize])).collect(),
        };
        let is_uniform = matches!(particles.support, Support::Uniform(_));
        let masses =
            particles.masses.as_ref().map(|masses| sorted(masses, units.mass, "mass")).transpose()?;
        let densities =
            particles.densities.as_ref().map(|rho| sorted(rho, units.density(), "density")).transpose()?;
        let mut values = Vec::with_capacity(particles.quantities.len());
        for (quantity, unit) in particles.quantities.iter().zip(&units.quantities) {
            values.push(sorted(&quantity.values, *unit, &quantity.name)?);
        }
        CellGrid::build(layout, &positions, &mut starts, &mut entries).map_err(failed)?;
        let influences = influences.map_err(failed)?;
        let mut scene = Self {
            layout,
            positions,
            influences,
            is_uniform,
            masses,
            volumes: Vec::new(),
            values,
            starts,
            entries,
        };
        if !scene.values.is_empty() {
            scene.volumes = scene.volumes(densities).map_err(failed)?;
        }
        Ok(scene)
    }

    /// Ω of each particle.
    pub(super) fn influences(&self) -> Influences<'_, T, D> {
        match self.influences.first() {
            Some(influence) if self.is_uniform => Influences::uniform(influence),
            _ => Influences::per_sample(&self.influences),
        }
    }

    /// The search over the sorted particles.
    pub(super) fn search(&self) -> CellGrid<'_, T, u32, D> {
        CellGrid::from_sorted(self.layout, &self.positions, &self.starts, &self.entries)
    }

    /// V_j = m_j / ρ_j, ρ by Thm 3.2 where none is given; 1 / ρ_j or 1 where there is no mass.
    fn volumes(&self, densities: Option<Vec<T>>) -> Result<Vec<T>, sph_core::Error> {
        let mut volumes = vec![T::ZERO; self.positions.len()];
        let Some(masses) = &self.masses else {
            let Some(densities) = densities else { return Ok(vec![T::ONE; volumes.len()]) };
            field::volumes(sph_core::Uniform(T::ONE), &densities, &mut volumes)?;
            return Ok(volumes);
        };
        let densities = match densities {
            Some(densities) => densities,
            None => {
                let (sources, w) = (Sources::new(self.search(), &masses[..])?, self.influences());
                let mut densities = vec![T::ZERO; self.positions.len()];
                parallel::fill(&mut densities, |i| sources.density_at(w, &self.positions[i]));
                densities
            }
        };
        field::volumes(&masses[..], &densities, &mut volumes)?;
        Ok(volumes)
    }
}

/// The particles' positions in the units of the run.
pub(super) fn positions<T: Scalar, const D: usize>(
    particles: &Particles,
    units: &Units<D>,
) -> Result<Vec<[T; D]>, Failure> {
    let position = |j: usize| units.position(std::array::from_fn(|axis| particles.coordinates[axis][j]));
    let mut positions = vec![[T::ZERO; D]; particles.len()];
    parallel::fill(&mut positions, position);
    if let Some(j) = positions.iter().position(|x| x.iter().any(|component| !component.is_finite())) {
        let x: [f64; D] = std::array::from_fn(|axis| particles.coordinates[axis][j]);
        let (source, name, h) = (&particles.source, T::NAME, units.length);
        return Err(Failure::input(format!(
            "{source}: particle {j} at {x:?}, in units of {h}, does not fit {name}"
        )));
    }
    Ok(positions)
}

/// The largest support radius in the units of the run.
fn reach<T: Scalar, const D: usize>(particles: &Particles, units: &Units<D>) -> T {
    match &particles.support {
        Support::Uniform(h) => T::from_f64(h / units.length),
        Support::PerParticle(radii) => T::from_f64(super::load::bounds(radii).1 / units.length),
    }
}

/// SortedCells about as wide as the reach over the particles' box, at most some four a particle.
fn layout<T: Scalar, const D: usize>(
    positions: &[[T; D]],
    reach: T,
) -> Result<CellLayout<T, D>, sph_core::Error> {
    let mut lower = positions[0];
    let mut upper = positions[0];
    for x in positions {
        for axis in 0..D {
            lower[axis] = lower[axis].min(x[axis]);
            upper[axis] = upper[axis].max(x[axis]);
        }
    }
    let most = (4.0 * positions.len() as f64).powf(1.0 / D as f64).ceil().max(1.0);
    let mut counts = [1_u32; D];
    for axis in 0..D {
        let cells = ((upper[axis] - lower[axis]).to_f64() / reach.to_f64()).floor();
        counts[axis] = cells.clamp(1.0, most.min(1e6)) as u32;
        if upper[axis] <= lower[axis] {
            upper[axis] = lower[axis] + reach;
        }
    }
    CellLayout::bounded(&lower, &upper, counts)
}
