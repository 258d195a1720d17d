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
//! 2. `case_run`: steps, rows of the series (`series`, with what `diagnostics` and the case measure), frames.
//! 3. `folder`: the files of a run. `frame`: a frame as a file and back. `gallery`: pictures (`drawing`), drawn beside the steps.
//! 4. `summary`: the result, with each `check`.
//!
//! A run that was stopped goes on from its last whole frame (`resume`) and ends with the bits of one that was not: forces are
//! worked out anew at every frame from what is in its file.

mod case;
mod case_run;
mod check;
mod definition;
mod diagnostics;
mod drawing;
mod error;
mod folder;
mod frame;
mod gallery;
mod method;
mod names;
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

use crate::engine::Snapshot;
use crate::progress::Progress;
use case_run::CaseRun;
use definition::{Case, Form};
use folder::{RunFolder, Spent};
use gallery::{Draw, Gallery};
use parameters::Parameters;
use resume::{Expected, Whole};
use series::ROWS_A_FRAME;

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
/// Options that contradict each other, a directory that is taken or cannot be written, or a run that failed: a number that is not
/// finite. A particle that escaped does not end the run; see [`Summary::escaped`].
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

/// Where results go, and what is there already.
struct Destination {
    folder: RunFolder,
    earlier: Earlier,
    /// Whether an earlier run goes on.
    is_begun: bool,
    pictures: bool,
}

fn start(
    options: &Options,
    destination: Option<&Destination>,
    progress: &dyn Progress,
) -> Result<(Summary, Series), Error> {
    let parameters = options.parameters()?;
    let threads = options.threads;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    let pool = pool.map_err(|error| Error::Threads { threads, reason: error.to_string() })?;
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
    let case = (form.build)(parameters.resolution);
    let mut run = CaseRun::new(&*case, parameters)?;
    let start = Instant::now();
    let summary = match destination {
        Some(destination) => destination.simulate(&mut run, &*case, parameters, progress)?,
        None => {
            let last = steps(&mut run, None, progress, |_, _| Ok(()))?;
            Summary::new(&run, &last, parameters, start.elapsed().as_secs_f64())
        }
    };
    Ok((summary, run.series))
}

/// Goes on to the last frame, and gives each new frame to `add`. Returns the fluid at the end.
fn steps<const D: usize>(
    run: &mut CaseRun<D>,
    before: Option<Snapshot<D>>,
    progress: &dyn Progress,
    mut add: impl FnMut(&CaseRun<D>, &Snapshot<D>) -> Result<(), Error>,
) -> Result<Snapshot<D>, Error> {
    let frames = run.all_frames();
    let rows = |frames: u64| frames.saturating_sub(1) * ROWS_A_FRAME;
    progress.begin(rows(frames), rows(run.frames).min(rows(frames)));
    let mut last = match before {
        Some(before) => before,
        None => {
            let first = run.next_frame(progress)?;
            add(run, &first)?;
            first
        }
    };
    while run.frames < frames {
        last = run.next_frame(progress)?;
        add(run, &last)?;
    }
    progress.end();
    Ok(last)
}

impl Destination {
    /// Simulates into the directory: on from what is whole of an earlier run, if it is to go on.
    fn simulate<const D: usize>(
        &self,
        run: &mut CaseRun<D>,
        case: &dyn Case<D>,
        parameters: &Parameters,
        progress: &dyn Progress,
    ) -> Result<Summary, Error> {
        let (start, folder) = (Instant::now(), &self.folder);
        self.make_ready()?;
        folder.write_parameters(parameters)?;
        let (before, spent) = self.go_on(run, parameters, progress)?;
        let wall = || spent.wall + start.elapsed().as_secs_f64();
        let begun = run.frames;
        let gallery = Gallery { case, name: parameters.case, folder, every: parameters.every };
        let frames = |run: &mut CaseRun<D>, draw: &Draw<D>| {
            steps(run, before, progress, |run, now| {
                folder.add_frame(run, now, parameters, wall())?;
                draw(run.frames - 1, now)
            })
        };
        let last = if self.pictures {
            gallery.draw_beside(|draw| frames(run, draw))?
        } else {
            frames(run, &|_, _| Ok(()))?
        };
        folder.remove_after(run.frames)?;
        let mut summary = Summary::new(run, &last, parameters, wall());
        if self.pictures {
            gallery.write_plot(run, &last)?;
            gallery.write_animation(run.frames, &last)?;
        } else if run.frames > begun {
            folder.remove_end_pictures(parameters.case)?;
        }
        folder.write_summary(&summary.json)?;
        summary.files = self.files(run.frames, parameters.case);
        Ok(summary)
    }

    /// Makes the directory, and removes what is not to stay there.
    fn make_ready(&self) -> Result<(), Error> {
        match self.earlier {
            Earlier::Keep => self.folder.require_free()?,
            Earlier::Resume => self.folder.remove_unfinished()?,
            Earlier::Replace => {
                self.folder.clear()?;
                self.folder.remove_unfinished()?;
            }
        }
        self.folder.make()
    }

    /// Brings a run to the last frame that is whole, if there is one: the fluid there, and what was spent before.
    fn go_on<const D: usize>(
        &self,
        run: &mut CaseRun<D>,
        parameters: &Parameters,
        progress: &dyn Progress,
    ) -> Result<(Option<Snapshot<D>>, Spent), Error> {
        if !self.is_begun {
            return Ok((None, Spent::default()));
        }
        let expected = Expected {
            columns: &run.series.columns,
            particles: run.setup.positions.len(),
            every: parameters.every,
        };
        let Some(whole) = Whole::find(&self.folder, &expected, progress) else {
            return Ok((None, Spent::default()));
        };
        let spent = self.folder.spent();
        run.stepping = spent.stepping;
        let Whole { frames, rows, snapshot } = whole;
        run.go_on_from(&snapshot, frames, rows)?;
        let missing = if self.pictures { resume::missing_pictures(&self.folder, frames) } else { 0 };
        if missing > 0 {
            let path = self.folder.path().display();
            progress
                .note(&format!("{path}: {missing} pictures are missing or cut short and are drawn again"));
        }
        Ok((Some(snapshot), spent))
    }

    /// The files to look at.
    fn files(&self, frames: u64, case: CaseName) -> Vec<(&'static str, std::path::PathBuf)> {
        let folder = &self.folder;
        let collection = ("for ParaView", folder.collection());
        if !self.pictures {
            return vec![("time series", folder.series()), collection];
        }
        vec![
            ("picture", folder.picture(frames - 1)),
            ("animation", folder.animation()),
            ("plot", folder.plot(case)),
            collection,
        ]
    }
}
