//! What makes a run go: the state before the first step, neighbour lists, sums over them, and steps in time.
//!
//! [`Setup`] is a fluid before its first step. [`Simulate`] is a solver whose scalar is not known: [`Simulation`] is weakly
//! compressible SPH, [`Incompressible`] incompressible SPH over the same lists, [`PositionBased`] the fluid of microcontrollers. A [`Snapshot`] is the fluid at one time, in f64.
//!
//! Weakly compressible SPH runs in this order, twice a step: [`verlet_lists`] keeps candidates for several steps,
//! [`neighbourhoods`] finds which of them are within the support radius now, [`records`] holds what the sums read of each
//! particle, and [`summation`] adds sph-core's terms, several pairs at a time. An incompressible fluid sums over the same neighbours
//! some twenty times a step, so `incompressible/contacts` keeps them, with V W and V ∇W, for the step.

mod incompressible;
mod neighbourhoods;
mod pbf;
mod records;
mod setup;
mod simulation;
mod summation;
mod tank;
mod verlet_lists;

pub(crate) use incompressible::Incompressible;
pub(crate) use pbf::PositionBased;
pub(crate) use setup::{Setup, StateEquation, cells, centre, jittered, walls};
pub use tank::Tank;

pub(crate) use simulation::{RunError, Simulate, Simulation, Snapshot, Tally, layout};
