//! A pendant: fluid on 16 × 16 lamps that runs to the side that is down.
//!
//! `cargo run -p sph-core --example pendant`

use sph_core::Error;
use sph_core::fluid::{Disc, Particle, PositionBasedFluid, Raster};

/// A round pendant of 8 h, 96 particles, nothing on the heap.
type Fluid = PositionBasedFluid<f32, Disc<f32>, 2, 96, 81, u8>;

fn show(title: &str, lamps: &Raster<16, 16>) {
    println!("{title}");
    for row in lamps.lamps().iter().rev() {
        println!("  {}", row.map(|lit| if lit { "##" } else { ". " }).concat());
    }
}

pub(crate) fn main() -> Result<(), Error> {
    let mut fluid = Fluid::new(Disc::new(4.0));
    for k in 0..96 {
        let place = [1.5 + 0.45 * (k % 12) as f32, 2.5 + 0.45 * (k / 12) as f32];
        fluid.add(Particle::new(place, [0.0; 2])).map_err(|rejected| rejected.reason)?;
    }
    let mut lamps = Raster::<16, 16>::new();
    // what the accelerometer says, scaled such that 1 g is 0.005
    for (title, acceleration) in [("upright", [0.0, -0.005]), ("on its right side", [0.005, 0.0])] {
        for _ in 0..600 {
            fluid.step(acceleration);
        }
        lamps.update(fluid.particles(), 0.5);
        show(title, &lamps);
        let mean: [f32; 2] =
            [0, 1].map(|axis| fluid.particles().iter().map(|p| p.position()[axis]).sum::<f32>() / 96.0);
        let down = if acceleration[0] > 0.0 { 8.0 - mean[0] } else { mean[1] };
        assert!(down < 3.0, "{title}: {mean:?}");
    }
    assert!(lamps.is_lit(14, 8) && !lamps.is_lit(1, 8));
    Ok(())
}
