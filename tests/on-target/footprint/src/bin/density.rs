//! Density alone, in f32.
#![no_std]
#![no_main]

use fluisim_footprint::typical::{self, Storage};

fluisim_footprint::firmware!(Storage<f32>, typical::density);
