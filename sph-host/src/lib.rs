//! sph-core on a workstation: memory, threads, particle files, pictures, and the command `fluisim`.
//!
//! The modules, from input files to output files:
//!
//! 1. [`io`]: particle files, read and checked into tables.
//! 2. [`fast`]: particles sorted, and densities, neighbour lists and fields from them, in registers and threads.
//! 3. [`sample`]: one request for fields, from a file to a table. It takes the fast path, or sph-core's own order of summation.
//! 4. [`run`]: fluids that move, in cases that are measured against experiment and exact solutions.
//! 5. [`study`]: what a number type costs on one's own particles, and the one to take.
//! 6. [`output`], [`picture`] and [`surface`]: tables as files, as images and plots, and as triangles where a field has a value.
//! 7. [`cli`]: the words of the command. Nothing else here knows them: everything that `fluisim` does is a call of this library.
//!
//! Kernels, number types and estimates are chosen when the program runs by [`kernel_choice`], [`scalar_choice`] and [`estimate_choice`].
//! Long work tells a [`progress::Progress`] how far it has come.
//!
//! # What can be relied on
//!
//! * **Bits.** The same input and options give the same bytes, whatever the number of threads and the processor. With
//!   [`exact`](sample::Request::exact) they are the same as on a microcontroller; see [`sample`].
//! * **Errors** are typed and name file, line, value and what was expected; nothing is half-written.
//!
//! What lives where, and where a new kernel, format, case, reader, writer or field operator goes: `docs/architecture.md`.

pub mod cli;
pub mod demo;
mod engine;
pub mod estimate_choice;
pub mod fast;
pub mod io;
pub mod kernel_choice;
mod memory;
mod named_enum;
pub mod output;
mod parallel;
pub mod part;
pub mod picture;
pub mod progress;
pub mod run;
pub mod sample;
pub mod scalar_choice;
pub mod study;
pub mod surface;

#[doc(hidden)]
pub use engine::Tank;
