//! A pendant on a screen: fluid behind round lamps that runs to the side that is down, as an animated GIF.
//!
//! `cargo run --release -p sph-host --example pendant_gif` writes `pendant.gif`; a path after `--` is written instead.

use std::fs::File;
use std::io::BufWriter;
use std::time::Duration;

use sph_core::fluid::{Disc, Particle, PositionBasedFluid, Raster};
use sph_host::picture::{Image, animation::Animation};

/// Lamps across.
const LAMPS: usize = 22;
/// Pixels from lamp to lamp.
const PITCH: usize = 11;
/// The pendant's diameter in support radii.
const DIAMETER: f32 = 9.0;
/// Frames of the animation, of 20 a second.
const FRAMES: usize = 100;
/// Steps of the fluid, of 60 a second, from one frame to the next.
const STEPS: usize = 3;

/// The firmware's own type: at most 160 particles, 5 kB, known when the program is compiled.
type Pendant = PositionBasedFluid<f32, Disc<f32>, 2, 160, 100, u8>;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "pendant.gif".into());
    let mut fluid = Pendant::new(Disc::new(DIAMETER / 2.0));
    for k in 0..120 {
        let place = [1.9 + 0.48 * (k % 12) as f32, 2.0 + 0.48 * (k / 12) as f32];
        fluid.add(Particle::new(place, [0.0; 2])).map_err(|rejected| rejected.reason)?;
    }
    let mut lamps = Raster::<LAMPS, LAMPS>::new();
    let side = (LAMPS * PITCH) as u32;
    let file = BufWriter::new(File::create(&path)?);
    let mut animation = Animation::begin(file, side, side, Duration::from_millis(50))?;
    for frame in 0..FRAMES {
        // the pendant swings: what an accelerometer in it says, 1 g being 0.005
        let angle = 1.9 * (frame as f32 / FRAMES as f32 * std::f32::consts::TAU).sin();
        for _ in 0..STEPS {
            fluid.step([0.005 * angle.sin(), -0.005 * angle.cos()]);
        }
        lamps.update(fluid.particles(), DIAMETER / LAMPS as f32);
        animation.push(&picture(&lamps))?;
    }
    animation.finish()?;
    println!("{path}");
    Ok(())
}

/// The lamps within the round pendant, lit or dark, the lowest row last.
fn picture(lamps: &Raster<LAMPS, LAMPS>) -> Image {
    const BACKGROUND: [u8; 3] = [18, 18, 24];
    const DARK: [u8; 3] = [38, 40, 52];
    const LIT: [u8; 3] = [64, 190, 255];
    let side = LAMPS * PITCH;
    let mut rgb = Vec::with_capacity(3 * side * side);
    for y in (0..side).rev() {
        for x in 0..side {
            let (column, row) = (x / PITCH, y / PITCH);
            let middle = LAMPS as f32 / 2.0;
            let from_middle = (column as f32 + 0.5 - middle).hypot(row as f32 + 0.5 - middle);
            let radius = PITCH as f32 / 2.0;
            let within = ((x % PITCH) as f32 + 0.5 - radius).hypot((y % PITCH) as f32 + 0.5 - radius);
            rgb.extend(match lamps.is_lit(column, row) {
                _ if within > 0.84 * radius || from_middle > middle - 0.2 => BACKGROUND,
                true => LIT,
                false => DARK,
            });
        }
    }
    Image { width: side as u32, height: side as u32, rgb }
}
