//! The sums of a request on the fast path: f32 and f64, plain and Shepard's estimates.
//!
//! The same sums as in `evaluate` over the same particles, in another order. No bit depends on the number of threads, nor on
//! the processor.

use std::time::Instant;

use sph_core::{Error, Uniform, field};

use super::evaluate::{Counts, Evaluated, columns, names};
use super::load::{Particles, Support};
use super::points::Points;
use super::request::{Estimate, Request, SamplePoints};
use super::scene::positions;
use super::units::{Units, fitted};
use crate::failure::Failure;
use crate::fast::{Estimates, Fields, RadiusOctaves, Real, SortedCells};
use crate::kernel_choice::{KernelName, with_kernel};
use crate::parallel;
use crate::progress::Progress;

/// Points that are evaluated together.
const BATCH: usize = 1 << 17;
/// Points whose rows a thread writes at a time.
const CHUNK: usize = 1024;

/// Evaluates a request in the float T and D dimensions.
pub(super) fn evaluate<T: Real, const D: usize>(
    request: &Request,
    particles: &Particles,
    points: &Points,
    progress: &dyn Progress,
) -> Result<Evaluated, Failure> {
    let failed = |error: Error| Failure::input(format!("{}: {error}", particles.source));
    let start = Instant::now();
    let positions: Vec<[T; D]> = positions(particles, &Units::of::<T>(particles))?;
    let set = Set::sort(&positions, &particles.support).map_err(failed)?;
    let search_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let weights = Weights::new(particles, &positions, &set, request)?;
    let coefficients: Vec<&[T]> = weights.coefficients.iter().map(Vec::as_slice).collect();
    let fields = set.fields(&coefficients).map_err(failed)?;
    let plan = Plan {
        kernel: request.kernel,
        estimate: request.estimate,
        gradient: request.gradient,
        has_density: weights.has_density,
        quantities: particles.quantities.len(),
    };
    let names = names(particles, request.gradient);
    let width = names.len().max(1);
    let mut rows = vec![f64::NAN; width * points.len()];
    let mut counts = Counts::default();
    for (batch, rows) in rows.chunks_mut(width * BATCH).enumerate() {
        let first = batch * BATCH;
        if let Some(densities) = &weights.at_particles {
            for (row, density) in rows.chunks_exact_mut(width).zip(&densities[first..]) {
                row[0] = density.to_f64();
            }
        }
        let skip = usize::from(weights.at_particles.is_some());
        counts = counts + plan.batch(&fields, points, first, Rows { rows, width, skip }).map_err(failed)?;
        progress.advance((rows.len() / width) as u64);
    }
    let columns = columns(names, &rows);
    Ok(Evaluated { columns, counts, search_seconds, evaluate_seconds: start.elapsed().as_secs_f64() })
}

/// The sorted particles, with one support radius or one each.
enum Set<T, const D: usize> {
    Cells(SortedCells<T, D>),
    RadiusOctaves(RadiusOctaves<T, D>),
}

impl<T: Real, const D: usize> Set<T, D> {
    fn sort(positions: &[[T; D]], support: &Support) -> Result<Self, Error> {
        match support {
            Support::Uniform(h) => Ok(Self::Cells(SortedCells::sort(positions, T::from_f64(*h))?)),
            Support::PerParticle(radii) => {
                let radii: Vec<T> = radii.iter().map(|&h| T::from_f64(h)).collect();
                Ok(Self::RadiusOctaves(RadiusOctaves::sort(positions, &radii)?))
            }
        }
    }

    fn fields(&self, coefficients: &[&[T]]) -> Result<Fields<'_, T, D>, Error> {
        match self {
            Self::Cells(cells) => cells.fields(coefficients),
            Self::RadiusOctaves(levels) => levels.fields(coefficients),
        }
    }

    /// ρ at the particles: to rounding what the sums at points of the same places are.
    fn densities(&self, kernel: KernelName, positions: &[[T; D]], masses: &[T]) -> Result<Vec<T>, Error> {
        match self {
            Self::Cells(cells) => with_kernel!(kernel, K => cells.density::<K>(masses)),
            Self::RadiusOctaves(levels) => {
                Ok(sums(&levels.fields(&[masses])?, kernel, positions, false)?.values)
            }
        }
    }
}

/// The sums with a kernel by name.
fn sums<T: Real, const D: usize>(
    fields: &Fields<'_, T, D>,
    kernel: KernelName,
    points: &[[T; D]],
    gradient: bool,
) -> Result<Estimates<T>, Error> {
    with_kernel!(kernel, K => fields.at::<K>(points, gradient))
}

/// What the sums are weighted with.
struct Weights<T> {
    /// m_j where densities are wanted at points, V_j where Shepard's form needs it, V_j A_j field by field.
    coefficients: Vec<Vec<T>>,
    /// Whether masses are among the coefficients.
    has_density: bool,
    /// The densities, where they are wanted at the particles alone and without gradients.
    at_particles: Option<Vec<T>>,
}

impl<T: Real> Weights<T> {
    fn new<const D: usize>(
        particles: &Particles,
        positions: &[[T; D]],
        set: &Set<T, D>,
        request: &Request,
    ) -> Result<Self, Failure> {
        let source = &particles.source;
        let failed = |error: Error| Failure::input(format!("{source}: {error}"));
        let column = |values: &[f64], what: &str| -> Result<Vec<T>, Failure> {
            values.iter().map(|&value| fitted(value, what, source)).collect()
        };
        let masses = particles.masses.as_ref().map(|masses| column(masses, "mass")).transpose()?;
        let given = particles.densities.as_ref().map(|rho| column(rho, "density")).transpose()?;
        let has_fields = !particles.quantities.is_empty();
        let at_particles =
            request.at == SamplePoints::AtParticles && !request.gradient && matches!(set, Set::Cells(_));
        let summed = match &masses {
            Some(masses) if at_particles || (has_fields && given.is_none()) => {
                Some(set.densities(request.kernel, positions, masses).map_err(failed)?)
            }
            _ => None,
        };
        let mut coefficients = Vec::new();
        if has_fields {
            let mut volumes = vec![T::ONE; positions.len()];
            match (&masses, given.as_ref().or(summed.as_ref())) {
                (Some(masses), Some(densities)) => {
                    field::volumes(&masses[..], densities, &mut volumes).map_err(failed)?
                }
                (None, Some(densities)) => {
                    field::volumes(Uniform(T::ONE), densities, &mut volumes).map_err(failed)?
                }
                (_, None) => {}
            }
            for quantity in &particles.quantities {
                let values = column(&quantity.values, &quantity.name)?;
                coefficients
                    .push(values.iter().zip(&volumes).map(|(&value, &volume)| volume * value).collect());
            }
            if request.estimate == Estimate::Shepard {
                coefficients.insert(0, volumes);
            }
        }
        let at_particles = summed.filter(|_| at_particles);
        let mut has_density = false;
        if let (Some(masses), None) = (masses, &at_particles) {
            coefficients.insert(0, masses);
            has_density = true;
        }
        Ok(Self { coefficients, has_density, at_particles })
    }
}

/// How sums become the columns of the result.
struct Plan {
    kernel: KernelName,
    estimate: Estimate,
    gradient: bool,
    has_density: bool,
    quantities: usize,
}

/// Rows of the result, of which the first columns are there already.
struct Rows<'a> {
    rows: &'a mut [f64],
    width: usize,
    skip: usize,
}

impl Plan {
    /// The rows of a batch of points.
    fn batch<T: Real, const D: usize>(
        &self,
        fields: &Fields<'_, T, D>,
        points: &Points,
        first: usize,
        Rows { rows, width, skip }: Rows<'_>,
    ) -> Result<Counts, Error> {
        let position = |point: usize| std::array::from_fn(|axis| T::from_f64(points.along(axis)[point]));
        let mut at = vec![[T::ZERO; D]; rows.len() / width];
        parallel::fill(&mut at, |offset| position(first + offset));
        let fits = |x: &[T; D]| x.iter().all(|component| component.is_finite());
        let outside: Vec<usize> = (0..at.len()).filter(|&point| !fits(&at[point])).collect();
        outside.iter().for_each(|&point| at[point] = [T::ZERO; D]);

        let sums = sums(fields, self.kernel, &at, self.gradient)?;
        let stride = (sums.values.len() / at.len().max(1)).max(1);
        let work = rows.chunks_mut(width * CHUNK).zip(sums.values.chunks(stride * CHUNK));
        let counts = parallel::map(work, |chunk, (rows, values)| {
            let mut counts = Counts::default();
            let rows = rows.chunks_exact_mut(width).zip(values.chunks_exact(stride));
            for (point, (row, values)) in (chunk * CHUNK..).zip(rows) {
                if outside.binary_search(&point).is_ok() {
                    row.fill(f64::NAN);
                    counts.overflowed += width;
                    continue;
                }
                let mut cells = row[skip..].iter_mut();
                counts.out_of_reach += usize::from(sums.reached[point] == 0);
                counts.overflowed += self.row::<T, D>(values, |value| {
                    if let Some(cell) = cells.next() {
                        *cell = value;
                    }
                });
            }
            counts
        });
        Ok(counts.into_iter().fold(Counts::default(), |a, b| a + b))
    }

    /// Turns the sums at one point into a row; returns how many values overflowed.
    fn row<T: Real, const D: usize>(&self, sums: &[T], mut put: impl FnMut(f64)) -> usize {
        let stride = if self.gradient { 1 + D } else { 1 };
        let mut overflowed = 0;
        let mut put_finite = |value: T| {
            overflowed += usize::from(!value.is_finite());
            put(if value.is_finite() { value.to_f64() } else { f64::NAN });
        };
        let mut fields = sums.chunks_exact(stride);
        if self.has_density
            && let Some(density) = fields.next()
        {
            density.iter().for_each(|&value| put_finite(value));
        }
        if self.quantities == 0 {
            return overflowed;
        }
        let weights = if self.estimate == Estimate::Shepard { fields.next() } else { None };
        for field in fields.take(self.quantities) {
            match weights {
                None => field.iter().for_each(|&value| put_finite(value)),
                // no value: the row has NaN there already, and nothing overflowed
                Some(weights) if !weights[0].is_above_zero() => return overflowed,
                Some(weights) => {
                    let value = field[0] / weights[0];
                    put_finite(value);
                    for (&slope, &weight_slope) in field[1..].iter().zip(&weights[1..]) {
                        put_finite((slope - value * weight_slope) / weights[0]);
                    }
                }
            }
        }
        overflowed
    }
}
