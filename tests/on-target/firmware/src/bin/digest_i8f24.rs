//! Logs the digests of the fixed scene in i8f24.

#![no_std]
#![no_main]

use fluisim_firmware::{entry, exit, log};
use sph_core::scalar::fixed::{I8F24, Saturating};

#[entry]
fn main() -> ! {
    exit(fluisim_digest::items::<Saturating<I8F24>>(log).is_ok())
}
