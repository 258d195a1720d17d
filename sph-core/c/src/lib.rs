//! `fluisim.h` in Rust: the position-based fluid in memory of the caller, pixels and lamps, and fields over arrays of the caller.
//!
//! The header says what each function does, in which units, and which codes it returns. Here is how:
//!
//! * [`fluid`]: what lies in the caller's memory, and what is done with it, once for every number type and dimension.
//! * [`pixels`]: the raster of `sph-core`, in arrays of the caller.
//! * [`fields`]: density, value and gradient at a point, over the sums in `sums.rs`.
//! * [`export`]: the macro that makes the exported functions and the list of their types, which a test holds against the header.
//!
//! Pointers of a caller cannot be had without `unsafe`: [`mod@pointer`] turns them into references, and says what is checked and what
//! the caller has to promise. Everything else is sph-core, which has no `unsafe`, no allocation and no panic.

#![no_std]
#![deny(unsafe_op_in_unsafe_fn, clippy::undocumented_unsafe_blocks)]

#[cfg(test)]
extern crate std;

mod change;
pub mod code;
pub mod export;
pub mod fields;
pub mod fluid;
pub mod pixels;
pub mod pointer;
mod sums;
#[cfg(all(feature = "archive", target_arch = "arm"))]
mod zeros;

/// 16.16 fixed point that stays at the ends of its range: `fluisim_q16` in C, where it is an `int32_t`.
pub type Q16 = sph_core::scalar::fixed::Saturating<sph_core::scalar::fixed::I16F16>;

/// No function can reach it: the build of the archives fails where one could. Archives abort; what links std, as tests do, unwinds and
/// has a handler.
#[cfg(all(feature = "archive", panic = "abort"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        core::hint::spin_loop();
    }
}
