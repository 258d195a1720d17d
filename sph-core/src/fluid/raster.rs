//! The fluid on a grid of pixels: its density as a byte, and lamps that do not flicker at the surface.
//!
//! ```text
//! density(centre) = Σ_i V / w² (1 − |x_i − centre_x| / w)₊ (1 − |y_i − centre_y| / w)₊        V = 1/4, w = max(pixel, 1)
//! ```
//!
//! A tent on each axis: no root, 1 inside the fluid at rest and about ½ at its surface. Each particle adds its share to the pixels
//! under its tents, in integers: a product for each row, a shift and a sum for each pixel, and no division. Lengths in units of h.
//!
//! [`draw_density`] and [`light_lamps`] work on any memory; [`Raster`] is both in a grid whose size the type has.

use crate::fluid::Particle;
use crate::scalar::compact::Compact;

/// Draws the density of particles into rows of so many `columns`, the first row at the bottom, `pixel` the side of a pixel;
/// pixel (0, 0) begins at 0. [`Raster::FULL`] is fluid at rest.
///
/// A `pixel` that is no number above zero gives zeros, as particles do that are not finite. A particle adds to each pixel a
/// whole number, the nearest one: above a side of 9 h that is nothing. What is left of the memory after whole rows is zero.
/// Particles beyond column or row 65,535, or beyond 2¹⁵ h, are left out.
///
/// ```
/// use sph_core::fluid::{Particle, Raster, raster::draw_density};
/// let particles = [Particle::new([0.5_f32, 0.5], [0.0; 2])];
/// let mut density = [0; 2 * 3];
/// draw_density(&particles, 1.0, 2, &mut density);
/// assert_eq!(density, [Raster::<2, 3>::FULL / 4, 0, 0, 0, 0, 0]); // a quarter of h² of fluid in the first pixel
/// ```
pub fn draw_density<T: Compact>(particles: &[Particle<T, 2>], pixel: T, columns: usize, density: &mut [u8]) {
    density.fill(0);
    let Some(rows) = density.len().checked_div(columns) else { return };
    if !(pixel > T::ZERO && pixel.is_finite()) {
        return;
    }
    let is_wide = pixel > T::ONE;
    let per_width = if is_wide { T::ONE / pixel } else { T::ONE };
    let grid = Grid::new(if is_wide { T::ONE } else { pixel }, per_width, [columns, rows]);
    for particle in particles {
        let mut position = particle.position();
        if is_wide {
            for x in &mut position {
                *x = *x * per_width;
            }
        }
        grid.add(position, columns, density);
    }
}

/// Lights the lamps whose density is `on` at least, puts out those below `off`, and leaves those between as they are.
///
/// ```
/// use sph_core::fluid::raster::light_lamps;
/// let mut lamps = [false, false, true, true];
/// light_lamps(&[100, 80, 80, 60], 96, 64, &mut lamps);
/// assert_eq!(lamps, [true, false, true, false]);
/// ```
pub fn light_lamps(density: &[u8], on: u8, off: u8, lamps: &mut [bool]) {
    for (lamp, &density) in lamps.iter_mut().zip(density) {
        *lamp = lamp_after(*lamp, density, on, off);
    }
}

/// One lamp of [`light_lamps`]: whether it is lit after a frame, from whether it was lit and the density of its pixel.
#[inline]
#[must_use]
pub const fn lamp_after(was_lit: bool, density: u8, on: u8, off: u8) -> bool {
    density >= if was_lit { off } else { on }
}

/// A density as a brightness for displays in grey: 255 for fluid at rest.
///
/// ```
/// use sph_core::fluid::{Raster, raster::brightness};
/// assert_eq!([0, 80, Raster::<1, 1>::FULL, 255].map(brightness), [0, 127, 255, 255]);
/// ```
#[inline]
#[must_use]
pub const fn brightness(density: u8) -> u8 {
    // 160 + 160 · 19 / 32 = 255
    density.saturating_add(((density as u16).wrapping_mul(19) / 32) as u8)
}

/// w, half the width of a tent: lengths here are integers in units of w / 2¹⁶.
const WIDTH: i32 = 1 << 16;
/// Along an axis, pixels that are drawn at most: the product in [`Grid::first`] fits 32 bits.
const MOST: usize = u16::MAX as usize;

/// A length in units of 2^−16, rounded down and held within ±2¹⁵. The fraction is split twice by 8 bits, of numbers below 1: by 16,
/// a scalar of one's own may leave its range.
#[inline(always)]
#[track_caller]
fn length<T: Compact>(x: T) -> i32 {
    let whole = x.floor_to_i32().clamp(-1 << 15, (1 << 15) - 1);
    let (high, rest) = (x - T::ratio(whole, 1)).split(8);
    (whole << 16) | ((high & 0xff) << 8) as i32 | (rest.split(8).0 & 0xff) as i32
}

/// What the tents of all particles have in common.
struct Grid {
    /// The side of a pixel, at most w.
    pixel: i32,
    /// 2²⁴ over the side, rounded down.
    inverse: u32,
    /// 256 times what a particle in the middle of a pixel adds to it.
    light: u32,
    /// Along each axis, the place from which on no tent reaches a pixel.
    end: [i32; 2],
}

impl Grid {
    /// The side of a pixel and 1/w, in units in which the side is at most 1.
    fn new<T: Compact>(pixel: T, per_width: T, counts: [usize; 2]) -> Self {
        let pixel = length(pixel).clamp(1, WIDTH);
        let per_width = u64::from(length(per_width).unsigned_abs());
        let quarter = u64::from(Raster::<0, 0>::FULL) * 256 / 4;
        let mut end = [0; 2];
        for (end, count) in end.iter_mut().zip(counts) {
            let all = (count.min(MOST) as u64).wrapping_mul(pixel as u64).wrapping_add(WIDTH as u64);
            *end = all.min(i32::MAX as u64) as i32;
        }
        Self {
            pixel,
            inverse: (1_u32 << 24).checked_div(pixel as u32).unwrap_or(0),
            light: (quarter.wrapping_mul(per_width).wrapping_mul(per_width) >> 32) as u32,
            end,
        }
    }

    /// No pixel before this one has its centre within w of x, which lies before the end of the axis.
    #[inline(always)]
    fn first(&self, x: i32) -> usize {
        let before = x.wrapping_sub(WIDTH).max(0) as u32 >> 8;
        (before.wrapping_mul(self.inverse) >> 16) as usize
    }

    /// How far the centre of a pixel is beyond the lower end of the tent about x.
    #[inline(always)]
    fn rise(&self, x: i32, index: usize) -> i32 {
        (self.pixel / 2)
            .wrapping_add(self.pixel.wrapping_mul(index as i32))
            .wrapping_sub(x)
            .wrapping_add(WIDTH)
    }

    /// Adds a particle to the pixels under its tents.
    #[inline(always)]
    fn add<T: Compact>(&self, [x, y]: [T; 2], columns: usize, density: &mut [u8]) {
        let (within, [x, y]) = (x.is_finite() & y.is_finite(), [length(x), length(y)]);
        if !within || x <= -WIDTH || y <= -WIDTH || x >= self.end[0] || y >= self.end[1] {
            return;
        }
        let (column, row) = (self.first(x), self.first(y));
        let foot = self.foot(self.rise(x, column), columns.saturating_sub(column));
        let first = column.wrapping_add(foot.before);
        let mut rise = self.rise(y, row);
        let mut rest = density.get_mut(row.wrapping_mul(columns)..).unwrap_or_default();
        while rise < 2 * WIDTH
            && let Some((pixels, above)) = rest.split_at_mut_checked(columns)
        {
            let light = self.light.wrapping_mul(tent(rise)) >> 8;
            if light > 0 {
                self.add_row(pixels.get_mut(first..).unwrap_or_default(), &foot, light);
            }
            rise = rise.wrapping_add(self.pixel);
            rest = above;
        }
    }

    /// The pixels under a tent among the next `count`, the first of which lies `rise` beyond the lower end of the tent.
    #[inline(always)]
    fn foot(&self, mut rise: i32, mut count: usize) -> Foot {
        let mut number = [0_usize; 3];
        let mut tents = [0; 2];
        for (part, end) in [0, WIDTH, 2 * WIDTH - 1].into_iter().enumerate() {
            let begin = rise;
            while rise <= end && count > 0 {
                (number[part], count) = (number[part].wrapping_add(1), count.wrapping_sub(1));
                rise = rise.wrapping_add(self.pixel);
            }
            if part > 0 {
                tents[part - 1] = tent(begin);
            }
        }
        Foot { before: number[0], rising: number[1], falling: number[2], tents }
    }

    /// Adds so much light under a tent to the pixels of a row from its foot on: the shares rise and fall in equal steps.
    #[inline(always)]
    fn add_row(&self, pixels: &mut [u8], foot: &Foot, light: u32) {
        let step = light.wrapping_mul(self.pixel as u32) >> 8;
        let (rising, rest) = pixels.split_at_mut(foot.rising.min(pixels.len()));
        add_shares(rising, light.wrapping_mul(foot.tents[0]), step);
        let falling = foot.falling.min(rest.len());
        add_shares(rest.split_at_mut(falling).0, light.wrapping_mul(foot.tents[1]), step.wrapping_neg());
    }
}

/// Pixels of a row under a tent.
struct Foot {
    /// Before the tent.
    before: usize,
    /// Up to its top.
    rising: usize,
    /// Beyond it.
    falling: usize,
    /// 256 times the tent at the first of those that rise and of those that fall.
    tents: [u32; 2],
}

/// Adds shares in units of 2^−16, each by `step` more than the one before, to the nearest whole number.
#[inline(always)]
fn add_shares(pixels: &mut [u8], share: u32, step: u32) {
    let mut share = share.wrapping_add(1 << 15);
    for pixel in pixels {
        *pixel = pixel.saturating_add((share >> 16) as u8);
        share = share.wrapping_add(step);
    }
}

/// 256 times the tent, at a place that lies `rise` beyond its lower end.
#[inline(always)]
fn tent(rise: i32) -> u32 {
    rise.min((2 * WIDTH).wrapping_sub(rise)).max(0) as u32 >> 8
}

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

    /// Draws the particles anew by [`draw_density`] and [`light_lamps`], `pixel` the side of a pixel; pixel (0, 0) begins at 0. A
    /// `pixel` that is no number above zero shows nothing.
    pub fn update<T: Compact>(&mut self, particles: &[Particle<T, 2>], pixel: T) {
        let density = self.density.as_flattened_mut();
        draw_density(particles, pixel, W, density);
        light_lamps(density, self.on, self.off, self.lit.as_flattened_mut());
    }

    /// The density of a pixel, [`FULL`](Self::FULL) for fluid at rest; 0 outside the grid.
    pub fn density(&self, column: usize, row: usize) -> u8 {
        self.density.get(row).and_then(|densities| densities.get(column)).copied().unwrap_or(0)
    }

    /// The densities, row by row from the bottom.
    pub const fn densities(&self) -> &[[u8; W]; H] {
        &self.density
    }

    /// The density as a brightness for displays in grey: 255 for fluid at rest, 0 outside the grid.
    ///
    /// ```
    /// use sph_core::fluid::{Particle, Raster};
    /// let mut grey = Raster::<1, 1>::new();
    /// grey.update(&[Particle::new([0.5_f32, 0.5], [0.0; 2]); 2], 1.0); // half as much fluid as the pixel holds
    /// assert_eq!(grey.brightness(0, 0), 127);
    /// ```
    pub fn brightness(&self, column: usize, row: usize) -> u8 {
        brightness(self.density(column, row))
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
mod tests;
