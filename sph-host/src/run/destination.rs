//! A run into a directory: what happens to what is there, which frames are added, and what comes at the end.

use std::path::PathBuf;
use std::time::Instant;

use super::case::CaseName;
use super::case_run::CaseRun;
use super::definition::Case;
use super::error::Error;
use super::folder::{RunFolder, Spent};
use super::gallery::{Draw, Gallery};
use super::lock::Lock;
use super::options::Earlier;
use super::parameters::Parameters;
use super::resume::{self, Expected, Whole};
use super::summary::Summary;
use crate::engine::Snapshot;
use crate::progress::Progress;

/// Where results go, and what is there already.
pub(super) struct Destination {
    pub(super) folder: RunFolder,
    pub(super) earlier: Earlier,
    /// Whether an earlier run goes on.
    pub(super) is_begun: bool,
    pub(super) pictures: bool,
}

impl Destination {
    /// Simulates into the directory: on from what is whole of an earlier run, if it is to go on.
    pub(super) fn simulate<const D: usize>(
        &self,
        run: &mut CaseRun<D>,
        case: &dyn Case<D>,
        parameters: &Parameters,
        progress: &dyn Progress,
    ) -> Result<Summary, Error> {
        let (start, folder) = (Instant::now(), &self.folder);
        if self.earlier == Earlier::Keep && !Lock::is_in(folder) {
            // No lock is left behind in a directory that is taken; asked again once the lock is held.
            folder.require_free()?;
        }
        folder.make()?;
        let _lock = Lock::take(folder)?;
        self.make_ready()?;
        folder.write_parameters(parameters)?;
        let (before, spent) = self.resume(run, parameters, progress)?;
        let wall = || spent.wall + start.elapsed().as_secs_f64();
        let begun = run.frames;
        let gallery = Gallery { case, name: parameters.case, folder, every: parameters.every };
        let frames = |run: &mut CaseRun<D>, draw: &Draw<D>| {
            run.go_on(before, progress, |run, now| {
                folder.add_frame(run, now, parameters, wall())?;
                draw(run.frames - 1, now)
            })
        };
        let last = if self.pictures {
            gallery.draw_beside(|draw| frames(run, draw))?
        } else {
            frames(run, &|_, _| Ok(()))?
        };
        if run.frames == begun {
            // no frame came to bring these with it, and they may be what the directory lost
            folder.write_progress(run, parameters, wall())?;
        }
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

    /// Removes what is not to stay in the directory.
    fn make_ready(&self) -> Result<(), Error> {
        match self.earlier {
            Earlier::Keep => self.folder.require_free(),
            Earlier::Resume => self.folder.remove_unfinished(),
            Earlier::Replace => {
                self.folder.clear()?;
                self.folder.remove_unfinished()
            }
        }
    }

    /// Brings a run to the last frame that is whole, if there is one: the fluid there, and what was spent before.
    fn resume<const D: usize>(
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
        let spent = self.folder.spent(progress);
        run.stepping = spent.stepping;
        let Whole { frames, rows, snapshot } = whole;
        run.go_on_from(&snapshot, frames, rows)?;
        let missing = if self.pictures { resume::missing_pictures(&self.folder, frames) } else { 0 };
        if missing > 0 {
            let path = self.folder.path().display();
            progress.note(&format!("{path}: drawing again what is missing or cut short: {missing} pictures"));
        }
        Ok((Some(snapshot), spent))
    }

    /// The files to look at.
    fn files(&self, frames: u64, case: CaseName) -> Vec<(&'static str, PathBuf)> {
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
