//! The whole public API, on inputs that the compiler knows nothing of.
#![no_std]
#![no_main]

mod exercise;
mod fluids;

use exercise::Inputs;

fluisim_footprint::firmware!(Inputs, |inputs: &mut Inputs| inputs.run());
