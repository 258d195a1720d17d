//! Pendants in f32, whose frames the plugin counts.

#![no_std]
#![no_main]

use fluisim_firmware::{cycles, entry, exit};

#[entry]
fn main() -> ! {
    exit(cycles::pendants::<f32>("f32"))
}
