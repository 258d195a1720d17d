//! What can be asked for.

use std::path::PathBuf;

use crate::estimate_choice::Estimate;
use crate::kernel_choice::KernelName;
use crate::scalar_choice::ScalarName;

/// Where the particles come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParticleSource {
    /// A file.
    File(PathBuf),
    /// A built-in set by name, and about how many particles it is to have.
    Demo(String, Option<usize>),
}

/// Where the fields are wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum SamplePoints {
    /// At the points of a file.
    At(PathBuf),
    /// At the cell centres of a grid; the box is that of the particles where no bounds (lower, then upper corner) are given.
    Grid {
        /// Cells along each axis.
        counts: Vec<usize>,
        /// The lower corner's coordinates, then the upper one's.
        bounds: Option<Vec<f64>>,
    },
    /// At the particles.
    AtParticles,
}

/// Where the support radii come from.
#[derive(Clone, Debug, PartialEq)]
pub enum SupportFrom {
    /// h for all.
    Radius(f64),
    /// The smoothing length for all: the support radius divided by the kernel's support ratio.
    SmoothingLength(f64),
    /// A column with h of each particle.
    RadiusColumn(String),
    /// A column with the smoothing length of each particle.
    SmoothingLengthColumn(String),
}

/// Everything that can be asked for at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The particles.
    pub particles: ParticleSource,
    /// The points.
    pub at: SamplePoints,
    /// The kernel.
    pub kernel: KernelName,
    /// 1 to 3, where the particles' own number of coordinates is not meant: axes along which all are equal are dropped.
    pub dim: Option<usize>,
    /// The fields by name; none: every numeric array that is not special.
    pub quantities: Vec<String>,
    /// Whether gradients are wanted too.
    pub gradient: bool,
    /// The column of the result that a surface will be taken of; a result without it is refused before the sums.
    pub surface: Option<String>,
    /// Support radii; none: the set's own, or an error.
    pub support: Option<SupportFrom>,
    /// The estimate.
    pub estimate: Estimate,
    /// The mass of every particle, over a column.
    pub mass: Option<f64>,
    /// Whether ρ is summed by Thm 3.2 although there is a density column.
    pub recompute_density: bool,
    /// The number type.
    pub scalar: ScalarName,
    /// Threads; none: one for each core.
    pub threads: Option<usize>,
    /// How many particles are read at a time, so that a file may be larger than memory; none: all.
    pub chunk: Option<usize>,
    /// Whether sums go in sph-core's documented order, so that the bits are those of firmware.
    pub exact: bool,
}
