//! Density, interpolation and gradient in f32 without a grid.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Brute};

fluisim_footprint::firmware!(Brute<f32>, typical::fields_brute);
