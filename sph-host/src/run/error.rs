//! Why there is no run, or no result of it.

use std::io;
use std::path::PathBuf;

use super::case::CaseName;
use super::solver::Solver;
use crate::engine;
use crate::io::ReadError;
use crate::kernel_choice::KernelName;
use crate::output::WriteError;
use crate::picture::PictureError;
use crate::scalar_choice::ScalarName;

/// Why there is no run, or no result of it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The resolution is out of range.
    #[error("a resolution of {found}: expected {least} to {most}")]
    Resolution {
        /// What was asked for.
        found: u32,
        /// The least that is possible.
        least: u32,
        /// The most that is possible.
        most: u32,
    },
    /// The particles do not fit in memory. Nothing has been made or written.
    #[error(
        "a resolution of {resolution} in {dim} dimensions: about {particles:.2e} particles take more than {:.1} GB of memory, \
         and {:.1} GB are available", .needed * 1e-9, .available * 1e-9
    )]
    TooLarge {
        /// What was asked for.
        resolution: u32,
        /// The number of dimensions.
        dim: usize,
        /// About how many particles of fluid and walls there would be.
        particles: f64,
        /// Bytes that they take at least.
        needed: f64,
        /// Bytes that are available.
        available: f64,
    },
    /// The case does not exist in this number of dimensions.
    #[error("{case} in {found} dimensions: it has {}", either(&.case.dimensions()))]
    Dimensions {
        /// The case.
        case: CaseName,
        /// What was asked for.
        found: usize,
    },
    /// Frames are further apart than the whole time.
    #[error("frames every {every} s: longer than the {time} s simulated")]
    TooFewFrames {
        /// Seconds from frame to frame.
        every: f64,
        /// Seconds to simulate.
        time: f64,
    },
    /// More frames than are numbered.
    #[error("frames every {every} s: more than {most} frames in the {time} s simulated")]
    TooManyFrames {
        /// Seconds from frame to frame.
        every: f64,
        /// Seconds to simulate.
        time: f64,
        /// The most frames that are possible.
        most: u32,
    },
    /// The solver cannot simulate the case.
    #[error("{solver} does not simulate {case}: expected {}", either(.case.solvers()))]
    SolverForCase {
        /// What was asked for.
        solver: Solver,
        /// The case.
        case: CaseName,
    },
    /// The solver does not compute in the scalar.
    #[error(
        "{solver} does not compute in {scalar}: expected {}", .solver.scalars()
    )]
    ScalarForSolver {
        /// What was asked for.
        scalar: ScalarName,
        /// The solver.
        solver: Solver,
    },
    /// The solver does not sum with the kernel.
    #[error(
        "{solver} does not sum with {}{}: expected {}",
        .kernel.name(),
        if .kernel.is_singular() { ", which diverges at r = 0" } else { "" },
        either(&.solver.kernels().iter().map(|kernel| kernel.name()).collect::<Vec<_>>())
    )]
    KernelForSolver {
        /// What was asked for.
        kernel: KernelName,
        /// The solver.
        solver: Solver,
    },
    /// The scalar cannot hold the coordinates of the case.
    #[error("{scalar} has no room for a box of {radii} support radii")]
    BoxTooLarge {
        /// The scalar.
        scalar: ScalarName,
        /// The longest side of the box in support radii.
        radii: f64,
    },
    /// Something that is no directory is where the results are to go.
    #[error("{}: is a file, expected a directory", .0.display())]
    NotADirectory(PathBuf),
    /// A file or directory cannot be read, made or removed.
    #[error("{}: {source}", .path.display())]
    File {
        /// Which one.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Another process writes in the directory.
    #[error(
        "{}: another run{} is writing there", .directory.display(),
        .holder.map_or(String::new(), |process| format!(", process {process},"))
    )]
    InUse {
        /// The directory.
        directory: PathBuf,
        /// The other process, where it could be read.
        holder: Option<u32>,
    },
    /// The directory holds a run, and it was not said what to do with it.
    #[error("{}: already holds a run", .0.display())]
    Taken(PathBuf),
    /// The directory holds a run that differs from the one asked for.
    #[error("{}: a run with {parameter} {stored} cannot go on with {parameter} {given}", .directory.display())]
    OtherRun {
        /// The directory.
        directory: PathBuf,
        /// What differs: `case`, `solver`, `dim`, `resolution`, `scalar`, `kernel` or `every`.
        parameter: &'static str,
        /// Its value in the directory.
        stored: String,
        /// Its value as asked for.
        given: String,
    },
    /// The directory holds frames, but no file says of what.
    #[error(
        "{}: holds frames, but neither run.json nor checkpoint.json can be read, so it is not known of what",
        .0.display()
    )]
    UnknownRun(PathBuf),
    /// The threads cannot be started.
    #[error("cannot start {}: {reason}", .threads.map_or("the threads".into(), |n| format!("{n} threads")))]
    Threads {
        /// How many were asked for; `None` for one for each core.
        threads: Option<usize>,
        /// What the system said.
        reason: String,
    },
    /// The solver refuses what the case begins with, or what a frame holds.
    #[error("the case cannot begin: {0}")]
    Begin(sph_core::Error),
    /// The solver gave up.
    #[error("the run failed after {time} s: {error}")]
    Solver {
        /// The simulated time up to which all was well, s.
        time: f64,
        /// What the solver said.
        error: sph_core::Error,
    },
    /// A particle is faster than the equation of state allows.
    #[error(
        "the run failed after {time} s: a particle moves at {speed} m/s, more than twice the speed of sound, {sound} m/s"
    )]
    TooFast {
        /// The simulated time up to which all was well, s.
        time: f64,
        /// The speed of the particle, m/s.
        speed: f64,
        /// The speed of sound, m/s.
        sound: f64,
    },
    /// Something measured is not finite.
    #[error("the run failed at {time} s: {column} is not finite")]
    NotFinite {
        /// The simulated time, s.
        time: f64,
        /// The column of the series.
        column: String,
    },
    /// A file of the directory cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A result cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A picture cannot be drawn.
    #[error("the picture cannot be drawn: {0}")]
    Picture(#[from] PictureError),
}

impl Error {
    /// What a solver said at a time.
    pub(super) fn of_solver(time: f64, error: engine::RunError) -> Self {
        match error {
            engine::RunError::Core(error) => Self::Solver { time, error },
            engine::RunError::TooFast { speed, sound } => Self::TooFast { time, speed, sound },
        }
    }
}

/// Items as a list in words: `a, b or c`.
pub(crate) fn either(items: &[impl ToString]) -> String {
    let items: Vec<String> = items.iter().map(ToString::to_string).collect();
    match items.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        Some((last, _)) => last.clone(),
        None => String::from("nothing"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_reads_as_a_sentence() {
        assert_eq!(either(&[2]), "2");
        assert_eq!(either(&["f64", "f32"]), "f64 or f32");
        assert_eq!(either(&[1, 2, 3]), "1, 2 or 3");
    }
}
