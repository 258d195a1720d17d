//! Axes along which all coordinates are equal, and those that sums run over.

use super::error::SampleError;
use super::particles::bounds;
use super::span::Bounds;
use crate::io::PointTable;

/// The axes that sums run over where `dim` dimensions are asked for: those of the file, the last that are constant left out.
pub(super) fn axes(
    file: &str,
    coordinates: &[Bounds],
    dim: Option<usize>,
) -> Result<Vec<usize>, SampleError> {
    let own = coordinates.len();
    let asked = dim.unwrap_or(own);
    if asked > own {
        return Err(SampleError::TooFewCoordinates { file: file.to_owned(), own, asked });
    }
    let mut axes: Vec<usize> = (0..own).collect();
    for axis in constant(coordinates).into_iter().rev().take(own - asked) {
        axes.retain(|&kept| kept != axis);
    }
    if let Some(&axis) = axes.get(asked) {
        let (before, value) = coordinates[axis];
        let (file, at) = (file.to_owned(), String::new());
        return Err(SampleError::NotFlat { file, at, axis, value, before, dim: asked });
    }
    Ok(axes)
}

/// The axes of equal bounds.
pub(super) fn constant(coordinates: &[Bounds]) -> Vec<usize> {
    let axes = coordinates.iter().enumerate();
    axes.filter(|(_, (lower, upper))| lower == upper).map(|(axis, _)| axis).collect()
}

/// The axes of a table that sums run over.
pub(super) fn axes_of(table: &PointTable, dim: Option<usize>) -> Result<Vec<usize>, SampleError> {
    let bounds: Vec<_> = table.coordinates.iter().map(|axis| bounds(axis)).collect();
    axes(&table.source, &bounds, dim).map_err(|error| match error {
        SampleError::NotFlat { axis, dim, .. } => not_flat(table, axis, dim),
        other => other,
    })
}

/// That the coordinates of a table are equal along all axes but these.
pub(super) fn flat_beyond(table: &PointTable, axes: &[usize]) -> Result<(), SampleError> {
    let is_flat = |along: &Vec<f64>| along.iter().all(|value| *value == along[0]);
    let mut others = (0..table.dimensions()).filter(|axis| !axes.contains(axis));
    match others.find(|&axis| !is_flat(&table.coordinates[axis])) {
        Some(axis) => Err(not_flat(table, axis, axes.len())),
        None => Ok(()),
    }
}

/// The error for an axis that is to be dropped, with the first row that has another coordinate than those before.
fn not_flat(table: &PointTable, axis: usize, dim: usize) -> SampleError {
    let along = &table.coordinates[axis];
    let row = along.iter().position(|&value| value != along[0]).unwrap_or(0);
    let (file, at) = (table.source.clone(), format!("{}: ", table.locate(row)));
    SampleError::NotFlat { file, at, axis, value: along[row], before: along[0], dim }
}
