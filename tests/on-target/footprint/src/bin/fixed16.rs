//! Density, interpolation and gradient in 16-bit fixed point, the kernel by a table.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Gridded};
use sph_core::kernel::{Tabulated, WendlandC2};
use sph_core::scalar::fixed::{I4F12, Wrapping};

type T = Wrapping<I4F12>;
type K = Tabulated<WendlandC2, 33>;

fluisim_footprint::firmware!(Gridded<T>, typical::fields::<T, K>);
