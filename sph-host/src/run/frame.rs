//! The fluid at one time as a file and as a picture.

use std::path::Path;

use super::case::View;
use crate::engine::Snapshot;
use crate::failure::Failure;
use crate::io;
use crate::output::{Column, Precision, Table};
use crate::picture::{Image, Palette, PictureError, particles as discs};
use sph_core::fluid::{Particle, Raster};

const AXES: [&str; 3] = ["x", "y", "z"];

/// Pixels across a picture.
const WIDTH: u32 = 900;

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
pub(super) fn particles<const D: usize>(
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
    discs::draw(&discs::Frame {
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

/// Lamps along an axis of [`lamps`] at most.
const LAMPS: usize = 64;

/// A lamp for each square of side `pixel`, as [`Raster`] lights them. Without what was lit before: a frame's picture depends on
/// the frame alone.
pub(super) fn lamps(now: &Snapshot<2>, view: &View, pixel: f64, title: &str) -> Result<Image, PictureError> {
    let pixel = pixel.max((view.upper[0] - view.lower[0]) / LAMPS as f64);
    let unit = 4.0 * view.radius;
    let in_units = now.positions.iter().map(|x| Particle::new(x.map(|x| (x / unit) as f32), [0.0; 2]));
    let particles: Vec<Particle<f32, 2>> = in_units.collect();
    let mut raster = Box::new(Raster::<LAMPS, LAMPS>::new());
    raster.update(&particles, (pixel / unit) as f32);
    let [columns, rows] =
        [0, 1].map(|axis| ((view.upper[axis] - view.lower[axis]) / pixel).round().max(1.0) as usize);
    let grid = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let centre = |index: usize| (index as f64 + 0.5) * pixel;
    let positions: Vec<[f64; 2]> = grid.clone().map(|(column, row)| [centre(column), centre(row)]).collect();
    let values: Vec<f64> =
        grid.map(|(column, row)| f64::from(u8::from(raster.is_lit(column, row)))).collect();
    discs::draw(&discs::Frame {
        title,
        positions: &positions,
        values: &values,
        value_title: "lamp",
        range: [0.0, 1.0],
        palette: Palette::Viridis,
        lower: view.lower,
        upper: view.upper,
        radius: 0.42 * pixel,
        width: WIDTH,
    })
}
