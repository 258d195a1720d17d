//! Density, interpolation and gradient in f32, with a kernel that needs no root.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Gridded};
use sph_core::kernel::Poly6;

type T = f32;
type K = Poly6;

fluisim_footprint::firmware!(Gridded<T>, typical::fields::<T, K>);
