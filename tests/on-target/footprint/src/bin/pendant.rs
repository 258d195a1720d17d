//! A particle and a frame of a position-based fluid, in f32: what `tests/on-target/c/flash.c` does in C.
#![no_std]
#![no_main]

use core::hint::black_box;
use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid};

type Fluid = PositionBasedFluid<f32, OpenBox<f32, 2>, 2, 64, 64>;

struct Pendant(Fluid);

impl Pendant {
    const fn new() -> Self {
        Self(Fluid::new(OpenBox::new([7.5, 7.5])))
    }

    fn run(&mut self) -> bool {
        let added = self.0.add(Particle::new(black_box([0.25, 0.25]), [0.0, 0.0]));
        self.0.step(black_box([0.0, -0.005]));
        added.is_ok()
    }
}

fluisim_footprint::firmware!(Pendant, Pendant::run);
