//! Sums over particles as fast as a workstation goes: sorted particles, vectors, threads.
//!
//! [`SortedCells`] sorts particles for one support radius, [`RadiusOctaves`] for a radius each. They give the densities at the particles, the
//! lists of neighbours, and by [`Fields`] fields at any points. The mathematics is sph-core's: its kernels are evaluated on many
//! numbers at once. What is given up is sph-core's order of summation, so the bits differ from its own, within the rounding of
//! a sum; they do not depend on the number of threads, nor on the [`InstructionSet`].
//!
//! What bounds each job, and how near to that the code comes, is in `docs/speed.md`.

mod blocks;
mod cells;
mod collect;
mod density;
mod evaluate;
mod fields;
mod lists;
mod pairs;
mod part;
mod radius_octaves;
mod shared_neighbourhood;
mod simd;
mod sort;
mod sorted_cells;
mod sums;
mod terms;

pub(crate) use blocks::{Block, Fronts, last_store, reserve, sixteen_mut};
pub(crate) use collect::list_places;
pub(crate) use evaluate::{Evaluate, Evaluator, evaluator};
pub(crate) use simd::{BLOCK, Isa, Job, Register};

pub use fields::{Estimates, Fields};
pub use lists::NeighbourLists;
pub use part::Samples;
pub use radius_octaves::RadiusOctaves;
pub use simd::{InstructionSet, Real};
pub use sorted_cells::SortedCells;
