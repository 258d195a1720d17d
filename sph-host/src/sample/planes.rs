//! Axes along which all coordinates are equal, and those that sums run over.
//!
//! A *coordinate* is counted among those that the file has, an *axis* in space: of a file with x and z, coordinate 1 is along axis 2.

use super::error::SampleError;
use super::particles::bounds;
use super::span::{Bounds, Span};
use crate::io::PointTable;

/// The coordinates that sums run over where `dim` dimensions are asked for: those of the file, the last that are constant left out.
pub(super) fn summed(span: &Span, dim: Option<usize>) -> Result<Vec<usize>, SampleError> {
    chosen(&span.file, &span.coordinates, dim, |coordinate, dim| {
        let ((before, value), axis) = (span.coordinates[coordinate], span.space[coordinate]);
        SampleError::NotFlat { file: span.file.clone(), at: String::new(), axis, value, before, dim }
    })
}

/// The same of a table, whose rows an error names.
pub(super) fn summed_of(table: &PointTable, dim: Option<usize>) -> Result<Vec<usize>, SampleError> {
    let bounds: Vec<_> = table.coordinates.iter().map(|along| bounds(along)).collect();
    chosen(&table.source, &bounds, dim, |coordinate, dim| not_flat(table, coordinate, dim))
}

fn chosen(
    file: &str,
    coordinates: &[Bounds],
    dim: Option<usize>,
    not_flat: impl Fn(usize, usize) -> SampleError,
) -> Result<Vec<usize>, SampleError> {
    let own = coordinates.len();
    let asked = dim.unwrap_or(own);
    if asked > own {
        return Err(SampleError::TooFewCoordinates { file: file.to_owned(), own, asked });
    }
    let mut kept: Vec<usize> = (0..own).collect();
    for coordinate in constant(coordinates).into_iter().rev().take(own - asked) {
        kept.retain(|&other| other != coordinate);
    }
    kept.get(asked).map_or(Ok(()), |&coordinate| Err(not_flat(coordinate, asked)))?;
    Ok(kept)
}

/// The coordinates of equal bounds.
pub(super) fn constant(coordinates: &[Bounds]) -> Vec<usize> {
    let numbered = coordinates.iter().enumerate();
    numbered.filter(|(_, (lower, upper))| lower == upper).map(|(number, _)| number).collect()
}

/// That the coordinates of a table are equal along all axes in space but these.
pub(super) fn flat_beyond(table: &PointTable, axes: &[usize]) -> Result<(), SampleError> {
    let is_flat = |along: &Vec<f64>| along.iter().all(|value| *value == along[0]);
    let mut others = (0..table.dimensions()).filter(|&coordinate| !axes.contains(&table.space[coordinate]));
    match others.find(|&coordinate| !is_flat(&table.coordinates[coordinate])) {
        Some(coordinate) => Err(not_flat(table, coordinate, axes.len())),
        None => Ok(()),
    }
}

/// The error for a coordinate that is to be dropped, with the first row that has another one than those before.
fn not_flat(table: &PointTable, coordinate: usize, dim: usize) -> SampleError {
    let (along, axis) = (&table.coordinates[coordinate], table.space[coordinate]);
    let row = along.iter().position(|&value| value != along[0]).unwrap_or(0);
    let (file, at) = (table.source.clone(), format!("{}: ", table.locate(row)));
    SampleError::NotFlat { file, at, axis, value: along[row], before: along[0], dim }
}
