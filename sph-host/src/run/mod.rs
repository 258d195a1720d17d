//! Cases simulated and measured against what is known of them: `fluisim run`.
//!
//! [`run`] simulates a case into a directory: `summary.json`, `series.csv`, particle frames `frame_0000.vtu` with `frames.pvd` for
//! ParaView, pictures `frame_0000.png`, `animation.gif`, and a plot against the reference. [`simulate`] does the same in memory.
//! Everything is in SI units.
//!
//! A request goes through these files in this order:
//!
//! 1. `options`: what is asked for. `parameters`: what that comes to, with the defaults of the case (`case`, one file for each; what a
//!    case has to say is in `definition`) and of the solver (`solver`, made by `method`).
//!    What does not fit in memory is refused (`memory`).
//! 2. `case_run`: steps, rows of the series (`series`, with what `diagnostics` and the case measure), frames.
//! 3. `destination`: the run into its directory. `folder`: the files of a run. `frame`: a frame as a file and back. `gallery`: pictures (`drawing`), drawn beside the steps.
//! 4. `summary`: the result, with each `check`.
//!
//! A run that was stopped goes on from its last whole frame (`resume`) and ends with the bits of one that was not: forces are
//! worked out anew at every frame from what is in its file.

mod case;
mod case_run;
mod check;
mod definition;
mod destination;
mod diagnostics;
mod drawing;
mod error;
mod folder;
mod frame;
mod gallery;
mod lock;
mod memory;
mod method;
mod options;
mod parameters;
mod reference;
mod resume;
mod series;
mod solver;
mod summary;
mod tank;
#[cfg(test)]
mod tests;

pub use case::CaseName;
pub use check::Check;
pub use error::Error;
pub(crate) use error::either;
pub use options::{Earlier, Options, Output, resolutions};
pub use series::Series;
pub use solver::Solver;
pub use summary::Summary;

use std::time::Instant;

use crate::engine::Setup;
use crate::parallel;
use crate::progress::Progress;
use case_run::CaseRun;
use definition::Form;
use destination::Destination;
use folder::RunFolder;
use parameters::Parameters;

/// Simulates a case into a directory. `progress` counts rows of the series.
///
/// ```no_run
/// use sph_host::run::{self, CaseName, Earlier, Options, Output};
///
/// let options = Options { resolution: Some(20), ..Options::new(CaseName::DamBreak) };
/// let output = Output { directory: "dam".into(), earlier: Earlier::Keep, pictures: true };
/// println!("{}", run::run(&options, &output, &())?.table());
/// # Ok::<(), run::Error>(())
/// ```
///
/// # Errors
/// Options that contradict each other, a directory that is taken, in use by another process or cannot be written, or a run that
/// failed: a number that is not finite. A particle that escaped does not end the run; see [`Summary::escaped`].
pub fn run(options: &Options, output: &Output, progress: &dyn Progress) -> Result<Summary, Error> {
    let folder = RunFolder::at(&output.directory)?;
    let stored = if output.earlier == Earlier::Resume { folder.stored(progress)? } else { None };
    let options = match &stored {
        Some(stored) => options.clone().going_on(stored, folder.path())?,
        None => options.clone(),
    };
    let destination = Destination {
        folder,
        earlier: output.earlier,
        is_begun: stored.is_some(),
        pictures: output.pictures,
    };
    start(&options, Some(&destination), progress).map(|(summary, _)| summary)
}

/// Simulates a case in memory: its result, and the time series that it was measured by. `progress` counts rows of the series.
///
/// # Errors
/// As [`run`], where no directory is at fault.
pub fn simulate(options: &Options, progress: &dyn Progress) -> Result<(Summary, Series), Error> {
    start(options, None, progress)
}

fn start(
    options: &Options,
    destination: Option<&Destination>,
    progress: &dyn Progress,
) -> Result<(Summary, Series), Error> {
    let parameters = options.parameters()?;
    let threads = options.threads;
    let scalar = parameters.scalar;
    let pool = parallel::pool(threads, move || scalar.enter())
        .map_err(|reason| Error::Threads { threads, reason })?;
    let definition = parameters.case.definition();
    pool.install(|| match (&definition.in_2d, &definition.in_3d) {
        (_, Some(form)) if parameters.dim == 3 => simulate_form(form, &parameters, destination, progress),
        (Some(form), _) if parameters.dim == 2 => simulate_form(form, &parameters, destination, progress),
        _ => Err(Error::Dimensions { case: parameters.case, found: parameters.dim }),
    })
}

fn simulate_form<const D: usize>(
    form: &Form<D>,
    parameters: &Parameters,
    destination: Option<&Destination>,
    progress: &dyn Progress,
) -> Result<(Summary, Series), Error> {
    memory::refuse_oversize(form, parameters.resolution, parameters.solver)?;
    let case = (form.build)(parameters.resolution);
    let mut run = CaseRun::new(&*case, parameters)?;
    let start = Instant::now();
    let summary = match destination {
        Some(destination) => destination.simulate(&mut run, &*case, parameters, progress)?,
        None => {
            let last = run.go_on(None, progress, |_, _| Ok(()))?;
            Summary::new(&run, &last, parameters, start.elapsed().as_secs_f64())
        }
    };
    Ok((summary, run.series))
}

/// The fluid of a case in two dimensions with so many particles across, and the size of its box.
pub(crate) fn fluid_of(case: CaseName, resolution: u32) -> Option<(Setup<2>, [f64; 2])> {
    let form = case.definition().in_2d.as_ref()?;
    let built = (form.build)(resolution);
    Some((built.setup(), built.inside().map(|(_, upper)| upper)))
}
