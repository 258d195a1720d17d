//! A frame of a position-based fluid, in f32.
#![no_std]
#![no_main]

use core::hint::black_box;
use sph_core::fluid::{OpenBox, PositionBasedFluid};

type Fluid = PositionBasedFluid<f32, OpenBox<f32, 2>, 2, 64, 64>;

struct Pendant(Fluid);

impl Pendant {
    const fn new() -> Self {
        Self(Fluid::new(OpenBox::new([7.5, 7.5])))
    }
}

fluisim_footprint::firmware!(Pendant, |pendant: &mut Pendant| pendant.0.step(black_box([0.0, -0.005])));
