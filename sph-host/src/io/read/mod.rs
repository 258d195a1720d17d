//! One reader a format, chosen by the file's ending.

mod appended;
mod csv;
mod legacy;
mod legacy_text;
mod npy;
mod npz;
mod npz_rows;
mod pieces;
mod records;
mod xml;
mod xml_arrays;

use super::error::{Parsed, Problem, ReadError};
use super::table::{Array, PointTable, Rows};
pub use pieces::Pieces;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// The endings that [`read`] knows, in any case of letters.
pub const ENDINGS: [&str; 6] = [".csv", ".tsv", ".vtk", ".vtu", ".vtp", ".npz"];

/// Reads a particle file by its ending.
///
/// # Errors
/// [`ReadError::UnknownEnding`] before the file is looked at; [`ReadError::Io`] when the system would not give its
/// bytes; [`ReadError::Invalid`] when its content is at fault.
pub fn read(path: &Path) -> Result<PointTable, ReadError> {
    let file = path.display().to_string();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    let read = match ending.as_deref() {
        Some("csv") => |path: &Path| csv::read(open(path)?, b','),
        Some("tsv") => |path: &Path| csv::read(open(path)?, b'\t'),
        Some("vtk") => |path: &Path| legacy::read(&bytes(path)?),
        Some("vtu" | "vtp") => |path: &Path| xml::read(&bytes(path)?),
        Some("npz") => |path: &Path| npz::read(open(path)?),
        _ => return Err(ReadError::UnknownEnding { file }),
    };
    match read(path) {
        Ok(table) => Ok(PointTable { source: file, ..table }),
        Err(problem) => Err(problem.in_file(&file)),
    }
}

/// The file behind a buffer, of which there is at least one byte.
fn open(path: &Path) -> Parsed<BufReader<File>> {
    let mut input = BufReader::with_capacity(1 << 18, File::open(path)?);
    if input.fill_buf()?.is_empty() { Err(empty()) } else { Ok(input) }
}

/// The whole file, of which there is at least one byte.
fn bytes(path: &Path) -> Parsed<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.read_to_end(&mut bytes)?;
    if bytes.is_empty() { Err(empty()) } else { Ok(bytes) }
}

fn empty() -> Problem {
    Problem::new("the file is empty")
}

/// A table of VTK: three coordinates a point, one point after the other.
fn from_vtk(points: &[f64], arrays: Vec<Array>) -> Parsed<PointTable> {
    let axis = |axis: usize| points.iter().skip(axis).step_by(3).copied().collect();
    PointTable::assemble(vec![axis(0), axis(1), axis(2)], arrays, Rows::Points)
}

/// `count` numbers written as text with blanks between; `what` names them in messages.
fn parse_text<'a>(
    what: &str,
    words: &mut impl Iterator<Item = &'a [u8]>,
    count: usize,
    out: &mut Vec<f64>,
) -> Parsed<()> {
    for index in 0..count {
        let Some(word) = words.next() else {
            return Err(Problem::at(what, format!("ends after {index} of {count} numbers")));
        };
        let Some(number) = super::numbers::parse(word) else {
            let problem = format!("number {index} of {count}: {} is not a number", super::error::shown(word));
            return Err(Problem::at(what, problem));
        };
        out.push(number);
    }
    Ok(())
}
