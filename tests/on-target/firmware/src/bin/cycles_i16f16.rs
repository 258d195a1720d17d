//! Pendants in fixed point, whose frames the plugin counts.

#![no_std]
#![no_main]

use fluisim_firmware::{cycles, entry, exit};
use sph_core::scalar::fixed::{I16F16, Saturating, Wrapping};

#[entry]
fn main() -> ! {
    exit(
        cycles::pendants::<Saturating<I16F16>>("saturating i16f16", 60)
            && cycles::pendants::<Wrapping<I16F16>>("wrapping i16f16", 60),
    )
}
