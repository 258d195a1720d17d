//! Logs the digests of the fixed scene in fixed point.

#![no_std]
#![no_main]

use fluisim_firmware::{entry, exit, log};

#[entry]
fn main() -> ! {
    exit(fluisim_digest::in_fixed_point(log).is_ok())
}
