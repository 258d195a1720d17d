//! Density alone, in f32.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Gridded};
use sph_core::kernel::WendlandC2;

type T = f32;
type K = WendlandC2;

fluisim_footprint::firmware!(Gridded<T>, typical::density::<T, K>);
