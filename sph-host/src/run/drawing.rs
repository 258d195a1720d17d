//! The picture of a frame: particles as discs, or lamps that they light.

use sph_core::fluid::{Particle, Raster};
use sph_core::vector::norm_squared;

use crate::engine::Snapshot;
use crate::picture::{Image, Palette, PictureError, particles as discs};

/// Pixels across a picture.
const WIDTH: u32 = 900;

/// What pictures show, in metres.
pub(super) struct View {
    /// The lower corner of the box, across and up.
    pub(super) lower: [f64; 2],
    /// The upper corner of the box.
    pub(super) upper: [f64; 2],
    /// The radius of a particle.
    pub(super) radius: f64,
    /// The greatest speed of the colours, m/s.
    pub(super) speed: f64,
}

/// The particles coloured by their speed; in three dimensions as seen from the side.
pub(super) fn particles<const D: usize>(
    now: &Snapshot<D>,
    view: &View,
    title: &str,
) -> Result<Image, PictureError> {
    let mut order: Vec<usize> = (0..now.positions.len()).collect();
    if D == 3 {
        // From the back to the front: a nearer particle covers one behind it.
        order.sort_by(|&i, &j| now.positions[j][1].total_cmp(&now.positions[i][1]));
    }
    let positions: Vec<[f64; 2]> =
        order.iter().map(|&i| [now.positions[i][0], now.positions[i][D - 1]]).collect();
    let speed = |i: usize| norm_squared(&now.velocities[i]).sqrt();
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
