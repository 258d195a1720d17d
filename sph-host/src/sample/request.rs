//! What can be asked for.

use super::only::Only;
use crate::estimate_choice::Estimate;
use crate::io::InputFile;
use crate::kernel_choice::KernelName;
use crate::part::Part;
use crate::scalar_choice::ScalarName;

/// Where the particles come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParticleSource {
    /// A file.
    File(InputFile),
    /// A built-in set by name, and about how many particles it is to have.
    Demo(String, Option<usize>),
}

/// Where the fields are wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum SamplePoints {
    /// At the points of a file.
    At(InputFile),
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

/// A share of the points: layers of a grid along its last axis, or points on end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PartOfPoints {
    /// Which.
    pub part: Part,
    /// Whether a part of a grid has the first layer of the next part too, as image data has in which no gap is to be.
    pub shares_layers: bool,
}

/// Where the support radii come from.
#[derive(Clone, Debug, PartialEq)]
pub enum SupportFrom {
    /// h for all.
    Radius(f64),
    /// The smoothing length for all: the support radius divided by the kernel's support ratio.
    SmoothingLength(f64),
    /// A column that gives h of each particle when it is multiplied with the factor.
    RadiusColumn(String, f64),
    /// A column that gives the smoothing length of each particle when it is multiplied with the factor.
    SmoothingLengthColumn(String, f64),
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
    /// Particles are taken where all of these hold.
    pub only: Vec<Only>,
    /// The lower corner of a periodic box, then the upper one, over the axes that sums run over or all of the file. An axis with
    /// equal ends is open.
    pub periodic: Option<Vec<f64>>,
    /// The estimate.
    pub estimate: Estimate,
    /// The mass of every particle, over a column.
    pub mass: Option<f64>,
    /// Whether ρ is summed by Thm 3.2 although there is a density column.
    pub recompute_density: bool,
    /// The number type.
    pub scalar: ScalarName,
    /// Which part of the points is evaluated, where others evaluate the others; none: all.
    pub part: Option<PartOfPoints>,
    /// Threads; none: one for each core.
    pub threads: Option<usize>,
    /// How many particles are read at a time, so that a file may be larger than memory; none: all.
    pub chunk: Option<usize>,
    /// Whether sums go in sph-core's documented order, so that the bits are those of firmware.
    pub exact: bool,
}
