//! Why there is no study, or no recommendation.

use thiserror::Error;

use super::request::Quantity;
use crate::kernel_choice::KernelName;
use crate::run::CaseName;
use crate::sample::SampleError;

/// Why a study cannot be made. `file` is the file's name as given, or that of a built-in set.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The particles cannot be read, or are not what they should be.
    #[error(transparent)]
    Particles(#[from] SampleError),
    /// A density for which there is no volume m / ρ.
    #[error(
        "{file}: particle {particle} has the density {density}: expected one whose volume m/ρ a number holds"
    )]
    Density {
        /// The particles' file.
        file: String,
        /// Its number, from 0.
        particle: usize,
        /// Its density.
        density: f64,
    },
    /// sph-core refuses the particles.
    #[error("{file}: {error}")]
    Sums {
        /// The particles' file.
        file: String,
        /// What it says.
        error: sph_core::Error,
    },
    /// A quantity that is zero at every particle, so that no error is relative to it.
    #[error("{file}: the {quantity} is zero at every particle ({why}): no error is relative to it")]
    NothingToCompare {
        /// The particles' file.
        file: String,
        /// The quantity.
        quantity: Quantity,
        /// What the particles are.
        why: &'static str,
    },
    /// A kernel that diverges at r = 0.
    #[error("the kernel {kernel} diverges at r = 0: it has no density and no interpolation")]
    SingularKernel {
        /// The kernel.
        kernel: KernelName,
    },
    /// No format of the bits that were allowed holds the particles.
    #[error("{file}: no format of {least} to {most} bits holds these particles: {why}")]
    NoFormat {
        /// The particles' file.
        file: String,
        /// The fewest bits allowed.
        least: u32,
        /// The most.
        most: u32,
        /// What does not fit.
        why: String,
    },
    /// A case that no position-based fluid plays.
    #[error("{case}: it is no position-based fluid")]
    NoFluid {
        /// The case.
        case: CaseName,
    },
    /// A fluid that differs so much from start to start that nothing can be told of a format.
    #[error(
        "{case}: its height scatters by {scatter:.3} of itself from start to start in f64, more than {most}: nothing can be told of a format"
    )]
    Chaotic {
        /// The case.
        case: CaseName,
        /// The standard deviation over the mean.
        scatter: f64,
        /// The most that was allowed.
        most: f64,
    },
    /// A fluid that a format cannot hold.
    #[error("{case}: {error}")]
    Fluid {
        /// The case.
        case: CaseName,
        /// What sph-core says.
        error: sph_core::Error,
    },
    /// Threads cannot be started.
    #[error("cannot start threads: {0}")]
    Threads(String),
}
