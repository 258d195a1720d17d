//! Fluids that move.
//!
//! | | for | walls |
//! |---|---|---|
//! | [`PositionBasedFluid`] | pendants, badges, displays: one step a frame, never unstable, bounded work | a [`Container`] |
//!
//! [`raster`] shows the fluid on a grid of lamps or pixels.

pub mod container;
pub mod pbf;
pub mod raster;

pub use container::{Container, Disc, Mask, OpenBox, Shape, Wall};
pub use pbf::{Particle, PositionBasedFluid, Rejected, Settings};
pub use raster::Raster;
