#![no_std]
#![forbid(unsafe_code)]

pub mod ball;
mod check;
pub mod difference;
pub mod error;
pub mod field;
pub mod influence;
pub mod kernel;
pub mod neighbours;
pub mod quadrature;
pub mod samples;
pub mod scalar;
pub mod vector;

pub use error::{Error, Parameter};
pub use field::Field;
pub use influence::{ClosureInfluence, Influence, InfluenceOf, KernelInfluence, PerSampleInfluence};
pub use neighbours::{
    Axis, BruteForce, CellGrid, CellLayout, Domain, Index, InlineCellGrid, Neighbour, NeighbourList,
    Neighbours,
};
pub use samples::{PerSample, Sources, Uniform};
pub use scalar::{Accumulator, Arithmetic, Scalar};
