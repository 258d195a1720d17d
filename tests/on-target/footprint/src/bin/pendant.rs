//! A particle and a frame of a position-based fluid, in f32: what `tests/on-target/c/flash.c` does in C.
#![no_std]
#![no_main]

use fluisim_footprint::pendant::Pendant;

fluisim_footprint::firmware!(Pendant<f32>, |pendant: &mut Pendant<f32>| {
    pendant.run(7.5, 0.25, 0.0, [0.0, -0.005])
});
