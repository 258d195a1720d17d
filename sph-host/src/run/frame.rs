//! The fluid at one time as a file, and back to the same bits.

use std::path::Path;

use crate::engine::Snapshot;
use crate::io::{self, ReadError};
use crate::output::{Column, Precision, Table};

const AXES: [&str; 3] = ["x", "y", "z"];

/// The snapshot as a table that [`restore`] reads to the same bits.
pub(super) fn table<const D: usize>(now: &Snapshot<D>, precision: Precision) -> Table {
    let along = |vectors: &[[f64; D]], axis: usize| vectors.iter().map(|vector| vector[axis]).collect();
    let mut columns: Vec<Column> = (0..D)
        .map(|axis| Column::new(format!("velocity_{}", AXES[axis]), along(&now.velocities, axis)))
        .collect();
    columns.push(Column::new("density", now.densities.clone()));
    columns.push(Column::new("pressure", now.pressures.clone()));
    Table {
        coordinates: (0..D).map(|axis| Column::new(AXES[axis], along(&now.positions, axis))).collect(),
        columns,
        grid: None,
        precision,
        caption: format!("t = {} s", now.time),
    }
}

/// Reads a frame of this time back.
pub(super) fn restore<const D: usize>(path: &Path, time: f64) -> Result<Snapshot<D>, ReadError> {
    let table = io::read(path)?;
    let read = |name: &str| table.quantity(name).map(|quantity| quantity.values.to_vec());
    let mut velocities = vec![[0.0; D]; table.len()];
    let mut positions = vec![[0.0; D]; table.len()];
    for axis in 0..D {
        let along = read(&format!("velocity_{}", AXES[axis]))?;
        for (velocity, value) in velocities.iter_mut().zip(along) {
            velocity[axis] = value;
        }
        for (position, &value) in positions.iter_mut().zip(table.coordinates.get(axis).into_iter().flatten())
        {
            position[axis] = value;
        }
    }
    Ok(Snapshot { time, positions, velocities, densities: read("density")?, pressures: read("pressure")? })
}
