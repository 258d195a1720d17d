//! 256 particles of a fluid in f32, in 16 KiB of RAM.

#![no_std]
#![no_main]

use fluisim_firmware::fluid::{self, Fluid};
use fluisim_firmware::{entry, exit};
use sph_core::fluid::OpenBox;

static mut FLUID: Fluid<f32, 256> = Fluid::new(OpenBox::new([15.9, 10.9]));

#[entry]
fn main() -> ! {
    // SAFETY: borrowed once, by the only code that runs.
    let fluid = unsafe { &mut *(&raw mut FLUID) };
    exit(fluid::run(fluid, 16))
}
