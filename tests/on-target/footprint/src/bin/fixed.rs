//! Density, interpolation and gradient in 32-bit fixed point.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Gridded};
use sph_core::kernel::WendlandC2;
use sph_core::scalar::fixed::{I16F16, Saturating};

type T = Saturating<I16F16>;
type K = WendlandC2;

fluisim_footprint::firmware!(Gridded<T>, typical::fields::<T, K>);
