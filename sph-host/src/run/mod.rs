//! Cases simulated and held against what is known of them: `fluisim run`.
//!
//! [`run`] simulates a case into a directory: `summary.json`, `series.csv`, particle frames `frame_0000.vtu` with `frames.pvd` for
//! ParaView, pictures `frame_0000.png`, `animation.gif`, and a plot against the reference. Everything is in SI units.
//!
//! A run that was stopped goes on from its last complete frame and ends with the bits of one that was not: forces are worked
//! out anew at every frame from what is in its file.

mod case;
mod drive;
mod folder;
mod frame;
mod measure;
mod reference;
mod series;
mod summary;
#[cfg(test)]
mod tests;

pub use series::Check;
pub use summary::Summary;

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use serde_json::json;

use crate::failure::Failure;
use crate::kernel_choice::KernelName;
use crate::progress::Progress;
use crate::scalar_choice::ScalarName;
use case::Case;
use drive::{Drive, Method, ROWS_A_FRAME};
use folder::Folder;

/// What can be simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CaseName {
    /// a column of water collapses on a dry bed; front against Koshizuka & Oka (1996)
    DamBreak,
    /// water at rest in a tank; pressure against ρ g (H − z)
    Hydrostatic,
    /// a round drop stretched to an ellipse (Monaghan 1994); semi-axes against the exact ones
    Drop,
    /// decaying periodic vortices at Re 100; energy against the exact decay
    TaylorGreen,
    /// the start of a channel flow (Morris 1997); profile against the series solution
    Poiseuille,
    /// a box turned through a script, shown as lamps; height and level against those of the volume put in
    Tilt,
}

/// How it is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Solver {
    /// weakly compressible SPH: stands against experiment
    Wcsph,
    /// position-based fluid, as microcontrollers run it: dam-break and tilt
    Pbf,
}

/// What to simulate, and where to.
#[derive(Clone, Debug)]
pub struct Options {
    /// The case.
    pub case: CaseName,
    /// The solver; `None` for pbf where the case is tilt, else wcsph.
    pub solver: Option<Solver>,
    /// Dimensions: 2, or 3 for the dam break.
    pub dim: usize,
    /// Particles across the case's length; `None` for the case's own.
    pub resolution: Option<u32>,
    /// Seconds to simulate; `None` for the case's own.
    pub time: Option<f64>,
    /// The number type: f64 or f32 for wcsph, any but f64 for pbf; `None` for the first of these.
    pub scalar: Option<ScalarName>,
    /// The kernel of wcsph; `None` for wendland-c2. pbf has its own, poly6.
    pub kernel: Option<KernelName>,
    /// The directory of the results.
    pub out: PathBuf,
    /// Seconds from frame to frame; `None` for a fiftieth of the time.
    pub every: Option<f64>,
    /// Go on from the last complete frame in the directory.
    pub resume: bool,
    /// Replace what an earlier run has left in the directory.
    pub force: bool,
    /// Threads; `None` for one on each core.
    pub threads: Option<usize>,
}

impl CaseName {
    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> String {
        word(&self)
    }

    /// What the case is, in a line.
    #[must_use]
    pub fn about(self) -> String {
        let value = self.to_possible_value();
        value.and_then(|value| value.get_help().map(ToString::to_string)).unwrap_or_default()
    }

    /// Particles across the case's length unless said otherwise: the column, the depth, the radius, the period, the channel.
    fn resolution(self, dim: usize) -> u32 {
        match self {
            Self::DamBreak if dim == 3 => 20,
            Self::DamBreak | Self::Hydrostatic | Self::Drop | Self::Poiseuille => 40,
            Self::TaylorGreen => 50,
            Self::Tilt => 32,
        }
    }
}

/// A choice as the command line names it.
fn word(choice: &impl ValueEnum) -> String {
    choice.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

/// The least and the most particles across a case's length.
const RESOLUTIONS: std::ops::RangeInclusive<u32> = 8..=2000;

/// Frames unless said otherwise, after the first.
const FRAMES: f64 = 50.0;

/// Frames of a run at most.
const MOST_FRAMES: f64 = 1e5;

/// Simulates a case into its directory. `progress` counts rows of the series.
///
/// # Errors
/// [`Failure::Usage`] for options that contradict each other, [`Failure::Input`] where the directory is taken or cannot be written,
/// or the run is lost: a number that is not finite. A particle that escaped does not end the run; see [`Summary::escaped`].
pub fn run(options: &Options, progress: &dyn Progress) -> Result<Summary, Failure> {
    let resolution = options.resolution.unwrap_or_else(|| options.case.resolution(options.dim));
    if !RESOLUTIONS.contains(&resolution) {
        let (least, most) = (RESOLUTIONS.start(), RESOLUTIONS.end());
        return Err(Failure::usage(format!("--resolution {resolution}: expected {least} to {most}")));
    }
    if options.dim == 3 && options.case != CaseName::DamBreak {
        return Err(Failure::usage(format!("--dim 3: {} has two dimensions", options.case.name())));
    }
    let method = options.method()?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads.unwrap_or(0))
        .build()
        .map_err(|error| Failure::input(format!("cannot start the threads: {error}")))?;
    let rounding = if method.scalar == ScalarName::F64 { 1e-12 } else { 1e-4 };
    let job = Job { options, method, resolution, progress };
    pool.install(|| match (options.case, options.dim) {
        (CaseName::DamBreak, 3) => job.simulate::<3>(&case::DamBreak { resolution }),
        (CaseName::DamBreak, _) => job.simulate::<2>(&case::DamBreak { resolution }),
        (CaseName::Hydrostatic, _) => job.simulate(&case::Hydrostatic { resolution }),
        (CaseName::Drop, _) => job.simulate(&case::Drop { resolution, rounding }),
        (CaseName::TaylorGreen, _) => job.simulate(&case::TaylorGreen { resolution, rounding }),
        (CaseName::Poiseuille, _) => job.simulate(&case::Poiseuille { resolution }),
        (CaseName::Tilt, _) => job.simulate(&case::Tilt { resolution }),
    })
}

impl Options {
    /// A case as it is usually simulated.
    #[must_use]
    pub fn new(case: CaseName, out: PathBuf) -> Self {
        Self {
            case,
            solver: None,
            dim: 2,
            resolution: None,
            time: None,
            scalar: None,
            kernel: None,
            out,
            every: None,
            resume: false,
            force: false,
            threads: None,
        }
    }

    /// What is simulated with, where the options do not contradict each other.
    fn method(&self) -> Result<Method, Failure> {
        let usual = if self.case == CaseName::Tilt { Solver::Pbf } else { Solver::Wcsph };
        let solver = self.solver.unwrap_or(usual);
        match solver {
            Solver::Wcsph => {
                let scalar = self.scalar.unwrap_or(ScalarName::F64);
                if !matches!(scalar, ScalarName::F64 | ScalarName::F32) {
                    let message =
                        format!("--scalar {}: --solver wcsph computes in f64 or f32", word(&scalar));
                    return Err(Failure::usage(message));
                }
                let kernel = self.kernel.unwrap_or(KernelName::WendlandC2);
                if kernel.is_singular() {
                    return Err(Failure::usage(format!("--kernel {}: it diverges at r = 0", kernel.name())));
                }
                Ok(Method { solver, scalar, kernel })
            }
            Solver::Pbf => {
                let scalar = self.scalar.unwrap_or(ScalarName::F32);
                let kernel = self.kernel.unwrap_or(KernelName::Poly6);
                if !matches!(self.case, CaseName::DamBreak | CaseName::Tilt) {
                    let name = self.case.name();
                    return Err(Failure::usage(format!(
                        "--solver pbf: for dam-break and tilt, not for {name}"
                    )));
                }
                if scalar == ScalarName::F64 {
                    let message = "--scalar f64: --solver pbf computes in f32, fast32 or fixed point";
                    return Err(Failure::usage(message));
                }
                if kernel != KernelName::Poly6 {
                    let name = kernel.name();
                    return Err(Failure::usage(format!("--kernel {name}: --solver pbf has its own, poly6")));
                }
                Ok(Method { solver, scalar, kernel })
            }
        }
    }
}

/// A run whose options make sense.
#[derive(Clone, Copy)]
struct Job<'a> {
    options: &'a Options,
    method: Method,
    resolution: u32,
    progress: &'a dyn Progress,
}

impl Job<'_> {
    fn simulate<const D: usize>(self, case: &dyn Case<D>) -> Result<Summary, Failure> {
        let Self { options, method, resolution, progress } = self;
        let duration = options.time.unwrap_or_else(|| case.duration());
        let every = options.every.unwrap_or(duration / FRAMES);
        if every > duration {
            return Err(Failure::usage(format!("--every {every}: longer than the {duration} s simulated")));
        }
        if duration / every > MOST_FRAMES {
            return Err(Failure::usage(format!(
                "--every {every}: more than {MOST_FRAMES} frames in the {duration} s simulated"
            )));
        }
        let particulars = json!({
            "case": options.case.name(),
            "solver": word(&method.solver),
            "dim": D,
            "resolution": resolution,
            "scalar": word(&method.scalar),
            "kernel": method.kernel.name(),
            "every": every,
        });
        let mut drive = Drive::new(case, method, every)?;
        let mut folder = Folder::open(&options.out, options.force, options.resume, particulars.clone())?;
        let start = Instant::now();
        let mut last = folder.resume(&mut drive)?;
        let before = folder.wall_seconds();
        let frames = drive.frames_in(duration);
        let rows = |frames: u64| frames.saturating_sub(1) * ROWS_A_FRAME;
        progress.begin(rows(frames), rows(drive.frames));
        while drive.frames < frames {
            let snapshot = drive.next_frame(duration, progress)?;
            folder.add_frame(&drive, &snapshot, before + start.elapsed().as_secs_f64())?;
            last = Some(snapshot);
        }
        progress.end();
        let last = last.ok_or_else(|| Failure::input("nothing was simulated"))?;
        let wall = before + start.elapsed().as_secs_f64();
        let mut summary = Summary::new(&drive, &last, particulars, wall);
        summary.files = folder.finish(&drive, &last, &summary)?;
        Ok(summary)
    }
}
