//! Solvers that move particles, over the kernels, searches and fields of the other modules.
//!
//! | | for | walls |
//! |---|---|---|
//! | [`PositionBasedFluid`] | pendants, badges, displays: one step a frame, never unstable, bounded work | a [`Container`] |
//! | [`wcsph`] | computations that stand against experiment | wall particles |
//! | [`incompressible`] | the same with steps ten times as long | wall particles |
//!
//! [`raster`] shows the fluid on a grid of lamps or pixels; [`guide`] says how to choose h, gravity and settings, and what was measured.

pub mod container;
pub mod eos;
#[doc = include_str!("../../docs/fluid.md")]
pub mod guide {}
pub mod incompressible;
#[cfg(feature = "defmt")]
mod logged;
pub mod pbf;
pub mod raster;
pub mod wcsph;

pub use container::{Container, Disc, Mask, OpenBox, Shape, Wall};
pub use eos::EquationOfState;
pub use pbf::{BorrowedFluid, Particle, PositionBasedFluid, Rejected, Settings};
pub use raster::Raster;
