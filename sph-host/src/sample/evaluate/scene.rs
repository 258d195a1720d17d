//! The particles in one scalar and one dimension, sorted into cells.

use sph_core::{CellGrid, CellLayout, Scalar, Sources, field};

use crate::kernel_choice::{AnyInfluence, Influences};
use crate::parallel;
use crate::sample::error::SampleError;
use crate::sample::particles::{Particles, Support};
use crate::sample::plan::Plan;
use crate::scalar_choice::name_of;

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
    /// The largest h of all particles, whether they are here or in another piece.
    pub(super) reach: T,
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
    pub(super) fn new(plan: &Plan<'_>, particles: &Particles) -> Result<Self, SampleError> {
        let file = &particles.file;
        if particles.len() > u32::MAX as usize {
            return Err(SampleError::TooMany { file: file.clone() });
        }
        let failed = |error: sph_core::Error| SampleError::Sums { file: file.clone(), error };
        let units = &plan.units;
        let read: Vec<[T; D]> = positions(plan, particles)?;
        let layout = layout(plan).map_err(|error| SampleError::BoxOutOfRange {
            file: file.clone(),
            unit: units.length,
            scalar: name_of::<T>(),
            error,
        })?;
        let (mut starts, mut entries) = (vec![0; layout.cells() + 1], vec![0; read.len()]);
        let order =
            CellGrid::build(layout, &read, &mut starts, &mut entries).map_err(failed)?.entries().to_vec();
        let sorted = |values: &[f64], unit, what: &str| {
            fitted::<T>(order.iter().map(|&j| &values[j as usize]), unit, what, file)
        };
        let positions: Vec<[T; D]> = order.iter().map(|&j| read[j as usize]).collect();
        let influence = |h: f64| AnyInfluence::new(plan.request.kernel, T::from_f64(h / units.length));
        let influences: Result<Vec<_>, _> = match &particles.support {
            Support::Uniform(h) => influence(*h).map(|influence| vec![influence]),
            Support::PerParticle(radii) => order.iter().map(|&j| influence(radii[j as usize])).collect(),
        };
        let masses = particles.masses.as_ref().map(|m| sorted(m, units.mass, "mass")).transpose()?;
        let densities = particles.densities.as_ref();
        let densities = densities.map(|rho| sorted(rho, units.density, "density")).transpose()?;
        let mut values = Vec::with_capacity(particles.quantities.len());
        for (quantity, (name, unit)) in particles.quantities.iter().zip(&units.quantities) {
            values.push(sorted(&quantity.values, *unit, name)?);
        }
        CellGrid::build(layout, &positions, &mut starts, &mut entries).map_err(failed)?;
        let mut scene = Self {
            layout,
            positions,
            influences: influences.map_err(failed)?,
            is_uniform: plan.span.is_uniform,
            reach: T::from_f64(plan.span.supports.1 / units.length),
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

/// The particles' positions in the units of the plan.
pub(super) fn positions<T: Scalar, const D: usize>(
    plan: &Plan<'_>,
    particles: &Particles,
) -> Result<Vec<[T; D]>, SampleError> {
    let frame = plan.units.frame::<D>();
    let along: [&[f64]; D] = std::array::from_fn(|axis| &particles.coordinates[plan.axes[axis]][..]);
    let read = |j: usize| std::array::from_fn(|axis| along[axis][j]);
    let mut positions = vec![[T::ZERO; D]; particles.len()];
    parallel::fill(&mut positions, |j| frame.position(read(j)));
    match positions.iter().position(|x| x.iter().any(|component| !component.is_finite())) {
        None => Ok(positions),
        Some(particle) => Err(SampleError::PositionOutOfRange {
            file: particles.file.clone(),
            particle,
            position: read(particle).to_vec(),
            unit: plan.units.length,
            origin: plan.units.origin.clone(),
            scalar: name_of::<T>(),
        }),
    }
}

/// Numbers in units of `unit`, as T.
pub(super) fn fitted<'v, T: Scalar>(
    values: impl Iterator<Item = &'v f64>,
    unit: f64,
    what: &str,
    file: &str,
) -> Result<Vec<T>, SampleError> {
    let fitted = |&value: &f64| {
        let fitted = T::from_f64(value / unit);
        if fitted.is_finite() {
            return Ok(fitted);
        }
        let (file, what, scalar) = (file.to_owned(), what.to_owned(), name_of::<T>());
        Err(SampleError::OutOfRange { file, what, value, unit, scalar })
    };
    values.map(fitted).collect()
}

/// The plan's cells over the box of all particles. They do not depend on which of these are there, so that sums over a part
/// of them go in the order of sums over all.
fn layout<T: Scalar, const D: usize>(plan: &Plan<'_>) -> Result<CellLayout<T, D>, sph_core::Error> {
    let frame = plan.units.frame::<D>();
    let bounds: [(f64, f64); D] = std::array::from_fn(|axis| plan.span.coordinates[plan.axes[axis]]);
    let lower: [T; D] = frame.position(bounds.map(|(lower, _)| lower));
    let mut upper: [T; D] = frame.position(bounds.map(|(_, upper)| upper));
    for axis in 0..D {
        if upper[axis] <= lower[axis] {
            upper[axis] = lower[axis] + T::from_f64(plan.span.supports.1 / plan.units.length);
        }
    }
    CellLayout::bounded(&lower, &upper, std::array::from_fn(|axis| plan.units.cells[axis]))
}
