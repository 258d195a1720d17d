//! What is asked for, and what that comes to.

use std::path::{Path, PathBuf};

use super::case::CaseName;
use super::error::Error;
use super::method::Method;
use super::parameters::Parameters;
use super::solver::Solver;
use crate::kernel_choice::KernelName;
use crate::scalar_choice::ScalarName;

/// What to simulate. What is `None` is as an earlier run had it where one is resumed, else the case's own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The case; else the first of [`CaseName::ALL`].
    pub case: Option<CaseName>,
    /// The solver; else [`CaseName::solver`].
    pub solver: Option<Solver>,
    /// Dimensions; else the first of [`CaseName::dimensions`].
    pub dim: Option<usize>,
    /// Particles across the case's length, within [`resolutions`].
    pub resolution: Option<u32>,
    /// Seconds to simulate.
    pub time: Option<f64>,
    /// The number type; else f64 for wcsph and f32 for the others.
    pub scalar: Option<ScalarName>,
    /// The kernel; else wendland-c2. pbf has its own, poly6.
    pub kernel: Option<KernelName>,
    /// Seconds from frame to frame; else a fiftieth of the time.
    pub every: Option<f64>,
    /// Threads; else one for each core.
    pub threads: Option<usize>,
}

/// Where results go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// The directory; it is made if it is not there.
    pub directory: PathBuf,
    /// What happens to an earlier run in the directory.
    pub earlier: Earlier,
    /// Whether pictures are drawn: one for each frame, the animation and the plot.
    pub pictures: bool,
}

/// What happens to an earlier run in the directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Earlier {
    /// It is kept, and there is no other: [`Error::Taken`].
    Keep,
    /// It goes on from its last whole frame.
    Resume,
    /// It is removed.
    Replace,
}

/// The least and the most particles across a case's length in so many dimensions: of more there is no room in any memory.
#[must_use]
pub fn resolutions(dim: usize) -> [u32; 2] {
    [8, if dim == 3 { 256 } else { 2000 }]
}

/// Frames unless said otherwise, after the first.
const FRAMES: f64 = 50.0;

/// Frames of a run at most.
const MOST_FRAMES: u32 = 100_000;

impl Options {
    /// A case as it is usually simulated.
    #[must_use]
    pub fn new(case: CaseName) -> Self {
        Self { case: Some(case), ..Self::default() }
    }

    /// These options with those of an earlier run for what is not given.
    pub(super) fn going_on(mut self, stored: &Parameters, directory: &Path) -> Result<Self, Error> {
        let differs = |parameter, stored: String, given: String| {
            Err(Error::OtherRun { directory: directory.to_owned(), parameter, stored, given })
        };
        macro_rules! take {
            ($name:ident, $shown:expr) => {
                match self.$name.replace(stored.$name) {
                    Some(given) if given != stored.$name => {
                        return differs(stringify!($name), $shown(stored.$name), $shown(given));
                    }
                    _ => {}
                }
            };
        }
        take!(case, |case: CaseName| case.to_string());
        take!(solver, |solver: Solver| solver.to_string());
        take!(dim, |dim: usize| dim.to_string());
        take!(resolution, |resolution: u32| resolution.to_string());
        take!(scalar, |scalar: ScalarName| scalar.name());
        take!(kernel, |kernel: KernelName| kernel.name().to_string());
        match self.every.replace(stored.every) {
            // A spacing that follows from the time may differ from its decimal digits by rounding.
            Some(given) if (given / stored.every - 1.0).abs() > 1e-12 => {
                return differs("every", stored.every.to_string(), given.to_string());
            }
            _ => {}
        }
        self.time = self.time.or(Some(stored.time));
        Ok(self)
    }

    /// The parameters, with defaults for what is not given, of options that do not contradict each other.
    pub(super) fn parameters(&self) -> Result<Parameters, Error> {
        let case = self.case.unwrap_or(CaseName::ALL[0]);
        let dim = self.dim.unwrap_or(case.dimensions()[0]);
        let Some(usual) = case.resolution(dim) else {
            return Err(Error::Dimensions { case, found: dim });
        };
        let resolution = self.resolution.unwrap_or(usual);
        let [least, most] = resolutions(dim);
        if !(least..=most).contains(&resolution) {
            return Err(Error::Resolution { found: resolution, least, most });
        }
        let Method { solver, scalar, kernel } =
            Method::choose(case, dim, self.solver, self.scalar, self.kernel)?;
        let time = self.time.unwrap_or_else(|| case.duration());
        let every = self.every.unwrap_or(time / FRAMES);
        if every > time * (1.0 + 1e-12) {
            return Err(Error::TooFewFrames { every, time });
        }
        if time / every > f64::from(MOST_FRAMES) {
            return Err(Error::TooManyFrames { every, time, most: MOST_FRAMES });
        }
        Ok(Parameters { case, solver, dim, resolution, scalar, kernel, every, time })
    }
}
