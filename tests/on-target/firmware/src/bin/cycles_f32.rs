//! Pendants in f32, whose frames the plugin counts: few of them, since a Cortex-M0 takes millions of instructions for each.

#![no_std]
#![no_main]

use fluisim_firmware::{cycles, entry, exit};

#[entry]
fn main() -> ! {
    exit(cycles::pendants::<f32>("f32", 12))
}
