//! Logs the digests of a moving fluid.

#![no_std]
#![no_main]

use fluisim_firmware::{entry, exit, log};

#[entry]
fn main() -> ! {
    exit(fluisim_digest::fluids(log).is_ok())
}
