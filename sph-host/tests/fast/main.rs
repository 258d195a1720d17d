//! The fast path against sph-core's exact sums.

mod cloud;
mod densities;
mod fields;
mod lists;
