//! Logs the digests of the fixed scene in i16f16.

#![no_std]
#![no_main]

use fluisim_firmware::{entry, exit, log};
use sph_core::scalar::fixed::{I16F16, Saturating};

#[entry]
fn main() -> ! {
    exit(fluisim_digest::items::<Saturating<I16F16>>(log).is_ok())
}
