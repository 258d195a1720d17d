//! One function for each surface that is given bytes of anybody. Each makes of the bytes what it needs, and panics where a promise
//! is broken.
//!
//! `cargo test` tries all of `corpus/` again; `./search TARGET SECONDS` looks for more with libFuzzer.

mod c;
mod core;
mod fluid;
mod numbers;

pub use c::c;
pub use core::core;
pub use fluid::fluid;

/// A function that is given the bytes.
pub type Target = fn(&[u8]);

/// All of them, by the names of their folders in `corpus/`.
pub const TARGETS: [(&str, Target); 3] = [("core", core), ("fluid", fluid), ("c", c)];
