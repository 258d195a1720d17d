//! Logs the digests of the fixed scene in f64.

#![no_std]
#![no_main]

use fluisim_firmware::{entry, exit, log};

#[entry]
fn main() -> ! {
    exit(fluisim_digest::items::<f64>(log).is_ok())
}
