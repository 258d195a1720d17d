//! The sums of a request at every point, in parallel; no bit depends on the number of threads.

use std::time::Instant;

use sph_core::{Field, Scalar, Sources};

use super::load::Particles;
use super::points::Points;
use super::request::{Estimate, Request};
use super::scene::Scene;
use super::stencil::{Contribution, Stencil};
use super::units::Units;
use crate::failure::Failure;
use crate::output::Column;
use crate::parallel;
use crate::progress::Progress;

/// The columns of the result, and what was counted on the way.
#[derive(Clone, Debug, Default)]
pub(super) struct Evaluated {
    pub(super) columns: Vec<Column>,
    pub(super) counts: Counts,
    pub(super) search_seconds: f64,
    pub(super) evaluate_seconds: f64,
}

/// Points, or values, that have nothing to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    /// Points with no particle in reach.
    pub(super) out_of_reach: usize,
    /// Points whose particles do not carry the corrected estimate.
    pub(super) ill_conditioned: usize,
    /// Values outside the range of the scalar.
    pub(super) overflowed: usize,
}

impl std::ops::Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            out_of_reach: self.out_of_reach + other.out_of_reach,
            ill_conditioned: self.ill_conditioned + other.ill_conditioned,
            overflowed: self.overflowed + other.overflowed,
        }
    }
}

/// Points that one thread takes at a time.
const CHUNK: usize = 1024;

/// Evaluates a request in the scalar T and D dimensions.
pub(super) fn evaluate<T: Scalar, const D: usize>(
    request: &Request,
    particles: &Particles,
    points: &Points,
    progress: &dyn Progress,
) -> Result<Evaluated, Failure> {
    let start = Instant::now();
    let units = Units::<D>::of::<T>(particles);
    let scene = Scene::<T, D>::new(particles, request.kernel, &units)?;
    let search_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let sums = Sums { scene: &scene, estimate: request.estimate, gradient: request.gradient };
    let names = names(particles, request.gradient);
    let scales = sums.scales(&units);
    let width = names.len().max(1);
    let mut rows = vec![f64::NAN; width * points.len()];
    let counts = parallel::map(rows.chunks_mut(width * CHUNK), |chunk, rows| {
        let (mut counts, mut near) = (Counts::default(), Vec::new());
        for (offset, row) in rows.chunks_exact_mut(width).enumerate() {
            let point = chunk * CHUNK + offset;
            let x = units.position(std::array::from_fn(|axis| points.along(axis)[point]));
            sums.row(&x, &mut near, &mut Row { cells: row.iter_mut(), counts: &mut counts });
            row.iter_mut().zip(&scales).for_each(|(value, scale)| *value *= scale);
        }
        progress.advance((rows.len() / width) as u64);
        counts
    });
    let counts = counts.into_iter().fold(Counts::default(), |a, b| a + b);
    let columns = columns(names, &rows);
    let evaluate_seconds = start.elapsed().as_secs_f64();
    Ok(Evaluated { columns, counts, search_seconds, evaluate_seconds })
}

/// The columns' names, `NAME` and then `NAME_dx` and so on.
pub(super) fn names(particles: &Particles, gradient: bool) -> Vec<String> {
    let density = particles.masses.as_ref().map(|_| "density");
    let fields = particles.quantities.iter().map(|quantity| quantity.name.as_str());
    let mut names = Vec::new();
    for field in density.into_iter().chain(fields) {
        names.push(field.to_owned());
        if gradient {
            names.extend(["dx", "dy", "dz"].iter().take(particles.dim).map(|axis| format!("{field}_{axis}")));
        }
    }
    names
}

/// Rows of numbers as named columns.
pub(super) fn columns(names: Vec<String>, rows: &[f64]) -> Vec<Column> {
    let width = names.len();
    let column =
        |(column, name)| Column::new(name, rows.iter().skip(column).step_by(width).copied().collect());
    names.into_iter().enumerate().map(column).collect()
}

/// What is summed at each point.
struct Sums<'a, T, const D: usize> {
    scene: &'a Scene<T, D>,
    estimate: Estimate,
    gradient: bool,
}

/// One row of the result on its way; it starts full of NaN, which stands for no value.
struct Row<'a> {
    cells: std::slice::IterMut<'a, f64>,
    counts: &'a mut Counts,
}

impl Row<'_> {
    fn put<T: Scalar>(&mut self, value: Option<T>) {
        let cell = self.cells.next();
        match (value, cell) {
            (Some(value), Some(cell)) if value.is_finite() => *cell = value.to_f64(),
            (Some(_), _) => self.counts.overflowed += 1,
            (None, _) => {}
        }
    }

    fn put_all<T: Scalar, const D: usize>(&mut self, values: Option<[T; D]>) {
        for axis in 0..D {
            self.put(values.map(|values| values[axis]));
        }
    }
}

impl<T: Scalar, const D: usize> Sums<'_, T, D> {
    /// What each column is multiplied with to be in the file's units.
    fn scales(&self, units: &Units<D>) -> Vec<f64> {
        let density = self.scene.masses.as_ref().map(|_| units.density());
        let mut scales = Vec::new();
        for unit in density.into_iter().chain(units.quantities.iter().copied()) {
            scales.push(unit);
            if self.gradient {
                scales.extend([unit / units.length; D]);
            }
        }
        scales
    }

    /// One row of the result at x.
    fn row(&self, x: &[T; D], buffer: &mut Vec<Contribution<T, D>>, row: &mut Row<'_>) {
        // a scalar that stays at the end of its range would put the point there
        if x.iter().any(|component| !component.is_finite() && component.to_f64().is_finite()) {
            row.counts.overflowed += row.cells.len();
            return;
        }
        let stencil =
            Stencil::gather(buffer, &self.scene.search(), self.scene.influences(), x, self.gradient);
        row.counts.out_of_reach += usize::from(stencil.is_empty());
        if let Some(masses) = &self.scene.masses {
            let sources = Sources::assume_checked(stencil, stencil.pick(masses));
            if self.gradient {
                let (density, slope) = sources.density_gradient_at(stencil, x);
                row.put(Some(density));
                row.put_all(Some(slope));
            } else {
                row.put(Some(sources.density_at(stencil, x)));
            }
        }
        if !self.scene.values.is_empty() {
            self.fields(x, stencil, row);
        }
    }

    /// The fields' part of a row.
    fn fields(&self, x: &[T; D], stencil: Stencil<'_, T, D>, row: &mut Row<'_>) {
        let volumes = Sources::assume_checked(stencil, stencil.pick(&self.scene.volumes));
        let is_corrected = self.estimate == Estimate::Corrected;
        let basis = if is_corrected { volumes.linear_basis_at(stencil, x) } else { None };
        row.counts.ill_conditioned += usize::from(is_corrected && basis.is_none() && !stencil.is_empty());
        for values in &self.scene.values {
            let Ok(field) = Field::new(&volumes, stencil.pick(values)) else { continue };
            let (value, slope) = match self.estimate {
                Estimate::Plain if self.gradient => {
                    let (value, slope) = field.interpolate_with_gradient_at(stencil, x);
                    (Some(value), Some(slope))
                }
                Estimate::Plain => (Some(field.interpolate_at(stencil, x)), None),
                Estimate::Shepard if self.gradient => field.shepard_gradient_at(stencil, x).unzip(),
                Estimate::Shepard => (field.shepard_at(stencil, x), None),
                Estimate::Corrected => {
                    let fit = basis.as_ref().and_then(|basis| field.fit_at(basis, stencil, x));
                    fit.map(|fit| (fit.value, fit.gradient)).unzip()
                }
            };
            row.put(value);
            if self.gradient {
                row.put_all(slope);
            }
        }
    }
}
