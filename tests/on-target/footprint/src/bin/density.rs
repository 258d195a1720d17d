//! Density alone, in f32.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Gridded};

fluisim_footprint::firmware!(Gridded<f32>, typical::density);
