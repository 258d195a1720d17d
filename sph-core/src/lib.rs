//! Smoothed Particle Hydrodynamics without std, allocation, `unsafe` or panics.
//!
//! A field known at scattered samples becomes a function that can be asked for its value and gradient anywhere. The tour,
//! in the order of the mathematics (*FLUISIM: Smoothed Particle Hydrodynamics*, R. E. Fry, 2025):
//!
//! 1. [`kernel`]: what a smoothing kernel is, as a shape f(q) on [0, 1], and [those there are](kernel::LIST) (Defs. 1.1, 1.2, Ex. 1.3).
//! 2. [`ball`]: the N-ball, whose shells normalise a kernel in N dimensions (Def. 2.1).
//! 3. [`influence`]: Ω and ∇Ω for a support radius h (Defs. 2.2, 2.3, Thm 2.4), with the paper's erratum.
//! 4. [`neighbours`]: which samples a sum has to look at, by brute force or in cells, in open or periodic space.
//! 5. [`samples`] and [`field`]: density, interpolation, gradients and what follows from them (Def. 3.1, Thms 3.2, 3.3).
//! 6. [`difference`]: the n-th central difference of any function (Thm 4.1).
//! 7. [`fluid`]: solvers that move particles, their containers, and how to show them.
//!
//! Data flows one way: samples, neighbours, influence, field, step. Every number type of [`scalar`] goes through the same source.
//!
//! # What can be relied on
//!
//! * **Bits.** Sums have one documented order, roots are correctly rounded, and no multiplication is fused with an addition, so
//!   a microcontroller without floating-point unit gives the bits of a workstation.
//! * **Bounds.** Storage is the caller's slices or inline arrays of const size; what does not fit is an [`Error`] that says how
//!   much was needed.
//! * **No panics.** Constructors check their arguments and say what is wrong; what they hand out cannot fail.
//!
//! # Units
//!
//! Lengths may be in any unit L, masses in any unit M. Types of a small range want lengths near h and densities near 1.
//!
//! # Pages
//!
//! On real microcontrollers: [`hardware`], from a `static` to the probe. How fast the sums converge, measured: [`convergence`]. How
//! to use the fluid for pendants: [`fluid::guide`]; from the parts to one that runs: [`pendant`].
//!
//! # Features
//!
//! `fixed`: fixed-point scalars. `micromath`: `Fast32`. `defmt`: `defmt::Format` for the public types. `embedded-graphics`: drawing a
//! fluid's raster. All are additive.

#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]

pub mod ball;
mod check;
pub mod difference;
pub mod error;
pub mod field;
pub mod fluid;
#[doc = include_str!("../docs/convergence.md")]
pub mod convergence {}
#[doc = include_str!("../docs/hardware.md")]
pub mod hardware {}
pub mod influence;
pub mod kernel;
pub mod lane;
pub mod neighbours;
#[doc = include_str!("../docs/pendant.md")]
pub mod pendant {}
pub mod quadrature;
pub mod samples;
pub mod scalar;
pub mod vector;

pub use error::{Error, Parameter};
pub use field::Field;
pub use influence::{ClosureInfluence, Influence, InfluenceOf, KernelInfluence, PerSampleInfluence};
pub use lane::Lane;
pub use neighbours::{
    Axis, BruteForce, CellGrid, CellLayout, CellOrder, Domain, Index, InlineCellGrid, Neighbour,
    NeighbourList, Neighbours, Open, Space,
};
pub use samples::{PerSample, Sources, Uniform};
pub use scalar::{Accumulator, Arithmetic, Scalar};
