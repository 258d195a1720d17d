//! The fast path: f32 and f64.
//!
//! The same sums as on the exact path over the same particles, in another order. No bit depends on the number of threads, nor
//! on the processor.

use std::time::Instant;

use sph_core::{Error, Scalar, Uniform, field};

use super::rows::{Counts, Evaluated, empty_columns, fill};
use super::scene::{fitted, positions};
use crate::fast::{Estimates, Fields, RadiusOctaves, Real, Samples, SortedCells};
use crate::kernel_choice::{KernelName, with_kernel};
use crate::parallel;
use crate::progress::Progress;
use crate::sample::error::SampleError;
use crate::sample::found::{AtPoint, Local};
use crate::sample::particles::{Particles, Support};
use crate::sample::plan::Plan;
use crate::sample::points::Points;
use crate::sample::request::Request;

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
    let carried = Carried::new(plan, particles, &positions, &set, points.are_particles)?;
    let fields = carried.fields(&set).map_err(failed)?;
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
        let estimates = carried.at(plan, &fields, at).map_err(failed)?;
        let density = carried.at_particles.as_ref().map(|densities| &densities[first..end]);
        let rows = Rows { estimates: &estimates, density, carried: &carried };
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
    let along: [&[f64]; D] = std::array::from_fn(|axis| &points.along(plan.space[axis])[first..end]);
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

    fn samples(&self, samples: &Samples<'_, T>) -> Result<Fields<'_, T, D>, Error> {
        match self {
            Self::Cells(cells) => cells.samples(samples),
            Self::RadiusOctaves(octaves) => octaves.samples(samples),
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

/// What the particles carry, and what is known before the sums.
struct Carried<T> {
    /// m_j, where densities are wanted by sums at points.
    masses: Option<Vec<T>>,
    /// V_j; ones without masses and densities; empty where there are no fields.
    volumes: Vec<T>,
    /// A_j, field by field.
    values: Vec<Vec<T>>,
    /// The densities at the particles, where points are the particles and no gradient is wanted.
    at_particles: Option<Vec<T>>,
}

impl<T: Real> Carried<T> {
    fn new<const D: usize>(
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
        let mut volumes = vec![T::ONE; if has_fields { positions.len() } else { 0 }];
        if has_fields {
            match (&masses, given.as_ref().or(summed.as_ref())) {
                (Some(masses), Some(densities)) => field::volumes(&masses[..], densities, &mut volumes),
                (None, Some(densities)) => field::volumes(Uniform(T::ONE), densities, &mut volumes),
                (_, None) => Ok(()),
            }
            .map_err(failed)?;
        }
        let quantities = particles.quantities.iter().zip(&units.quantities);
        let values = quantities.map(|(quantity, (name, unit))| column(&quantity.values, *unit, name));
        let values = values.collect::<Result<_, _>>()?;
        let at_particles = summed.filter(|_| at_particles);
        Ok(Self { masses: masses.filter(|_| at_particles.is_none()), volumes, values, at_particles })
    }

    /// The particles with what sums at points read of them.
    fn fields<'a, const D: usize>(&self, set: &'a Set<T, D>) -> Result<Fields<'a, T, D>, Error> {
        let coefficients: Vec<&[T]> = self.masses.iter().map(Vec::as_slice).collect();
        let values: Vec<&[T]> = self.values.iter().map(Vec::as_slice).collect();
        set.samples(&Samples { coefficients: &coefficients, volumes: &self.volumes, values: &values })
    }

    /// The estimates at some points. At particles whose densities are all that is wanted there is nothing to sum: each has itself
    /// in reach.
    fn at<const D: usize>(
        &self,
        plan: &Plan<'_>,
        fields: &Fields<'_, T, D>,
        points: &[[T; D]],
    ) -> Result<Estimates<T>, Error> {
        if self.values.is_empty() && self.at_particles.is_some() {
            let (reached, carried) = (vec![1; points.len()], vec![true; points.len()]);
            return Ok(Estimates { values: Vec::new(), reached, carried });
        }
        let Request { kernel, estimate, gradient, .. } = *plan.request;
        with_kernel!(kernel, K => fields.estimate::<K>(estimate, points, gradient))
    }
}

/// From estimates to what is found at a point.
struct Rows<'a, T> {
    estimates: &'a Estimates<T>,
    /// The densities, where they are known without sums.
    density: Option<&'a [T]>,
    carried: &'a Carried<T>,
}

impl<T: Real> Rows<'_, T> {
    fn at<const D: usize>(&self, point: usize, at: &mut AtPoint<T, D>, counts: &mut Counts) {
        let Self { estimates: Estimates { values, reached, carried }, density, carried: known } = self;
        let is_empty = reached[point] == 0;
        counts.out_of_reach += usize::from(is_empty);
        counts.not_carried += usize::from(!carried[point] && !is_empty);
        let sums = usize::from(known.masses.is_some()) + known.values.len();
        let width = values.len() / reached.len() / sums.max(1);
        let mut sums = values[point * width * sums..][..width * sums].chunks_exact(width.max(1)).map(local);
        at.density = match density {
            Some(densities) => Some((densities[point], [T::ZERO; D])),
            None => known.masses.as_ref().and_then(|_| sums.next()),
        };
        at.fields.extend(sums.map(|field| carried[point].then_some(field)));
    }
}

/// A value and its gradient, which is zero where there is none.
fn local<T: Scalar, const D: usize>(row: &[T]) -> Local<T, D> {
    let slope = |axis: usize| row.get(1 + axis).copied().unwrap_or(T::ZERO);
    (row[0], std::array::from_fn(slope))
}
