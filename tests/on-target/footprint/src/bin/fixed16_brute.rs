//! Density, interpolation and gradient in 16-bit fixed point, the kernel by a table, without a grid.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Brute};
use sph_core::kernel::{Tabulated, WendlandC2};
use sph_core::scalar::fixed::{I4F12, Saturating};

type T = Saturating<I4F12>;
type K = Tabulated<WendlandC2, 33>;

fluisim_footprint::firmware!(Brute<T>, typical::fields_brute::<T, K>);
