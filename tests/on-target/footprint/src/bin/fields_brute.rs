//! Density, interpolation and gradient in f32, without a grid.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Brute};
use sph_core::kernel::WendlandC2;

type T = f32;
type K = WendlandC2;

fluisim_footprint::firmware!(Brute<T>, typical::fields_brute::<T, K>);
