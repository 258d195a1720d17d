//! The points at which fields are wanted.

use super::error::{AXES, SampleError};
use super::particles::Particles;
use super::periodic::PeriodicBox;
use super::planes;
use super::request::{PartOfPoints, Request, SamplePoints};
use super::span::Span;
use crate::io::PointTable;
use crate::output::{Column, Grid};

/// Points as coordinates axis by axis, and the grid they come from, if they do.
#[derive(Clone, Debug)]
pub(super) struct Points {
    /// The axis in space (0 is x) and the coordinates along it.
    coordinates: Vec<(usize, Vec<f64>)>,
    /// The same in the periodic box, for the sums.
    in_box: Option<Vec<(usize, Vec<f64>)>>,
    grid: Option<Grid>,
    /// Whether they are the particles of the sums, in their order.
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
        let coordinates = self.of_sums().iter().map(some).collect();
        Self { coordinates, in_box: None, grid: None, are_particles: false }
    }

    /// A share of the points.
    fn part(
        self,
        PartOfPoints { part, shares_layers }: PartOfPoints,
        file: &str,
    ) -> Result<Self, SampleError> {
        let Some(grid) = &self.grid else {
            let range = part.range(self.len());
            let of_axis = |(axis, along): (usize, Vec<f64>)| (axis, along[range.clone()].to_vec());
            let coordinates = self.coordinates.into_iter().map(of_axis).collect();
            return Ok(Self { coordinates, are_particles: false, ..self });
        };
        let layers = grid.counts().last().copied().unwrap_or(0);
        let (file, parts) = (file.to_owned(), part.of());
        let grid = grid.part(part, shares_layers).ok_or(SampleError::TooManyParts { file, layers, parts })?;
        Ok(Self::of_grid(grid))
    }

    fn of_grid(grid: Grid) -> Self {
        let columns = grid.coordinates().into_iter().map(|column| column.values);
        let coordinates = grid.axes().iter().copied().zip(columns).collect();
        Self { coordinates, in_box: None, grid: Some(grid), are_particles: false }
    }

    /// The points for sums in a periodic box.
    pub(super) fn wrapped(self, periodic: &PeriodicBox) -> Self {
        let mut in_box = self.coordinates.clone();
        in_box.iter_mut().for_each(|(axis, along)| periodic.wrap(*axis, along));
        Self { in_box: Some(in_box), are_particles: false, ..self }
    }

    fn of_sums(&self) -> &[(usize, Vec<f64>)] {
        self.in_box.as_ref().unwrap_or(&self.coordinates)
    }

    /// Where sums are made along an axis in space; none where there are no such coordinates.
    pub(super) fn along(&self, axis: usize) -> &[f64] {
        self.of_sums().iter().find(|(known, _)| *known == axis).map_or(&[], |(_, along)| along)
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

/// Makes the points of a request, or checks the table that they were read into; the share of them that is asked for.
pub(super) fn points(
    request: &Request,
    table: Option<PointTable>,
    particles: Option<&Particles>,
    span: &Span,
    axes: &[usize],
) -> Result<Points, SampleError> {
    let all = all_points(request, table, particles, span, axes)?;
    match request.part {
        Some(part) => all.part(part, &span.file),
        None => Ok(all),
    }
}

fn all_points(
    request: &Request,
    table: Option<PointTable>,
    particles: Option<&Particles>,
    span: &Span,
    axes: &[usize],
) -> Result<Points, SampleError> {
    let of_columns = |space: &[usize], columns: Vec<Vec<f64>>, are_particles| {
        let coordinates = space.iter().copied().zip(columns).collect();
        Points { coordinates, in_box: None, grid: None, are_particles }
    };
    match (&request.at, table, particles) {
        (SamplePoints::Grid { counts, bounds }, ..) => grid(counts, bounds.as_deref(), span, axes),
        (_, Some(table), _) => {
            check_axes(&table, request.dim, span, &span.in_space(axes))?;
            Ok(of_columns(&table.space, table.coordinates, false))
        }
        (_, None, Some(particles)) => Ok(of_columns(&particles.space, particles.coordinates.clone(), true)),
        (_, None, None) => Err(SampleError::PiecesAsPoints { file: span.file.clone() }),
    }
}

/// That a table of points has the axes in space that sums run over, and is flat along others.
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
    let own = &table.space;
    let has_all = axes.iter().all(|axis| own.contains(axis));
    if !has_all || (own.len() > axes.len() && dim.is_none()) {
        let names = |axes: &[usize]| axes.iter().map(|&axis| AXES[axis]).collect::<Vec<_>>().join(", ");
        return Err(SampleError::PointCoordinates {
            file: table.source.clone(),
            own: format!("{} ({})", names(own), own.len()),
            particles: span.file.clone(),
            theirs: format!("{} ({})", names(axes), axes.len()),
        });
    }
    planes::flat_beyond(table, axes)
}

/// Where a plane or a line of particles lies along the axes that sums do not run over; 0 along those that the file has not.
fn beside(span: &Span, axes: &[usize]) -> [f64; 3] {
    let mut place = [0.0; 3];
    for (number, (&axis, bounds)) in span.space.iter().zip(&span.coordinates).enumerate() {
        if !axes.contains(&number) {
            place[axis] = bounds.0;
        }
    }
    place
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
        .along(&span.in_space(axes), beside(span, axes));
    Ok(Points::of_grid(grid))
}
