#![no_std]
#![forbid(unsafe_code)]

pub mod error;
pub mod scalar;
pub mod vector;

pub use error::{Error, Parameter};
pub use scalar::{Accumulator, Arithmetic, Scalar};
