//! The directory of one run: which files belong to it, and how each is written.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::case::CaseName;
use super::case_run::CaseRun;
use super::error::Error;
use super::frame;
use super::parameters::Parameters;
use super::series::ROWS_A_FRAME;
use crate::engine::Snapshot;
use crate::output::{self, Column, Precision, Table, Target};
use crate::picture::Image;
use crate::progress::Progress;

/// The parameters, written before anything else.
const PARAMETERS: &str = "run.json";
/// How much time was spent, written after everything that belongs to a frame.
const CHECKPOINT: &str = "checkpoint.json";
const SERIES: &str = "series.csv";
const SUMMARY: &str = "summary.json";
const COLLECTION: &str = "frames.pvd";
const ANIMATION: &str = "animation.gif";

/// The directory of one run.
pub(super) struct RunFolder {
    path: PathBuf,
}

/// Seconds that a run took so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spent {
    /// From beginning to end.
    pub(super) wall: f64,
    /// In steps alone.
    pub(super) stepping: f64,
}

impl RunFolder {
    /// The directory at a path, where there is one or can be one.
    pub(super) fn at(path: &Path) -> Result<Self, Error> {
        match fs::metadata(path) {
            Ok(found) if !found.is_dir() => Err(Error::NotADirectory(path.to_owned())),
            _ => Ok(Self { path: path.to_owned() }),
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The parameters of the run in the directory; `None` where there is no run to go on with.
    pub(super) fn stored(&self, progress: &dyn Progress) -> Result<Option<Parameters>, Error> {
        let earlier = self.earlier()?;
        let is_there = |name: &str| earlier.iter().any(|path| path.ends_with(name));
        for (name, is_run) in [(PARAMETERS, true), (CHECKPOINT, false)] {
            let path = self.path.join(name);
            let json = fs::read(&path).ok().and_then(|bytes| serde_json::from_slice::<Value>(&bytes).ok());
            let json = json.unwrap_or_default();
            if let Some(parameters) = Parameters::of_json(if is_run { &json } else { &json["run"] }) {
                return Ok(Some(parameters));
            }
            if !earlier.is_empty() {
                let what = if is_there(name) { "is damaged" } else { "is missing" };
                progress.note(&format!("{} {what}", path.display()));
            }
        }
        let has_frames = earlier.iter().any(|path| path.extension().is_some_and(|ending| ending == "vtu"));
        if has_frames { Err(Error::UnknownRun(self.path.clone())) } else { Ok(None) }
    }

    /// That no run is in the directory.
    pub(super) fn require_free(&self) -> Result<(), Error> {
        if self.earlier()?.is_empty() { Ok(()) } else { Err(Error::Taken(self.path.clone())) }
    }

    /// Makes the directory.
    pub(super) fn make(&self) -> Result<(), Error> {
        fs::create_dir_all(&self.path).map_err(failed(&self.path))
    }

    /// Removes the files of an earlier run.
    pub(super) fn clear(&self) -> Result<(), Error> {
        self.earlier()?.iter().try_for_each(|path| remove(path))
    }

    /// Removes files that a process began and, because it was killed, neither finished nor removed.
    pub(super) fn remove_unfinished(&self) -> Result<(), Error> {
        let is_ours = |path: &PathBuf| output::is_unfinished(path) && path.is_file() && !path.is_symlink();
        self.files()?.iter().filter(|path| is_ours(path)).try_for_each(|path| remove(path))
    }

    /// Removes frames from `frames` on, and what shows more frames than there are.
    pub(super) fn remove_after(&self, frames: u64) -> Result<(), Error> {
        for path in self.earlier()? {
            let number =
                path.file_stem().and_then(|stem| stem.to_str()?.strip_prefix("frame_")?.parse().ok());
            if number.is_some_and(|number: u64| number >= frames) {
                remove(&path)?;
            }
        }
        Ok(())
    }

    /// Removes the animation and the plot of an earlier end.
    pub(super) fn remove_end_pictures(&self, case: CaseName) -> Result<(), Error> {
        let paths = [self.animation(), self.plot(case)];
        paths.iter().filter(|path| path.exists()).try_for_each(|path| remove(path))
    }

    /// All files in the directory; none where there is no directory.
    fn files(&self) -> Result<Vec<PathBuf>, Error> {
        let entries = match fs::read_dir(&self.path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            entries => entries.map_err(failed(&self.path))?,
        };
        entries.map(|entry| entry.map(|entry| entry.path()).map_err(failed(&self.path))).collect()
    }

    /// The files of an earlier run.
    fn earlier(&self) -> Result<Vec<PathBuf>, Error> {
        let others = [PARAMETERS, CHECKPOINT, SERIES, SUMMARY, COLLECTION, ANIMATION];
        let is_ours = |path: &PathBuf| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let is_frame = name.starts_with("frame_") && (name.ends_with(".vtu") || name.ends_with(".png"));
            is_frame || others.contains(&&*name) || CaseName::ALL.iter().any(|case| case.plot() == name)
        };
        Ok(self.files()?.into_iter().filter(is_ours).collect())
    }

    pub(super) fn frame(&self, number: u64) -> PathBuf {
        self.path.join(format!("frame_{number:04}.vtu"))
    }

    pub(super) fn picture(&self, number: u64) -> PathBuf {
        self.path.join(format!("frame_{number:04}.png"))
    }

    pub(super) fn series(&self) -> PathBuf {
        self.path.join(SERIES)
    }

    pub(super) fn collection(&self) -> PathBuf {
        self.path.join(COLLECTION)
    }

    pub(super) fn animation(&self) -> PathBuf {
        self.path.join(ANIMATION)
    }

    pub(super) fn plot(&self, case: CaseName) -> PathBuf {
        self.path.join(case.plot())
    }

    /// Writes the parameters, unless the file has them already: what says of which run the frames are is not touched again.
    pub(super) fn write_parameters(&self, parameters: &Parameters) -> Result<(), Error> {
        let stored = fs::read(self.path.join(PARAMETERS)).ok();
        let stored = stored.and_then(|bytes| serde_json::from_slice(&bytes).ok());
        if stored.as_ref().and_then(Parameters::of_json).as_ref() == Some(parameters) {
            return Ok(());
        }
        self.write_json(PARAMETERS, &Value::Object(parameters.to_json()))
    }

    /// What was spent on the run so far; nothing where that is not known.
    pub(super) fn spent(&self, progress: &dyn Progress) -> Spent {
        let path = self.path.join(CHECKPOINT);
        let json = fs::read(&path).ok();
        let json: Value = json.and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default();
        let [wall, stepping] = ["wall_s", "stepping_s"].map(|name| json[name].as_f64());
        if wall.is_none() || stepping.is_none() {
            let what = if path.exists() { "is damaged" } else { "is missing" };
            progress.note(&format!("{} {what}: the time spent so far is not known", path.display()));
        }
        Spent { wall: wall.unwrap_or(0.0), stepping: stepping.unwrap_or(0.0) }
    }

    /// Writes the newest frame and all that goes with it but the picture.
    pub(super) fn add_frame<const D: usize>(
        &self,
        run: &CaseRun<D>,
        now: &Snapshot<D>,
        parameters: &Parameters,
        wall: f64,
    ) -> Result<(), Error> {
        let number = run.frames - 1;
        output::write(&frame::table(now, run.method.precision()), &target(self.frame(number)))?;
        self.write_progress(run, parameters, wall)
    }

    /// Writes what tells of all frames so far.
    pub(super) fn write_progress<const D: usize>(
        &self,
        run: &CaseRun<D>,
        parameters: &Parameters,
        wall: f64,
    ) -> Result<(), Error> {
        self.write_series(run)?;
        self.write_collection(run)?;
        let checkpoint = json!({
            "run": parameters.to_json(),
            "frames": run.frames,
            "steps": run.tally().steps,
            "wall_s": wall,
            "stepping_s": run.stepping,
        });
        self.write_json(CHECKPOINT, &checkpoint)
    }

    pub(super) fn write_summary(&self, summary: &Value) -> Result<(), Error> {
        self.write_json(SUMMARY, summary)
    }

    fn write_json(&self, name: &str, value: &Value) -> Result<(), Error> {
        Ok(target(self.path.join(name)).create(|file| writeln!(file, "{value:#}"))?)
    }

    fn write_series<const D: usize>(&self, run: &CaseRun<D>) -> Result<(), Error> {
        let series = &run.series;
        let mut columns = series.columns.iter().enumerate().map(|(index, name)| {
            Column::new(name.as_str(), series.rows.iter().map(|row| row[index]).collect())
        });
        let table = Table {
            coordinates: columns.by_ref().take(1).collect(),
            columns: columns.collect(),
            grid: None,
            precision: Precision::F64,
            caption: String::new(),
        };
        Ok(output::write(&table, &target(self.series()))?)
    }

    /// The frames and their times, for ParaView.
    fn write_collection<const D: usize>(&self, run: &CaseRun<D>) -> Result<(), Error> {
        let rows = &run.series.rows;
        let before = rows.iter().step_by(ROWS_A_FRAME as usize).take(run.frames as usize - 1);
        let times = before.chain(rows.last()).map(|row| row[0]);
        let moments: Vec<(f64, PathBuf)> =
            times.zip(0..).map(|(time, number)| (time, self.frame(number))).collect();
        Ok(output::write_collection(&moments, &target(self.collection()))?)
    }
}

/// A file of this run: whether another run's may be replaced is settled before.
pub(super) fn target(path: PathBuf) -> Target {
    Target { path, force: true }
}

pub(super) fn write_png(image: &Image, path: PathBuf) -> Result<(), Error> {
    Ok(target(path).create(|file| image.write_png(file))?)
}

fn remove(path: &Path) -> Result<(), Error> {
    fs::remove_file(path).map_err(failed(path))
}

/// What the system said of a path.
pub(super) fn failed(path: &Path) -> impl Fn(io::Error) -> Error {
    let path = path.to_owned();
    move |source| Error::File { path: path.clone(), source }
}
