//! The fluid at one time as a file and as a picture.

use std::path::Path;

use super::case::View;
use super::simulation::Snapshot;
use crate::failure::Failure;
use crate::io;
use crate::output::{Column, Precision, Table};
use crate::picture::{Image, Palette, PictureError, particles};
use crate::scalar_choice::ScalarName;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Pixels across a picture.
const WIDTH: u32 = 900;

/// The snapshot as a table that [`restore`] reads to the same bits.
pub(super) fn table<const D: usize>(now: &Snapshot<D>, scalar: ScalarName) -> Table {
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
        precision: if scalar == ScalarName::F32 { Precision::F32 } else { Precision::F64 },
        caption: format!("t = {} s", now.time),
    }
}

/// Reads a frame back.
pub(super) fn restore<const D: usize>(path: &Path, time: f64) -> Result<Snapshot<D>, Failure> {
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

/// The particles coloured by their speed; in three dimensions as seen from the side.
pub(super) fn picture<const D: usize>(
    now: &Snapshot<D>,
    view: &View,
    title: &str,
) -> Result<Image, PictureError> {
    let mut order: Vec<usize> = (0..now.positions.len()).collect();
    if D == 3 {
        // from the back to the front
        order.sort_by(|&i, &j| now.positions[j][1].total_cmp(&now.positions[i][1]));
    }
    let positions: Vec<[f64; 2]> =
        order.iter().map(|&i| [now.positions[i][0], now.positions[i][D - 1]]).collect();
    let speed = |i: usize| now.velocities[i].iter().map(|part| part * part).sum::<f64>().sqrt();
    let speeds: Vec<f64> = order.iter().map(|&i| speed(i)).collect();
    particles::draw(&particles::Frame {
        title,
        positions: &positions,
        values: &speeds,
        value_title: "speed / (m/s)",
        range: [0.0, view.speed],
        palette: Palette::Viridis,
        lower: view.lower,
        upper: view.upper,
        radius: view.radius,
        width: WIDTH,
    })
}
