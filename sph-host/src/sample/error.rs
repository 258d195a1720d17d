//! Why a request cannot be met: data, without the words of a command line.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::request::SamplePoints;
use crate::io::ReadError;
use crate::kernel_choice::KernelName;
use crate::output::GridError;

/// The names of the axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// Why fields cannot be sampled. `file` is the file's name as given, or that of a built-in set.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SampleError {
    /// A file cannot be read, or holds something else than expected.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// There is no built-in set of this name.
    #[error("there is no built-in set `{name}`")]
    UnknownSet {
        /// The name.
        name: String,
    },
    /// A file without a particle.
    #[error("{file}: there are no particles in it")]
    NoParticles {
        /// The particles' file.
        file: String,
    },
    /// Of the particles in a file, none is wanted.
    #[error("{file}: none of {of} particles has {only}")]
    NoneTaken {
        /// The particles' file.
        file: String,
        /// How many there are.
        of: usize,
        /// What was wanted.
        only: String,
    },
    /// A periodic box of other dimensions than the particles.
    #[error("{file}: the particles have {expected} dimensions, the periodic box {given}")]
    PeriodicDimensions {
        /// The particles' file.
        file: String,
        /// Axes of the box.
        given: usize,
        /// Axes that sums run over.
        expected: usize,
    },
    /// A periodic box that is much smaller than the support radius.
    #[error(
        "{file}: in the periodic box, a sum with the support radius {support} would reach {images:.0} images of each particle"
    )]
    PeriodicTooSmall {
        /// The particles' file.
        file: String,
        /// The largest support radius.
        support: f64,
        /// How many images there would be.
        images: f64,
    },
    /// A grid that has fewer layers than there are to be parts.
    #[error("{file}: a grid of {layers} layers along its last axis cannot be cut into {parts} parts")]
    TooManyParts {
        /// The particles' file.
        file: String,
        /// Its layers.
        layers: usize,
        /// The parts.
        parts: usize,
    },
    /// Standard input is to be the particles and the points.
    #[error("standard input cannot be both the particles and the points")]
    StandardInputTwice,
    /// The particles, read in pieces, are to be the points as well.
    #[error("{file}: particles that are read in pieces cannot be the points as well")]
    PiecesAsPoints {
        /// The particles' file.
        file: String,
    },
    /// Neither a mass for all nor a column of masses.
    #[error("{file}: there is no mass")]
    NoMass {
        /// The particles' file.
        file: String,
    },
    /// Neither a support radius for all nor a column of them.
    #[error("{file}: no support radius is given")]
    NoSupport {
        /// The particles' file.
        file: String,
        /// The mean spacing of the particles; none where all are at one point.
        spacing: Option<f64>,
        /// The kernel that was asked for.
        kernel: KernelName,
    },
    /// More dimensions are asked for than there are.
    #[error("{file}: it has {own} coordinates, where {asked} are asked for")]
    TooFewCoordinates {
        /// The file.
        file: String,
        /// Its coordinates.
        own: usize,
        /// The dimensions asked for.
        asked: usize,
    },
    /// Fewer dimensions are asked for than the particles extend in.
    #[error("{file}: {at}{} is {before} and {value}, not the same everywhere", AXES[*.axis])]
    NotFlat {
        /// The file.
        file: String,
        /// Where the first other value is, with a colon and a blank; empty where that is not known.
        at: String,
        /// The axis: 0 is x.
        axis: usize,
        /// The value there.
        value: f64,
        /// The value before.
        before: f64,
        /// The dimensions asked for.
        dim: usize,
    },
    /// The coordinates span more than a number holds.
    #[error("{file}: {} spans from {lower} to {upper}, more than a number can say", AXES[*.axis])]
    Extent {
        /// The particles' file.
        file: String,
        /// The axis: 0 is x.
        axis: usize,
        /// The least coordinate.
        lower: f64,
        /// The greatest.
        upper: f64,
    },
    /// A column has numbers in some pieces of a file, and none in others.
    #[error("{file}: numbers are there of {before} in some rows and of {now} in others")]
    ChangingQuantities {
        /// The particles' file.
        file: String,
        /// The quantities of the first pieces.
        before: String,
        /// Those of a later piece.
        now: String,
    },
    /// Two columns of the result would have the same name.
    #[error("{file}: {first} and {second} both give a column `{name}`")]
    SameName {
        /// The particles' file.
        file: String,
        /// The column's name.
        name: String,
        /// What gives the first of the columns.
        first: String,
        /// What gives the second.
        second: String,
    },
    /// The result would not have the column that a surface is to be taken of.
    #[error("{file}: the result has no column `{name}`, but {known}")]
    NoColumn {
        /// The particles' file.
        file: String,
        /// The column's name.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// Points of other dimensions than the particles.
    #[error("{file}: its points have the coordinates {own}, the particles of {particles} {theirs}")]
    PointCoordinates {
        /// The points' file.
        file: String,
        /// Its coordinates.
        own: String,
        /// The particles' file.
        particles: String,
        /// The coordinates that sums run over.
        theirs: String,
    },
    /// A grid of other dimensions than the particles.
    #[error("{file}: the particles have {dim} dimensions, a grid of {counts:?} cells has {}", .counts.len())]
    GridDimensions {
        /// The particles' file.
        file: String,
        /// Its dimensions.
        dim: usize,
        /// The grid's cells along each axis.
        counts: Vec<usize>,
    },
    /// A grid that cannot be.
    #[error("{file}: {error}")]
    Grid {
        /// The particles' file.
        file: String,
        /// What is wrong with it.
        error: GridError,
        /// Whether its box is that of the particles.
        is_particles_box: bool,
    },
    /// A result that does not fit in memory.
    #[error("the result has {points} points and needs {:.3} GB, but {:.3} GB of memory are free", .needed / 1e9, .available / 1e9)]
    TooLarge {
        /// How many points there would be.
        points: f64,
        /// Where they were asked for.
        at: Box<SamplePoints>,
        /// The particles of a built-in set, where their number was given.
        particles: Option<usize>,
        /// Bytes needed.
        needed: f64,
        /// Bytes free.
        available: f64,
    },
    /// More particles than can be counted.
    #[error("{file}: more than 2³² particles")]
    TooMany {
        /// The particles' file.
        file: String,
    },
    /// A number that is outside the range of the scalar.
    #[error("{file}: {what} {value}, in units of {unit}, does not fit {scalar}")]
    OutOfRange {
        /// The particles' file.
        file: String,
        /// What the number is.
        what: String,
        /// The number.
        value: f64,
        /// The unit that it is taken in.
        unit: f64,
        /// The scalar.
        scalar: String,
    },
    /// A position that is outside the range of the scalar.
    #[error(
        "{file}: particle {particle} at {position:?}, in units of {unit} from {origin:?}, does not fit {scalar}"
    )]
    PositionOutOfRange {
        /// The particles' file.
        file: String,
        /// The particle's number, from 0.
        particle: usize,
        /// Where it is.
        position: Vec<f64>,
        /// The unit of length.
        unit: f64,
        /// The origin.
        origin: Vec<f64>,
        /// The scalar.
        scalar: String,
    },
    /// The box of the particles is outside the range of the scalar.
    #[error("{file}: what the particles span, in units of {unit}, does not fit {scalar}: {error}")]
    BoxOutOfRange {
        /// The particles' file.
        file: String,
        /// The unit of length.
        unit: f64,
        /// The scalar.
        scalar: String,
        /// What the cells of the search say of it.
        error: sph_core::Error,
    },
    /// The sums cannot be.
    #[error("{file}: {error}")]
    Sums {
        /// The particles' file.
        file: String,
        /// What is wrong.
        error: sph_core::Error,
    },
    /// The file is not what it was when it was read for the first time.
    #[error(
        "{file}: changed while it was read, expected the same numbers twice; it is read in pieces, once for its extent and once to sum"
    )]
    Changed {
        /// The file.
        file: String,
    },
    /// The temporary file for particles cannot be used.
    #[error("a temporary file in {}: {error}", .folder.display())]
    Spool {
        /// The folder of temporary files.
        folder: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// The threads cannot be started.
    #[error("cannot start the threads: {0}")]
    Threads(String),
}
