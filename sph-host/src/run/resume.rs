//! What is whole of an earlier run: the rows and frames that it can go on from.
//!
//! Files are written beside their names and renamed, so a run that is killed leaves whole files. Full disks, broken copies and
//! people leave others: what is cut short or missing is told, and the run goes on from before it.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

use super::folder::RunFolder;
use super::frame;
use super::series::{ROWS_A_FRAME, time_of_row};
use crate::engine::Snapshot;
use crate::progress::Progress;

/// The part of an earlier run that is whole.
pub(super) struct Whole<const D: usize> {
    /// Its frames, the first included.
    pub(super) frames: u64,
    /// The rows of the series up to the last of them.
    pub(super) rows: Vec<Vec<f64>>,
    /// The fluid in the last of them.
    pub(super) snapshot: Snapshot<D>,
}

/// What the files of the run are to hold.
pub(super) struct Expected<'a> {
    pub(super) columns: &'a [String],
    pub(super) particles: usize,
    /// Seconds from frame to frame.
    pub(super) every: f64,
}

/// The end of every frame's file.
const END_OF_FRAME: &[u8] = b"</VTKFile>\n";
/// The end of every picture's file: the chunk IEND.
const END_OF_PICTURE: &[u8] = b"\0\0\0\0IEND\xaeB`\x82";

impl<const D: usize> Whole<D> {
    /// Finds the last frame that is whole, with all frames and rows before it; `None` where there is none. Tells what is damaged.
    pub(super) fn find(folder: &RunFolder, expected: &Expected, progress: &dyn Progress) -> Option<Self> {
        let mut damages = Vec::new();
        let path = folder.series();
        let mut rows = read_rows(&path, expected, &mut damages);
        let with_rows = (rows.len() as u64).div_ceil(ROWS_A_FRAME);
        let mut frames = 0;
        while frames < with_rows && is_whole(&folder.frame(frames), END_OF_FRAME, &mut damages) {
            frames += 1;
        }
        let mut found = None;
        while found.is_none() && frames > 0 {
            let row = (frames - 1) * ROWS_A_FRAME;
            let path = folder.frame(frames - 1);
            match read_frame(&path, time_of_row(expected.every, row), expected.particles) {
                Ok(snapshot) => {
                    rows.truncate(row as usize + 1);
                    found = Some(snapshot);
                }
                Err(damage) => {
                    damages.push(damage);
                    frames -= 1;
                }
            }
        }
        if !damages.is_empty() {
            let damages = damages.join("; ");
            progress.note(&match &found {
                Some(now) => format!("{damages}: going on from frame {}, at {} s", frames - 1, now.time),
                None => format!("{damages}: beginning anew"),
            });
        }
        Some(Self { frames, rows, snapshot: found? })
    }
}

/// The pictures among the first `frames` that are missing or cut short.
pub(super) fn missing_pictures(folder: &RunFolder, frames: u64) -> u64 {
    let is_missing = |&number: &u64| !is_whole_picture(&folder.picture(number));
    (0..frames).filter(is_missing).count() as u64
}

/// Whether a picture is there and not cut short. Decoders take one that lacks its last bytes.
pub(super) fn is_whole_picture(path: &Path) -> bool {
    is_whole(path, END_OF_PICTURE, &mut Vec::new())
}

/// Whether a file is there and ends as it must; if not, adds to the damages what is wrong with it.
fn is_whole(path: &Path, end: &[u8], damages: &mut Vec<String>) -> bool {
    let tail = || {
        let mut file = File::open(path)?;
        file.seek(SeekFrom::End(-(end.len() as i64)))?;
        let mut tail = Vec::new();
        file.read_to_end(&mut tail).map(|_| tail)
    };
    let what = match tail() {
        Ok(tail) if tail == end => return true,
        Err(error) if error.kind() == io::ErrorKind::NotFound => "is missing",
        _ => "is cut short",
    };
    damages.push(format!("{} {what}", path.display()));
    false
}

/// Reads a frame; what is wrong with it as an error.
fn read_frame<const D: usize>(path: &Path, time: f64, particles: usize) -> Result<Snapshot<D>, String> {
    let now = frame::restore::<D>(path, time).map_err(|error| error.to_string())?;
    let found = now.positions.len();
    if found != particles {
        return Err(format!("{}: {found} particles, expected {particles}", path.display()));
    }
    let numbers = now.positions.iter().chain(&now.velocities).flatten();
    let is_finite = numbers.chain(&now.densities).chain(&now.pressures).all(|value| value.is_finite());
    if is_finite { Ok(now) } else { Err(format!("{}: not all numbers are finite", path.display())) }
}

/// Whether the last two cells of a row are counts: whole, and below 2⁵³, beyond which no further step would count.
fn has_counts(row: &[f64]) -> bool {
    let is_count = |count: &f64| count.fract() == 0.0 && (0.0..9_007_199_254_740_992.0).contains(count);
    row.last_chunk::<2>().is_some_and(|counts| counts.iter().all(is_count))
}

/// Reads the rows of the series up to the first that is not whole, or not where every run of this kind has one.
fn read_rows(path: &Path, expected: &Expected, damages: &mut Vec<String>) -> Vec<Vec<f64>> {
    let mut damaged = |what: &str| damages.push(format!("{} {what}", path.display()));
    let text = match std::fs::read(path) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            damaged("is missing");
            return Vec::new();
        }
        Err(error) => {
            damaged(&format!("cannot be read: {error}"));
            return Vec::new();
        }
    };
    let mut rows = Vec::new();
    // A line without its end may lack digits.
    let whole = text.iter().rposition(|&byte| byte == b'\n').map_or(0, |last| last + 1);
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(&text[..whole]);
    if !reader.headers().is_ok_and(|header| header.iter().eq(expected.columns)) {
        damaged("has other columns");
        return rows;
    }
    let mut records = reader.records().peekable();
    while let Some(record) = records.next() {
        let cells = record.iter().flatten().map(str::parse).collect::<Result<Vec<f64>, _>>();
        let is_row = |row: &Vec<f64>| row.len() == expected.columns.len() && has_counts(row);
        let Some(row) = cells.ok().filter(is_row) else {
            damaged(&format!("is damaged in line {}", rows.len() + 2));
            return rows;
        };
        if row[0] != time_of_row(expected.every, rows.len() as u64) {
            // The end of a run may be between two frames: that row is another's, and no damage.
            if records.peek().is_some() {
                damaged(&format!("has another time in line {}", rows.len() + 2));
            }
            return rows;
        }
        rows.push(row);
    }
    if whole < text.len() {
        damaged("is cut short");
    }
    rows
}
