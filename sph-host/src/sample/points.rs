//! The points at which fields are wanted.

use super::error::{AXES, SampleError};
use super::particles::Particles;
use super::planes;
use super::request::{Request, SamplePoints};
use super::span::Span;
use crate::io::PointTable;
use crate::output::{Column, Grid};

/// Points as coordinates axis by axis, and the grid they come from, if they do.
#[derive(Clone, Debug)]
pub(super) struct Points {
    /// The axis in space (0 is x) and the coordinates along it.
    coordinates: Vec<(usize, Vec<f64>)>,
    grid: Option<Grid>,
    /// Whether they are the particles, in their order.
    pub(super) are_particles: bool,
}

impl Points {
    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.coordinates[0].1.len()
    }

    /// Some of them, by number.
    pub(super) fn some(&self, numbers: &[usize]) -> Self {
        let some = |(axis, along): &(usize, Vec<f64>)| {
            (*axis, numbers.iter().map(|&number| along[number]).collect())
        };
        Self { coordinates: self.coordinates.iter().map(some).collect(), grid: None, are_particles: false }
    }

    /// The coordinates along an axis in space; none where there are no such coordinates.
    pub(super) fn along(&self, axis: usize) -> &[f64] {
        self.coordinates.iter().find(|(known, _)| *known == axis).map_or(&[], |(_, along)| along)
    }

    /// The axes in space that the points have coordinates along.
    pub(super) fn axes(&self) -> impl Iterator<Item = usize> {
        self.coordinates.iter().map(|(axis, _)| *axis)
    }

    /// The coordinate columns of the result.
    pub(super) fn into_table(self) -> (Vec<Column>, Option<Grid>) {
        let columns = self.coordinates.into_iter().map(|(axis, along)| Column::coordinate(axis, along));
        (columns.collect(), self.grid)
    }
}

/// Makes points, or checks the table that they were read into.
pub(super) fn points(
    request: &Request,
    table: Option<PointTable>,
    particles: Option<&Particles>,
    span: &Span,
    axes: &[usize],
) -> Result<Points, SampleError> {
    let of_columns = |columns: Vec<Vec<f64>>, are_particles| {
        let coordinates = columns.into_iter().enumerate().collect();
        Points { coordinates, grid: None, are_particles }
    };
    match (&request.at, table, particles) {
        (SamplePoints::Grid { counts, bounds }, ..) => grid(counts, bounds.as_deref(), span, axes),
        (_, Some(table), _) => {
            check_axes(&table, request.dim, span, axes)?;
            Ok(of_columns(table.coordinates, false))
        }
        (_, None, Some(particles)) => Ok(of_columns(particles.coordinates.clone(), true)),
        (_, None, None) => Err(SampleError::PiecesAsPoints { file: span.file.clone() }),
    }
}

/// That a table of points has the axes that sums run over, and is flat along others.
fn check_axes(
    table: &PointTable,
    dim: Option<usize>,
    span: &Span,
    axes: &[usize],
) -> Result<(), SampleError> {
    table.require_finite_coordinates()?;
    if table.is_empty() {
        return Ok(());
    }
    let own: Vec<usize> = (0..table.dimensions()).collect();
    let has_all = axes.iter().all(|axis| own.contains(axis));
    if !has_all || (own.len() > axes.len() && dim.is_none()) {
        let names = |axes: &[usize]| axes.iter().map(|&axis| AXES[axis]).collect::<Vec<_>>().join(", ");
        return Err(SampleError::PointCoordinates {
            file: table.source.clone(),
            own: format!("{} ({})", names(&own), own.len()),
            particles: span.file.clone(),
            theirs: format!("{} ({})", names(axes), axes.len()),
        });
    }
    planes::flat_beyond(table, axes)
}

fn grid(
    counts: &[usize],
    bounds: Option<&[f64]>,
    span: &Span,
    axes: &[usize],
) -> Result<Points, SampleError> {
    let (dim, file) = (axes.len(), || span.file.clone());
    if counts.len() != dim {
        return Err(SampleError::GridDimensions { file: file(), dim, counts: counts.to_vec() });
    }
    let (lower, upper): (Vec<f64>, Vec<f64>) = match bounds {
        Some(bounds) => (bounds[..dim].to_vec(), bounds[dim..].to_vec()),
        None => axes.iter().map(|&axis| span.coordinates[axis]).unzip(),
    };
    let is_particles_box = bounds.is_none();
    let grid = Grid::new(counts, &lower, &upper)
        .map_err(|error| SampleError::Grid { file: file(), error, is_particles_box })?
        .along(axes);
    let columns = grid.coordinates().into_iter().map(|column| column.values);
    let coordinates = axes.iter().copied().zip(columns).collect();
    Ok(Points { coordinates, grid: Some(grid), are_particles: false })
}
