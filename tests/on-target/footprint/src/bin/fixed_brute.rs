//! Density, interpolation and gradient in 32-bit fixed point, without a grid.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Brute};
use sph_core::kernel::WendlandC2;
use sph_core::scalar::fixed::{I16F16, Saturating};

type T = Saturating<I16F16>;
type K = WendlandC2;

fluisim_footprint::firmware!(Brute<T>, typical::fields_brute::<T, K>);
