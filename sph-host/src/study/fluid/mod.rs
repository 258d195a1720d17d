//! What a number type does to a position-based fluid: not its bits, which chaos parts within a second, but its height and speed.
//!
//! A fluid is begun several times from slightly different places. What differs between these starts in f64 is the scatter that any
//! arithmetic has; a format is as good as f64 where its mean over the starts is within [`LIMIT`] of that scatter.

mod report;

use sph_core::scalar::compact::Compact;
use sph_core::vector::norm_squared;
use sph_lab::{Choice, Chosen, Emulated, Format, Rounding};

use super::error::StudyError;
use crate::engine::{PositionBased, Setup, Simulate, jittered};
use crate::parallel;
use crate::progress::Progress;
use crate::run::{self, CaseName};

/// Standard deviations of f64's scatter that a mean may be off.
pub const LIMIT: f64 = 2.0;
/// Particles across the case's length: some 288 in all.
const RESOLUTION: u32 = 27;
/// Frames at the end over which a run is measured.
const MEASURED: u32 = 60;
/// How far starts differ, in spacings.
const APART: f64 = 0.02;
/// Integer bits of the formats that are used throughout: enough for places and sums.
const INTEGER: u32 = 8;

/// What can be asked of a study of a fluid.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidRequest {
    /// The case.
    pub case: CaseName,
    /// Frames of the solver to simulate.
    pub frames: u32,
    /// How often the fluid is begun.
    pub starts: u32,
    /// Fraction bits to try, many first.
    pub fractions: Vec<u32>,
    /// Roundings to try.
    pub roundings: Vec<Rounding>,
    /// The scatter of f64 beyond which nothing can be told, relative to the mean height.
    pub most_scatter: f64,
    /// Threads; none: one for each core.
    pub threads: Option<usize>,
}

impl FluidRequest {
    /// A study of this case with everything else as it is where nothing is asked for.
    #[must_use]
    pub fn new(case: CaseName) -> Self {
        Self {
            case,
            frames: 600,
            starts: 8,
            fractions: vec![14, 12, 11, 10, 8],
            roundings: vec![Rounding::Nearest, Rounding::Floor],
            most_scatter: 0.05,
            threads: None,
        }
    }
}

/// The mean over starts, and its standard deviation from start to start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// The mean.
    pub mean: f64,
    /// The standard deviation.
    pub deviation: f64,
}

/// How numbers of a format are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Usage {
    /// Every number of the solver is one of the format.
    Throughout,
    /// As in a firmware: the solver's places are counts of 2⁻¹⁴, and the format is that of what goes in and comes out.
    Compiled,
}

/// One format.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidRow {
    /// The format; none for f64.
    pub format: Option<Format>,
    /// How it is used.
    pub usage: Usage,
    /// Twice the mean height of the particles, in metres.
    pub height: Spread,
    /// The root of the mean square speed, in m/s.
    pub speed: Spread,
    /// How far height and speed are from f64's, in standard deviations of its scatter.
    pub off: [f64; 2],
}

impl FluidRow {
    /// Whether it is as good as f64.
    #[must_use]
    pub fn is_accepted(&self) -> bool {
        self.off.iter().all(|off| *off <= LIMIT)
    }
}

/// What was found of a fluid.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidStudy {
    /// The case.
    pub case: CaseName,
    /// How many particles there are.
    pub particles: usize,
    /// Frames that were simulated.
    pub frames: u32,
    /// How often the fluid was begun.
    pub starts: u32,
    /// f64 first, then the formats.
    pub rows: Vec<FluidRow>,
}

/// A run to be made: in which format, from which start.
type Job = (Option<Format>, Usage, u32);

/// Makes a study of a fluid.
///
/// # Errors
/// [`StudyError::NoFluid`] for a case that is no position-based fluid, [`StudyError::Chaotic`] where f64 itself scatters too much,
/// [`StudyError::Fluid`] where a format cannot hold the box.
pub fn run(request: &FluidRequest, progress: &dyn Progress) -> Result<FluidStudy, StudyError> {
    let is_fluid = request.case.solvers().contains(&run::Solver::Pbf);
    let fluid = run::fluid_of(request.case, RESOLUTION).filter(|_| is_fluid);
    let (setup, size) = fluid.ok_or(StudyError::NoFluid { case: request.case })?;
    let pool = parallel::pool(request.threads, || ()).map_err(StudyError::Threads)?;
    let formats = formats(request, &setup, size);
    let with_starts = |&(format, usage): &(Option<Format>, Usage)| {
        (0..request.starts).map(move |start| (format, usage, start))
    };
    let jobs: Vec<Job> = formats.iter().flat_map(with_starts).collect();
    progress.begin(jobs.len() as u64, 0);
    let found = pool.install(|| {
        parallel::map(jobs.into_iter(), |_, job| {
            let measured = measure(&setup, size, job, request.frames);
            progress.advance(1);
            measured
        })
    });
    progress.end();
    let found: Result<Vec<[f64; 2]>, _> = found.into_iter().collect();
    let found = found.map_err(|error| StudyError::Fluid { case: request.case, error })?;
    let rows = rows(&formats, found.chunks(request.starts as usize));
    let truth = rows[0].height;
    if truth.deviation > request.most_scatter * truth.mean {
        let (scatter, most) = (truth.deviation / truth.mean, request.most_scatter);
        return Err(StudyError::Chaotic { case: request.case, scatter, most });
    }
    let (frames, starts) = (request.frames, request.starts);
    Ok(FluidStudy { case: request.case, particles: setup.positions.len(), frames, starts, rows })
}

/// f64, the formats throughout, and the words that hold the box as compiled, the narrowest first.
fn formats(request: &FluidRequest, setup: &Setup<2>, size: [f64; 2]) -> Vec<(Option<Format>, Usage)> {
    let throughout = request.roundings.iter().flat_map(|&rounding| {
        let format = move |&fraction: &u32| {
            Format::new(INTEGER, fraction).ok().map(|format| format.with_rounding(rounding))
        };
        request.fractions.iter().filter_map(format)
    });
    let farthest = size.into_iter().fold(0.0, f64::max) / (2.0 * setup.spacing);
    let integer = farthest.log2().floor() as u32 + 2;
    let words = [16, 32].into_iter().filter_map(|word| Format::new(integer, word - integer).ok());
    let compiled = words.map(|format| (Some(format), Usage::Compiled));
    std::iter::once((None, Usage::Throughout))
        .chain(throughout.map(|format| (Some(format), Usage::Throughout)))
        .chain(compiled)
        .collect()
}

/// Height and speed at the end of one run.
fn measure(setup: &Setup<2>, size: [f64; 2], job: Job, frames: u32) -> Result<[f64; 2], sph_core::Error> {
    let (format, usage, start) = job;
    let mut setup = setup.clone();
    let (spacing, count) = (setup.spacing, setup.positions.len());
    for (number, x) in setup.positions.iter_mut().enumerate() {
        *x = jittered(start as usize * count + number, *x, APART * spacing);
    }
    match (format, usage) {
        (None, _) => simulate::<f64>(&setup, size, frames),
        (Some(format), Usage::Throughout) => {
            Choice::Emulated(format).scope(|| simulate::<Chosen>(&setup, size, frames))
        }
        (Some(format), Usage::Compiled) => format.scope(|| simulate::<Emulated>(&setup, size, frames)),
    }
}

fn simulate<T: Compact>(setup: &Setup<2>, size: [f64; 2], frames: u32) -> Result<[f64; 2], sph_core::Error> {
    let mut fluid = PositionBased::<T, 2>::new(setup, size, 1.0)?;
    let frame = fluid.frame();
    let first = frames.saturating_sub(MEASURED);
    let mut sums = [0.0; 2];
    for number in first..frames {
        // a fluid that escapes has no height: what it leaves is measured as it is
        let _ = fluid.advance(f64::from(number + 1) * frame);
        let (positions, velocities) = fluid.motion();
        let count = positions.len() as f64;
        sums[0] += 2.0 * positions.iter().map(|x| x[1]).sum::<f64>() / count;
        sums[1] += (velocities.iter().map(norm_squared).sum::<f64>() / count).sqrt();
    }
    let measured = f64::from(frames - first).max(1.0);
    Ok(sums.map(|sum| sum / measured))
}

fn spread(values: impl Iterator<Item = f64> + Clone) -> Spread {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares = values.map(|value| (value - mean).powi(2)).sum::<f64>();
    Spread { mean, deviation: (squares / (count - 1.0).max(1.0)).sqrt() }
}

fn rows<'a>(
    formats: &[(Option<Format>, Usage)],
    found: impl Iterator<Item = &'a [[f64; 2]]>,
) -> Vec<FluidRow> {
    let mut rows: Vec<FluidRow> = Vec::new();
    for (&(format, usage), starts) in formats.iter().zip(found) {
        let [height, speed] = [0, 1].map(|index| spread(starts.iter().map(|one| one[index])));
        let truth = rows.first().map_or([height, speed], |first| [first.height, first.speed]);
        let off = [(height, truth[0]), (speed, truth[1])].map(|(own, truth)| {
            let off = (own.mean - truth.mean).abs() / truth.deviation;
            if off.is_nan() && own.mean == truth.mean { 0.0 } else { off }
        });
        rows.push(FluidRow { format, usage, height, speed, off });
    }
    rows
}
