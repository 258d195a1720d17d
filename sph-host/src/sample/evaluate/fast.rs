//! The fast path: f32 and f64, the estimates that are quotients of sums.
//!
//! The same sums as on the exact path over the same particles, in another order. No bit depends on the number of threads, nor
//! on the processor.

use std::time::Instant;

use sph_core::{Error, Scalar, Uniform, field};

use super::rows::{Counts, Evaluated, empty_columns, fill};
use super::scene::{fitted, positions};
use crate::fast::{Fields, RadiusOctaves, Real, SortedCells, Sums};
use crate::kernel_choice::{KernelName, with_kernel};
use crate::parallel;
use crate::progress::Progress;
use crate::sample::error::SampleError;
use crate::sample::estimate::{FromSums, local};
use crate::sample::found::AtPoint;
use crate::sample::particles::{Particles, Support};
use crate::sample::plan::Plan;
use crate::sample::points::Points;

/// Points that are evaluated together.
const BATCH: usize = 1 << 17;

/// Evaluates a plan in the float T and D dimensions.
pub(super) fn evaluate<T: Real, const D: usize>(
    plan: &Plan<'_>,
    particles: &Particles,
    points: &Points,
    progress: &dyn Progress,
) -> Result<Evaluated, SampleError> {
    let failed = |error: Error| SampleError::Sums { file: particles.file.clone(), error };
    let start = Instant::now();
    let positions: Vec<[T; D]> = positions(plan, particles)?;
    let set = Set::sort(&positions, &particles.support, plan.units.length).map_err(failed)?;
    let search_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let weights = Weights::new(plan, particles, &positions, &set, points.are_particles)?;
    let coefficients: Vec<&[T]> = weights.coefficients.iter().map(Vec::as_slice).collect();
    let fields = set.fields(&coefficients).map_err(failed)?;
    let mut columns = empty_columns(plan, points.len());
    let mut counts = Counts::default();
    for first in (0..points.len()).step_by(BATCH) {
        let end = points.len().min(first + BATCH);
        let mut batch: Vec<&mut [f64]> = columns.iter_mut().map(|column| &mut column[first..end]).collect();
        let converted;
        let at = if points.are_particles {
            &positions[first..end]
        } else {
            converted = converted_points(plan, points, first, end);
            &converted
        };
        let sums = weights.sums(plan, &fields, at).map_err(failed)?;
        let density = weights.at_particles.as_ref().map(|densities| &densities[first..end]);
        let rows = Rows { sums: &sums, density, weights: &weights, from_sums: weights.from_sums };
        let work =
            |point, _: &mut (), at: &mut AtPoint<T, D>, counts: &mut Counts| rows.at(point, at, counts);
        counts = counts + fill(plan, &mut batch, end - first, progress, work);
    }
    Ok(Evaluated { columns, counts, search_seconds, evaluate_seconds: start.elapsed().as_secs_f64() })
}

/// Some points in the units of the plan.
fn converted_points<T: Scalar, const D: usize>(
    plan: &Plan<'_>,
    points: &Points,
    first: usize,
    end: usize,
) -> Vec<[T; D]> {
    let frame = plan.units.frame::<D>();
    let along: [&[f64]; D] = std::array::from_fn(|axis| &points.along(plan.axes[axis])[first..end]);
    let mut converted = vec![[T::ZERO; D]; end - first];
    parallel::fill(&mut converted, |point| frame.point(std::array::from_fn(|axis| along[axis][point])));
    converted
}

/// The sorted particles, with one support radius or one each.
enum Set<T, const D: usize> {
    Cells(SortedCells<T, D>),
    RadiusOctaves(RadiusOctaves<T, D>),
}

impl<T: Real, const D: usize> Set<T, D> {
    fn sort(positions: &[[T; D]], support: &Support, unit: f64) -> Result<Self, Error> {
        match support {
            Support::Uniform(h) => Ok(Self::Cells(SortedCells::sort(positions, T::from_f64(h / unit))?)),
            Support::PerParticle(radii) => {
                let radii: Vec<T> = radii.iter().map(|h| T::from_f64(h / unit)).collect();
                Ok(Self::RadiusOctaves(RadiusOctaves::sort(positions, &radii)?))
            }
        }
    }

    fn fields(&self, coefficients: &[&[T]]) -> Result<Fields<'_, T, D>, Error> {
        match self {
            Self::Cells(cells) => cells.fields(coefficients),
            Self::RadiusOctaves(octaves) => octaves.fields(coefficients),
        }
    }

    /// ρ at the particles: to rounding what the sums at points of the same places are.
    fn densities(&self, kernel: KernelName, positions: &[[T; D]], masses: &[T]) -> Result<Vec<T>, Error> {
        match self {
            Self::Cells(cells) => with_kernel!(kernel, K => cells.density::<K>(masses)),
            Self::RadiusOctaves(octaves) => {
                let fields = octaves.fields(&[masses])?;
                with_kernel!(kernel, K => Ok(fields.at::<K>(positions, false)?.values))
            }
        }
    }
}

/// What the sums are weighted with, and what is known before them.
struct Weights<T, const D: usize> {
    /// m_j where densities are wanted by sums at points, V_j where the estimate needs it, V_j A_j field by field.
    coefficients: Vec<Vec<T>>,
    /// Whether masses are among the coefficients.
    has_masses: bool,
    /// Whether volumes are.
    has_volumes: bool,
    from_sums: FromSums<T, D>,
    /// The densities at the particles, where points are the particles and no gradient is wanted.
    at_particles: Option<Vec<T>>,
}

impl<T: Real, const D: usize> Weights<T, D> {
    fn new(
        plan: &Plan<'_>,
        particles: &Particles,
        positions: &[[T; D]],
        set: &Set<T, D>,
        are_particles: bool,
    ) -> Result<Self, SampleError> {
        let (request, units) = (plan.request, &plan.units);
        let failed = |error: Error| SampleError::Sums { file: particles.file.clone(), error };
        let column = |values: &[f64], unit, what| fitted::<T>(values.iter(), unit, what, &particles.file);
        let masses = particles.masses.as_ref().map(|m| column(m, units.mass, "mass")).transpose()?;
        let has_fields = !particles.quantities.is_empty();
        let given = particles.densities.as_ref().filter(|_| has_fields);
        let given = given.map(|rho| column(rho, units.density, "density")).transpose()?;
        // with radii of their own, densities are sums at points: those of the fields are the same effort
        let is_one_pass = matches!(set, Set::Cells(_)) || given.is_none() || !has_fields;
        let at_particles = are_particles && !request.gradient && is_one_pass;
        let summed = match &masses {
            Some(masses) if at_particles || (has_fields && given.is_none()) => {
                Some(set.densities(request.kernel, positions, masses).map_err(failed)?)
            }
            _ => None,
        };
        let (mut coefficients, has_volumes) = (Vec::new(), has_fields && request.estimate.facts().weights);
        if has_fields {
            let mut volumes = vec![T::ONE; positions.len()];
            match (&masses, given.as_ref().or(summed.as_ref())) {
                (Some(masses), Some(densities)) => field::volumes(&masses[..], densities, &mut volumes),
                (None, Some(densities)) => field::volumes(Uniform(T::ONE), densities, &mut volumes),
                (_, None) => Ok(()),
            }
            .map_err(failed)?;
            for (quantity, (name, unit)) in particles.quantities.iter().zip(&units.quantities) {
                let mut values = column(&quantity.values, *unit, name)?;
                values.iter_mut().zip(&volumes).for_each(|(value, &volume)| *value = volume * *value);
                coefficients.push(values);
            }
            if has_volumes {
                coefficients.insert(0, volumes);
            }
        }
        let at_particles = summed.filter(|_| at_particles);
        let masses = masses.filter(|_| at_particles.is_none());
        let has_masses = masses.is_some();
        coefficients.splice(0..0, masses);
        let from_sums = request.estimate.method().fast().unwrap_or(|field, _| Some(local(field)));
        Ok(Self { coefficients, has_masses, has_volumes, from_sums, at_particles })
    }

    /// The sums at some points. At particles whose densities are all that is wanted there is nothing to sum: each has itself in
    /// reach.
    fn sums(&self, plan: &Plan<'_>, fields: &Fields<'_, T, D>, at: &[[T; D]]) -> Result<Sums<T>, Error> {
        if self.coefficients.is_empty() && self.at_particles.is_some() {
            return Ok(Sums { values: Vec::new(), reached: vec![1; at.len()] });
        }
        with_kernel!(plan.request.kernel, K => fields.at::<K>(at, plan.request.gradient))
    }
}

/// From sums to what is found at a point.
struct Rows<'a, T, const D: usize> {
    sums: &'a Sums<T>,
    /// The densities, where they are known without sums.
    density: Option<&'a [T]>,
    weights: &'a Weights<T, D>,
    from_sums: FromSums<T, D>,
}

impl<T: Real, const D: usize> Rows<'_, T, D> {
    fn at(&self, point: usize, at: &mut AtPoint<T, D>, counts: &mut Counts) {
        let Self { sums, density, weights, from_sums } = self;
        counts.out_of_reach += usize::from(sums.reached[point] == 0);
        let fields = weights.coefficients.len();
        let width = sums.values.len() / sums.reached.len() / fields.max(1);
        let mut sums = sums.values[point * width * fields..][..width * fields].chunks_exact(width.max(1));
        at.density = match density {
            Some(densities) => Some((densities[point], [T::ZERO; D])),
            None if weights.has_masses => sums.next().map(local),
            None => None,
        };
        let volumes = if weights.has_volumes { sums.next() } else { None };
        at.fields.extend(sums.map(|field| from_sums(field, volumes.unwrap_or(&[]))));
    }
}
