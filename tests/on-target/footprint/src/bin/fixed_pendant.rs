//! A particle and a frame of a position-based fluid, in fixed point: what `tests/on-target/c/flash.c` does in C.
#![no_std]
#![no_main]

use core::hint::black_box;
use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid};
use sph_core::scalar::fixed::{I16F16, Saturating};

type Number = Saturating<I16F16>;
type Fluid = PositionBasedFluid<Number, OpenBox<Number, 2>, 2, 64, 64>;

const SIDE: Number = Number::new(I16F16::lit("7.5"));
const PLACE: Number = Number::new(I16F16::lit("0.25"));
const GRAVITY: [Number; 2] = [Number::new(I16F16::ZERO), Number::new(I16F16::lit("-0.005"))];

struct Pendant(Fluid);

impl Pendant {
    const fn new() -> Self {
        Self(Fluid::new(OpenBox::new([SIDE, SIDE])))
    }

    fn run(&mut self) -> bool {
        let added = self.0.add(Particle::new(black_box([PLACE, PLACE]), [GRAVITY[0]; 2]));
        self.0.step(black_box(GRAVITY));
        added.is_ok()
    }
}

fluisim_footprint::firmware!(Pendant, Pendant::run);
