//! 400 particles of a fluid in i16f16, in 16 KiB of RAM.

#![no_std]
#![no_main]

use fluisim_firmware::fluid::{self, Fluid};
use fluisim_firmware::{entry, exit};
use sph_core::fluid::OpenBox;
use sph_core::scalar::fixed::{I16F16, Saturating};

const SIZE: [Saturating<I16F16>; 2] =
    [Saturating::new(I16F16::lit("15.9")), Saturating::new(I16F16::lit("10.9"))];
static mut FLUID: Fluid<Saturating<I16F16>, 400> = Fluid::new(OpenBox::new(SIZE));

#[entry]
fn main() -> ! {
    // SAFETY: borrowed once, by the only code that runs.
    let fluid = unsafe { &mut *(&raw mut FLUID) };
    exit(fluid::run(fluid, 20))
}
