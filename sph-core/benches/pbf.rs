//! A dam break on a display of 32 × 16 lamps, then figures: at rest, shaken for 100,000 frames, and its drift.
//!
//! `cargo bench -p sph-core --features fixed --bench pbf`

#[path = "../tests/pbf/measure.rs"]
#[allow(dead_code, reason = "the tests use the rest")]
mod measure;

use measure::{Noise, at, block, dam_break, drift, extremes, state};
use sph_core::fluid::{OpenBox, PositionBasedFluid, Raster};
use sph_core::scalar::compact::Compact;

const SHAKES: usize = 100_000;

/// Shakes with numbers up to the limits of the type; how many coordinates were found outside or no number.
fn shake<T: Compact>() -> usize {
    let mut fluid = PositionBasedFluid::<T, _, 2, 100, 49, u8>::new(OpenBox::new([T::from_f64(6.5); 2]));
    for k in 0..100 {
        fluid.add(at(0.4 + 0.5 * f64::from(k % 10), 0.4 + 0.5 * f64::from(k / 10))).expect("it is inside");
    }
    let mut noise = Noise(1);
    let mut outside = 0;
    for _ in 0..SHAKES {
        fluid.step(extremes(&mut noise));
        let coordinates = state(fluid.particles()).positions.into_iter().flatten();
        outside += coordinates.filter(|x| !(0.0..=6.5).contains(x)).count();
    }
    outside
}

fn report<T: Compact>() {
    println!("{}:", T::NAME);
    let rest = dam_break::<T>(2500);
    println!(
        "  dam break after 2500 frames: density error {:.2} %, height {:.3}",
        100.0 * rest.density_error,
        rest.height
    );
    println!("    99 % of spacings above {:.3}", rest.first_percentile_of_spacing);
    println!("    speed / sqrt(g H): rms {:.5}, fastest {:.5}", rest.speed, rest.fastest);
    println!("  {SHAKES} frames of shaking: {} coordinates outside", shake::<T>());
    let drifts: Vec<[f64; 2]> = (1..=4).map(|seed| drift::<T>(10_000, seed)).collect();
    println!("  drift of the mean velocity over 10,000 frames, h a frame: {drifts:?}");
}

/// A dam break as a badge shows it.
fn show() {
    let mut fluid = PositionBasedFluid::<f32, _, 2, 384, 153>::new(OpenBox::new([16.0, 8.0]));
    for particle in block([0.0, 0.0], 10, 14) {
        fluid.add(particle).expect("it is inside");
    }
    let mut lamps = Raster::<32, 16>::new();
    for frame in 0..=120 {
        lamps.update(fluid.particles(), 0.5);
        if frame % 40 == 0 {
            println!("frame {frame}");
            for row in lamps.lamps().iter().rev() {
                println!("  |{}|", row.map(|lit| if lit { '#' } else { ' ' }).iter().collect::<String>());
            }
        }
        fluid.step([0.0, -0.005]);
    }
}

fn main() {
    show();
    report::<f32>();
    #[cfg(feature = "fixed")]
    {
        use sph_core::scalar::fixed::{I8F24, I16F16, Saturating};
        report::<Saturating<I16F16>>();
        report::<Saturating<I8F24>>();
    }
}
