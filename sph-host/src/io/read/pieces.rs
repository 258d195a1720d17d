//! Files larger than memory: some points at a time.

use super::csv::Text;
use super::npz_rows::Archive;
use super::{ReadError, open};
use crate::io::error::{Parsed, Problem};
use crate::io::table::PointTable;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The points of a `.csv`, `.tsv` or `.npz` file in tables of a few, in the file's order.
///
/// What [`read`](super::read) says of a column as a whole, this says of each piece: a column with text in one piece and numbers in the
/// next has a fault in the first alone.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let dir = tempfile::tempdir()?;
/// # let path = dir.path().join("row.csv");
/// std::fs::write(&path, "x,m\n0,1\n1,1\n2,1\n")?;
/// let mut points = Vec::new();
/// for piece in sph_host::io::Pieces::open(&path, 2)? {
///     points.push(piece?.len());
/// }
/// assert_eq!(points, [2, 1]);
/// # Ok(())
/// # }
/// ```
pub struct Pieces {
    source: String,
    most: usize,
    /// None after the last piece and after an error.
    reader: Option<Reader>,
}

enum Reader {
    Text(Text<BufReader<File>>),
    Archive(Archive),
}

impl Pieces {
    /// Opens a file to be read at most so many points at a time.
    ///
    /// # Errors
    /// As [`read`](super::read); an ending that cannot be read piece by piece is unknown.
    pub fn open(path: &Path, most: usize) -> Result<Self, ReadError> {
        let source = path.display().to_string();
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let reader = match ending.as_deref() {
            Some("csv") => open(path).and_then(|file| Text::open(file, b',')).map(Reader::Text),
            Some("tsv") => open(path).and_then(|file| Text::open(file, b'\t')).map(Reader::Text),
            Some("npz") => Archive::open(path).map(Reader::Archive),
            _ => return Err(ReadError::NotInPieces { file: source }),
        };
        match reader {
            Ok(reader) => Ok(Self { source, most: most.max(1), reader: Some(reader) }),
            Err(problem) => Err(problem.in_file(&source)),
        }
    }

    fn piece(&mut self) -> Parsed<Option<PointTable>> {
        let Some(reader) = &mut self.reader else { return Ok(None) };
        let table = match reader {
            Reader::Text(text) => text.piece(self.most)?,
            Reader::Archive(archive) => archive.piece(self.most)?,
        };
        Ok(if table.is_empty() { None } else { Some(PointTable { source: self.source.clone(), ..table }) })
    }
}

impl Iterator for Pieces {
    type Item = Result<PointTable, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        let piece = self.piece();
        if !matches!(piece, Ok(Some(_))) {
            self.reader = None;
        }
        piece.map_err(|problem: Problem| problem.in_file(&self.source)).transpose()
    }
}
