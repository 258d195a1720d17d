//! The directory that a run leaves its results in, and goes on from.
//!
//! `checkpoint.json` says how many frames are complete; it is written after everything that belongs to them.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::{Value, json};

use super::case::PLOTS;
use super::drive::{Drive, ROWS_A_FRAME};
use super::frame;
use super::summary::Summary;
use crate::engine::Snapshot;
use crate::failure::Failure;
use crate::output::{self, Column, Precision, Table, Target};
use crate::picture::animation::Animation;
use crate::picture::{Image, plot};

const CHECKPOINT: &str = "checkpoint.json";
const SERIES: &str = "series.csv";
const SUMMARY: &str = "summary.json";
const COLLECTION: &str = "frames.pvd";
const ANIMATION: &str = "animation.gif";

/// How long a picture of the animation stays.
const DELAY: Duration = Duration::from_millis(60);

/// The results of one run.
pub(super) struct Folder {
    path: PathBuf,
    /// What makes this run another than others: it is asked for when a run goes on.
    run: Value,
    /// What the checkpoint says, where there is one to go on from.
    checkpoint: Option<Value>,
}

impl Folder {
    /// Makes the directory, or takes one that has no run in it; `force` removes an earlier run, `resume` goes on with it.
    pub(super) fn open(path: &Path, force: bool, resume: bool, run: Value) -> Result<Self, Failure> {
        fs::create_dir_all(path).map_err(|error| failed(path, &error))?;
        let mut folder = Self { path: path.to_owned(), run, checkpoint: None };
        let earlier = folder.earlier()?;
        let place = path.display();
        if resume {
            folder.checkpoint = folder.read_checkpoint()?;
        } else if force {
            for file in earlier {
                fs::remove_file(&file).map_err(|error| failed(&file, &error))?;
            }
        } else if !earlier.is_empty() {
            let message =
                format!("{place}: already holds a run; use --resume to go on with it, --force to replace it");
            return Err(Failure::input(message));
        }
        Ok(folder)
    }

    /// The files of an earlier run.
    fn earlier(&self) -> Result<Vec<PathBuf>, Failure> {
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.path).map_err(|error| failed(&self.path, &error))? {
            let path = entry.map_err(|error| failed(&self.path, &error))?.path();
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let is_frame = name.starts_with("frame_") && (name.ends_with(".vtu") || name.ends_with(".png"));
            let others = [CHECKPOINT, SERIES, SUMMARY, COLLECTION, ANIMATION];
            if is_frame || others.iter().chain(&PLOTS).any(|other| *other == name) {
                files.push(path);
            }
        }
        Ok(files)
    }

    fn read_checkpoint(&self) -> Result<Option<Value>, Failure> {
        let path = self.path.join(CHECKPOINT);
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(failed(&path, &error)),
        };
        let checkpoint: Value = serde_json::from_str(&text)
            .map_err(|error| Failure::input(format!("{}: {error}", path.display())))?;
        for (name, ours) in self.run.as_object().into_iter().flatten() {
            let theirs = &checkpoint["run"][name];
            if theirs != ours {
                let place = path.display();
                let message = format!("{place}: a run with {name} {theirs} cannot go on with {name} {ours}");
                return Err(Failure::input(message));
            }
        }
        Ok(Some(checkpoint))
    }

    /// The wall time of what was done before.
    pub(super) fn wall_seconds(&self) -> f64 {
        self.checkpoint.as_ref().and_then(|checkpoint| checkpoint["wall_s"].as_f64()).unwrap_or(0.0)
    }

    /// Brings a run to its last complete frame, if there is one.
    pub(super) fn resume<const D: usize>(
        &self,
        drive: &mut Drive<D>,
    ) -> Result<Option<Snapshot<D>>, Failure> {
        let Some(checkpoint) = &self.checkpoint else { return Ok(None) };
        let place = self.path.join(CHECKPOINT);
        let number = |name: &str| {
            let missing = || Failure::input(format!("{}: {name} is not a number", place.display()));
            checkpoint[name].as_u64().ok_or_else(missing)
        };
        let (frames, steps) = (number("frames")?, number("steps")?);
        let stepping = checkpoint["stepping_s"].as_f64().unwrap_or(0.0);
        if frames == 0 {
            return Ok(None);
        }
        let wanted = ((frames - 1) * ROWS_A_FRAME + 1) as usize;
        let rows = self.read_series(wanted, drive.series.columns.len())?;
        let time = rows.last().map_or(0.0, |row| row[0]);
        let path = self.frame(frames - 1, "vtu");
        let snapshot = frame::restore::<D>(&path, time)?;
        if snapshot.positions.len() != drive.setup.positions.len() {
            let (found, expected) = (snapshot.positions.len(), drive.setup.positions.len());
            let message = format!("{}: {found} particles, expected {expected}", path.display());
            return Err(Failure::input(message));
        }
        drive.resume(&snapshot, steps, frames, stepping, rows)?;
        Ok(Some(snapshot))
    }

    fn read_series(&self, wanted: usize, columns: usize) -> Result<Vec<Vec<f64>>, Failure> {
        let path = self.path.join(SERIES);
        let wrong = |what: String| Failure::input(format!("{}: {what}", path.display()));
        let mut reader = csv::Reader::from_path(&path).map_err(|error| wrong(error.to_string()))?;
        let mut rows = Vec::new();
        for (line, record) in reader.records().take(wanted).enumerate() {
            let record = record.map_err(|error| wrong(error.to_string()))?;
            let row: Result<Vec<f64>, _> = record.iter().map(str::parse).collect();
            let row = row.map_err(|error| wrong(format!("line {}: {error}", line + 2)))?;
            if row.len() != columns {
                return Err(wrong(format!("line {}: {} cells, expected {columns}", line + 2, row.len())));
            }
            rows.push(row);
        }
        if rows.len() < wanted {
            return Err(wrong(format!("{} rows, expected {wanted}", rows.len())));
        }
        Ok(rows)
    }

    /// Writes the newest frame and all that goes with it.
    pub(super) fn add_frame<const D: usize>(
        &mut self,
        drive: &Drive<D>,
        now: &Snapshot<D>,
        wall_seconds: f64,
    ) -> Result<(), Failure> {
        let number = drive.frames - 1;
        output::write(&frame::table(now, drive.precision), &self.target(self.frame(number, "vtu")))?;
        let title = format!("{}, t = {:.4} s", self.run["case"].as_str().unwrap_or_default(), now.time);
        let image = drive.case.picture(now, &title).map_err(drawing)?;
        self.write_png(&image, self.frame(number, "png"))?;
        self.write_series(drive)?;
        self.write_collection(drive)?;
        if !drive.is_whole() {
            return Ok(());
        }
        let checkpoint = json!({
            "run": self.run,
            "frames": drive.frames,
            "steps": drive.steps(),
            "wall_s": wall_seconds,
            "stepping_s": drive.stepping,
        });
        self.write_json(CHECKPOINT, &checkpoint)
    }

    /// Writes what is known only at the end: the plot, the animation, the summary. Gives what there is to look at.
    pub(super) fn finish<const D: usize>(
        &self,
        drive: &Drive<D>,
        last: &Snapshot<D>,
        summary: &Summary,
    ) -> Result<Vec<(&'static str, PathBuf)>, Failure> {
        let (name, plots) = drive.case.plots(&drive.series, last);
        let image = plot::draw(&self.caption(last), &plots).map_err(drawing)?;
        self.write_png(&image, self.path.join(name))?;
        self.write_animation(drive.frames)?;
        self.write_json(SUMMARY, &summary.json)?;
        Ok(vec![
            ("picture", self.frame(drive.frames - 1, "png")),
            ("animation", self.path.join(ANIMATION)),
            ("plot", self.path.join(name)),
            ("for ParaView", self.path.join(COLLECTION)),
        ])
    }

    fn caption<const D: usize>(&self, last: &Snapshot<D>) -> String {
        let word = |name: &str| self.run[name].as_str().unwrap_or_default().to_owned();
        let particles = last.positions.len();
        format!("{}: {particles} particles, {}, {}", word("case"), word("kernel"), word("scalar"))
    }

    fn frame(&self, number: u64, ending: &str) -> PathBuf {
        self.path.join(format!("frame_{number:04}.{ending}"))
    }

    /// A file of this run: whether another run's may be replaced was settled at the beginning.
    fn target(&self, path: PathBuf) -> Target {
        Target { path, force: true }
    }

    fn write_png(&self, image: &Image, path: PathBuf) -> Result<(), Failure> {
        Ok(self.target(path).create(|file| image.write_png(file))?)
    }

    fn write_json(&self, name: &str, value: &Value) -> Result<(), Failure> {
        Ok(self.target(self.path.join(name)).create(|file| writeln!(file, "{value:#}"))?)
    }

    fn write_series<const D: usize>(&self, drive: &Drive<D>) -> Result<(), Failure> {
        let series = &drive.series;
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
        Ok(output::write(&table, &self.target(self.path.join(SERIES)))?)
    }

    /// The frames and their times, for ParaView.
    fn write_collection<const D: usize>(&self, drive: &Drive<D>) -> Result<(), Failure> {
        let rows = &drive.series.rows;
        let last = rows.last().filter(|_| !drive.is_whole());
        let whole = drive.frames as usize - usize::from(last.is_some());
        let times = rows.iter().step_by(ROWS_A_FRAME as usize).take(whole).chain(last).map(|row| row[0]);
        let target = self.target(self.path.join(COLLECTION));
        Ok(target.create(|file| {
            writeln!(
                file,
                "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>"
            )?;
            for (number, time) in times.enumerate() {
                writeln!(file, r#"<DataSet timestep="{time}" file="frame_{number:04}.vtu"/>"#)?;
            }
            writeln!(file, "</Collection>\n</VTKFile>")
        })?)
    }

    /// All pictures as one.
    fn write_animation(&self, frames: u64) -> Result<(), Failure> {
        let first = self.read_png(0)?;
        let target = self.target(self.path.join(ANIMATION));
        Ok(target.create(|file| {
            let mut animation = Animation::begin(file, first.width, first.height, DELAY)?;
            animation.push(&first)?;
            for number in 1..frames {
                let image = self.read_png(number).map_err(|failure| io::Error::other(failure.to_string()))?;
                animation.push(&image)?;
            }
            animation.finish().map(drop)
        })?)
    }

    /// A picture of this run back from its file.
    fn read_png(&self, number: u64) -> Result<Image, Failure> {
        let path = self.frame(number, "png");
        let wrong = |error: png::DecodingError| Failure::input(format!("{}: {error}", path.display()));
        let file = File::open(&path).map_err(|error| failed(&path, &error))?;
        let mut reader = png::Decoder::new(io::BufReader::new(file)).read_info().map_err(wrong)?;
        let (width, height) = (reader.info().width, reader.info().height);
        let mut rgb = vec![0; reader.output_buffer_size().unwrap_or(0)];
        reader.next_frame(&mut rgb).map_err(wrong)?;
        Ok(Image { width, height, rgb })
    }
}

fn failed(path: &Path, error: &io::Error) -> Failure {
    Failure::input(format!("{}: {error}", path.display()))
}

fn drawing(error: crate::picture::PictureError) -> Failure {
    Failure::input(format!("the picture cannot be drawn: {error}"))
}
