//! The pendant without its board: a fluid in a box, what a sensor says made into its gravity, and its picture.

#![no_std]

use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid, Raster};
use sph_core::scalar::fixed::{I16F16, Saturating};

/// The scalar: no board here computes with floating-point numbers.
pub type T = Saturating<I16F16>;

/// How many particles.
pub const PARTICLES: usize = 200;
/// The display in pixels.
pub const DISPLAY: [usize; 2] = [128, 64];
/// The pixels within the frame, which is a line about the display and a dark line inside it.
pub const INSIDE: [usize; 2] = [DISPLAY[0] - 4, DISPLAY[1] - 4];
/// Pixels to a support radius.
const PIXELS: i32 = 8;
/// What the sensor says of 1 g.
const G: i32 = 16384;
/// 1 g in h/1000 a step².
const GRAVITY: i32 = 5;

/// 15.5 by 7.5 support radii of fluid, and its picture.
pub struct Pendant {
    fluid: PositionBasedFluid<T, OpenBox<T, 2>, 2, PARTICLES, 128, u8>,
    raster: Raster<{ INSIDE[0] }, { INSIDE[1] }>,
}

impl Pendant {
    /// The RAM it takes.
    pub const BYTES: usize = size_of::<Self>();

    /// An empty box.
    #[expect(clippy::new_without_default, reason = "for a static alone")]
    pub const fn new() -> Self {
        let size = [T::new(I16F16::lit("15.5")), T::new(I16F16::lit("7.5"))];
        Self { fluid: PositionBasedFluid::new(OpenBox::new(size)), raster: Raster::new() }
    }

    /// Fills the box from the bottom, 31 particles in a row.
    pub fn fill(&mut self) {
        for k in 0..PARTICLES as i32 {
            let place = [k % 31, k / 31].map(|n| sph_core::Arithmetic::ratio(2 * n + 1, 4));
            // there is room for all of them, and all places are in the box
            let _ = self.fluid.add(Particle::new(place, [T::default(); 2]));
        }
    }

    /// Moves the fluid by one step. At rest a sensor reads the force that holds it up: the fluid runs the other way.
    pub fn step(&mut self, reading: [i16; 2]) {
        let gravity = |reading: i16| sph_core::Arithmetic::ratio(-GRAVITY * i32::from(reading), 1000 * G);
        self.fluid.step(reading.map(gravity));
    }

    /// Draws the fluid.
    pub fn draw(&mut self) {
        self.raster.update(self.fluid.particles(), sph_core::Arithmetic::ratio(1, PIXELS));
    }

    /// The picture: a density and a lamp for each pixel within the frame, the first row at the bottom.
    pub fn picture(&self) -> &Raster<{ INSIDE[0] }, { INSIDE[1] }> {
        &self.raster
    }
}
