//! The fluid on a grid of pixels: its density as a byte, and lamps that do not flicker at the surface.
//!
//! ```text
//! density(centre) = Σ_i V / w² (1 − |x_i − centre_x| / w)₊ (1 − |y_i − centre_y| / w)₊        V = 1/4, w = max(pixel, 1)
//! ```
//!
//! A tent on each axis: no root, 1 inside the fluid at rest and about ½ at its surface.
//! Lengths in units of h.

use crate::fluid::Particle;
use crate::scalar::compact::Compact;

/// W × H pixels, the first row at the bottom, each with a density and a lamp.
///
/// ```
/// use sph_core::fluid::{Particle, Raster};
/// let mut lamps = Raster::<4, 3>::new();
/// // a puddle two spacings deep that covers the left half of the floor
/// let place = |k: usize| [0.25 + 0.5 * (k % 4) as f32, 0.25 + 0.5 * (k / 4) as f32];
/// let puddle: [_; 8] = core::array::from_fn(|k| Particle::new(place(k), [0.0; 2]));
/// lamps.update(&puddle, 1.0);
/// assert!(lamps.is_lit(0, 0) && !lamps.is_lit(3, 0) && !lamps.is_lit(0, 1));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Raster<const W: usize, const H: usize> {
    density: [[u8; W]; H],
    lit: [[bool; W]; H],
    on: u8,
    off: u8,
}

/// [`FULL`](Raster::FULL) times a share of at most ¼, rounded: 5/8 of its 256ths, in integers, since a type of few integer bits does not
/// hold the product.
fn in_bytes<T: Compact>(share: T) -> u8 {
    let (whole, rest) = share.split(8);
    let fifths = rest.times(5).floor_to_i32().clamp(0, 4) as usize;
    let eighths = whole.min(255).wrapping_mul(5).wrapping_add(fifths).wrapping_add(4);
    (eighths / 8) as u8
}

impl<const W: usize, const H: usize> Raster<W, H> {
    /// The density of a pixel full of fluid at rest. Bytes end at 255, 1.6 times that.
    pub const FULL: u8 = 160;

    /// All dark. A lamp comes on at 60 % of [`FULL`](Self::FULL) and goes out below 40 %.
    pub const fn new() -> Self {
        Self::with_thresholds(96, 64)
    }

    /// All dark. A lamp comes on at the density `on` and goes out below `off`, which should be the smaller.
    pub const fn with_thresholds(on: u8, off: u8) -> Self {
        Self { density: [[0; W]; H], lit: [[false; W]; H], on, off }
    }

    /// Draws the particles anew, `pixel` the side of a pixel; pixel (0, 0) begins at 0. A `pixel` that is no number above
    /// zero shows nothing.
    pub fn update<T: Compact>(&mut self, particles: &[Particle<T, 2>], pixel: T) {
        self.density = [[0; W]; H];
        if pixel > T::ZERO && pixel.is_finite() {
            let width = pixel.max(T::ONE);
            for particle in particles {
                self.add(particle.position(), pixel, width);
            }
        }
        for (lamps, densities) in self.lit.iter_mut().zip(&self.density) {
            for (lamp, &density) in lamps.iter_mut().zip(densities) {
                *lamp = density >= if *lamp { self.off } else { self.on };
            }
        }
    }

    fn add<T: Compact>(&mut self, [x, y]: [T; 2], pixel: T, width: T) {
        let span = |coordinate: T, count: usize| {
            let first = ((coordinate - width) / pixel).floor_to_i32().max(0) as usize;
            let last = ((coordinate + width) / pixel).floor_to_i32().max(0) as usize;
            (first.min(count), last.saturating_add(1).min(count))
        };
        let tent = |coordinate: T, index: usize| {
            let centre = pixel.times(index as i32) + pixel * T::ratio(1, 2);
            (T::ONE - (coordinate - centre).abs() / width).positive_part()
        };
        let share = T::ratio(1, 4) / width / width;
        let (columns, rows) = (span(x, W), span(y, H));
        for (row, densities) in self.density.iter_mut().enumerate().take(rows.1).skip(rows.0) {
            let along = tent(y, row) * share;
            for (column, density) in densities.iter_mut().enumerate().take(columns.1).skip(columns.0) {
                *density = density.saturating_add(in_bytes(along * tent(x, column)));
            }
        }
    }

    /// The density of a pixel, [`FULL`](Self::FULL) for fluid at rest; 0 outside the grid.
    pub fn density(&self, column: usize, row: usize) -> u8 {
        self.density.get(row).and_then(|densities| densities.get(column)).copied().unwrap_or(0)
    }

    /// Whether a lamp is on; false outside the grid.
    pub fn is_lit(&self, column: usize, row: usize) -> bool {
        self.lit.get(row).and_then(|lamps| lamps.get(column)).copied().unwrap_or(false)
    }

    /// The lamps, row by row from the bottom.
    pub const fn lamps(&self) -> &[[bool; W]; H] {
        &self.lit
    }

    /// Draws the grid on a display, one pixel of it for each, the last row at the top: `colour` of its density and lamp.
    ///
    /// # Errors
    /// What the display answers.
    #[cfg(feature = "embedded-graphics")]
    pub fn draw<D: embedded_graphics_core::draw_target::DrawTarget>(
        &self,
        display: &mut D,
        top_left: embedded_graphics_core::geometry::Point,
        colour: impl Fn(u8, bool) -> D::Color,
    ) -> Result<(), D::Error> {
        use embedded_graphics_core::{Pixel, geometry::Point};
        let rows = self.density.iter().zip(&self.lit).rev().enumerate();
        display.draw_iter(rows.flat_map(|(y, (densities, lamps))| {
            let colour = &colour;
            densities.iter().zip(lamps).enumerate().map(move |(x, (&density, &lit))| {
                let at = Point::new(top_left.x.saturating_add(x as i32), top_left.y.saturating_add(y as i32));
                Pixel(at, colour(density, lit))
            })
        }))
    }
}

impl<const W: usize, const H: usize> Default for Raster<W, H> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fluid that fills the box from 0 to 4 × 3 at the spacing of rest.
    fn filled(shift: f32) -> [Particle<f32, 2>; 48] {
        core::array::from_fn(|k| {
            Particle::new([0.25 + 0.5 * (k % 8) as f32 + shift, 0.25 + 0.5 * (k / 8) as f32], [0.0; 2])
        })
    }

    /// One particle gives a pixel a quarter of [`Raster::FULL`], 40: more than the largest number of these types.
    #[cfg(feature = "fixed")]
    #[test]
    fn a_type_that_ends_below_a_share_of_light_gives_it_all_the_same() {
        use crate::scalar::fixed::{Saturating, types};
        fn densities<T: Compact>() -> [[u8; 4]; 3] {
            let mut raster = Raster::<4, 3>::new();
            let at = |k: i32| [T::ratio(3 * k % 31, 8), T::ratio(7 * k % 23, 8)];
            let particles: [Particle<T, 2>; 20] =
                core::array::from_fn(|k| Particle::new(at(k as i32), [T::ZERO; 2]));
            raster.update(&particles, T::ONE);
            raster.density
        }
        let exact = densities::<f64>();
        assert!(exact.iter().flatten().any(|density| *density > 40));
        for found in [densities::<Saturating<types::I5F11>>(), densities::<Saturating<types::I4F12>>()] {
            for (found, exact) in found.iter().flatten().zip(exact.iter().flatten()) {
                assert!(found.abs_diff(*exact) <= 2, "{found} for {exact}");
            }
        }
    }

    #[test]
    fn the_inside_is_full_and_the_outside_dark() {
        for pixel in [0.5_f32, 1.0] {
            let mut raster = Raster::<12, 12>::new();
            raster.update(&filled(0.0), pixel);
            let middle = (1.5 / pixel) as usize;
            let density = i32::from(raster.density(middle, middle));
            assert!((density - 160).abs() <= 10, "{density} at {pixel}");
            let beyond = (5.0 / pixel) as usize;
            assert_eq!((raster.density(beyond, 0), raster.is_lit(beyond, 0)), (0, false));
            assert!(raster.is_lit(middle, middle));
        }
    }

    #[test]
    fn a_lamp_at_the_surface_does_not_flicker() {
        let mut raster = Raster::<8, 4>::new();
        let mut changes = 0;
        let mut was = false;
        for frame in 0..100 {
            // the surface trembles by a fifth of a pixel around the middle of the fifth column
            let shift = if frame % 2 == 0 { 0.4 } else { 0.6 };
            raster.update(&filled(shift), 1.0);
            changes += usize::from(raster.is_lit(4, 1) != was);
            was = raster.is_lit(4, 1);
        }
        assert!(changes <= 1, "{changes}");
    }

    #[test]
    fn a_lamp_stays_as_it_is_between_the_thresholds() {
        let mut raster = Raster::<8, 4>::new();
        let (mut dark_between, mut lit_between, mut was) = (0, 0, false);
        // the surface goes right through the fifth column and back
        for step in (0..=100).chain((0..100).rev()) {
            raster.update(&filled(step as f32 / 100.0), 1.0);
            let (density, is_lit) = (raster.density(4, 1), raster.is_lit(4, 1));
            match density {
                0..64 => assert!(!is_lit),
                96.. => assert!(is_lit),
                _ => {
                    assert_eq!(is_lit, was, "{density}");
                    dark_between += usize::from(!is_lit);
                    lit_between += usize::from(is_lit);
                }
            }
            was = is_lit;
        }
        assert!(dark_between > 0 && lit_between > 0);
    }

    #[test]
    fn senseless_pixels_show_nothing() {
        let mut raster = Raster::<3, 3>::new();
        for pixel in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            raster.update(&filled(0.0), pixel);
            assert_eq!(raster.lamps(), &[[false; 3]; 3]);
        }
        assert_eq!((raster.density(3, 0), raster.is_lit(0, 3)), (0, false));
    }

    #[cfg(feature = "embedded-graphics")]
    #[test]
    fn is_drawn_with_the_last_row_at_the_top() {
        use core::convert::Infallible;
        use embedded_graphics_core::{Pixel, pixelcolor::BinaryColor, prelude::*};

        struct Display([[bool; 6]; 6]);
        impl OriginDimensions for Display {
            fn size(&self) -> Size {
                Size::new(6, 6)
            }
        }
        impl DrawTarget for Display {
            type Color = BinaryColor;
            type Error = Infallible;
            fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
                &mut self,
                pixels: I,
            ) -> Result<(), Infallible> {
                for Pixel(at, colour) in pixels {
                    self.0[at.y as usize][at.x as usize] = colour.is_on();
                }
                Ok(())
            }
        }

        let mut raster = Raster::<4, 3>::new();
        raster.update(&filled(0.0)[..8], 1.0); // one row of particles at the bottom, fluid half a pixel deep
        let mut display = Display([[false; 6]; 6]);
        let lit = |density, _| BinaryColor::from(density > 40);
        raster.draw(&mut display, Point::new(1, 2), lit).unwrap();
        let rows = display.0.map(|row| row.iter().filter(|&&on| on).count());
        assert_eq!(rows, [0, 0, 0, 0, 4, 0]);
    }
}
