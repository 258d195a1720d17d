//! Density, interpolation and gradient, in fixed point.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Gridded};
use sph_core::scalar::fixed::{I16F16, Saturating};

fluisim_footprint::firmware!(Gridded<Saturating<I16F16>>, typical::fields);
