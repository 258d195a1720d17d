//! Density, interpolation and gradient in fixed point, without a grid.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Brute};
use sph_core::scalar::fixed::{I16F16, Saturating};

fluisim_footprint::firmware!(Brute<Saturating<I16F16>>, typical::fields_brute);
