//! How much memory there is.

use sysinfo::System;

/// Bytes of memory that are available; `None` where the system does not say.
pub(crate) fn available() -> Option<u64> {
    let mut system = System::new().ok()?;
    system.refresh_memory();
    Some(system.available_memory())
}

/// The bytes that are available where these are fewer than `needed`.
pub(crate) fn short_of(needed: f64) -> Option<f64> {
    available().map(|bytes| bytes as f64).filter(|&available| available < needed)
}
