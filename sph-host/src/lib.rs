//! sph-core on a workstation: allocation, threads, particle files, pictures, and the command `fluisim`.
//!
//! Everything the command does is a library call: [`sample::run`] evaluates the fields of a [`sample::Request`],
//! [`io::read`] reads particle files, [`output::write`] writes results, [`picture`] draws.

pub mod cli;
pub mod demo;
mod engine;
pub mod estimate_choice;
pub mod fast;
pub mod io;
pub mod kernel_choice;
mod named_enum;
pub mod output;
mod parallel;
pub mod picture;
pub mod progress;
pub mod run;
pub mod sample;
pub mod scalar_choice;

#[doc(hidden)]
pub use engine::Tank;
