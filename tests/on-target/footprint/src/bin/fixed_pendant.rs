//! A particle and a frame of a position-based fluid, in fixed point: what `tests/on-target/c/flash.c` does in C.
#![no_std]
#![no_main]

use fluisim_footprint::pendant::Pendant;
use sph_core::scalar::fixed::{I16F16, Saturating};

type Number = Saturating<I16F16>;

const SIDE: Number = Number::new(I16F16::lit("7.5"));
const PLACE: Number = Number::new(I16F16::lit("0.25"));
const NOTHING: Number = Number::new(I16F16::ZERO);
const GRAVITY: [Number; 2] = [NOTHING, Number::new(I16F16::lit("-0.005"))];

fluisim_footprint::firmware!(Pendant<Number>, |pendant: &mut Pendant<Number>| {
    pendant.run(SIDE, PLACE, NOTHING, GRAVITY)
});
