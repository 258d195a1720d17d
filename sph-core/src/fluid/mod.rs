//! Fluids that move: what a solver adds to kernels, searches and fields.

pub mod eos;
pub mod wcsph;

pub use eos::EquationOfState;
