//! Files larger than memory: some points at a time.

use super::{Format, ReadError, refuse_special};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem};
use crate::io::table::PointTable;
use std::path::Path;
use std::sync::Arc;
use tempfile::TempPath;

/// A file that gives its points in tables of a few.
pub(super) trait Source {
    /// The next points, at most so many; none after the last.
    fn piece(&mut self, most: usize) -> Parsed<PointTable>;
}

/// The points of a file in tables of a few, in the file's order, for the [`FORMATS`](super::FORMATS) that have this.
///
/// What [`read`](super::read()) says of a column as a whole, this says of each piece: a column with text in one piece and numbers in the
/// next has a fault in the first alone. A checksum is that of all bytes, so damage is found with the last piece.
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
    reader: Option<Box<dyn Source>>,
    /// The file that is read, where it is a temporary one.
    _spool: Option<Arc<TempPath>>,
}

impl Pieces {
    /// Opens a file to be read at most so many points at a time.
    ///
    /// # Errors
    /// As [`read`](super::read()). An ending that cannot be read piece by piece is [`ReadError::NotInPieces`]. The file must be a
    /// regular one, not a pipe: who reads in pieces reads more than once, or in several places.
    pub fn open(path: &Path, most: usize) -> Result<Self, ReadError> {
        InputFile::from(path).at_hand()?.pieces(most)
    }

    /// Opens a file that is at hand, called `name`, and keeps what it is spooled to.
    pub(in crate::io) fn of(
        file: &InputFile,
        name: &str,
        format: &Format,
        spool: Option<Arc<TempPath>>,
        most: usize,
    ) -> Result<Self, ReadError> {
        let source = name.to_owned();
        let open = format.pieces.ok_or_else(|| ReadError::NotInPieces { file: source.clone() })?;
        let expected = "a regular file is expected, because what is read in pieces is read more than once";
        let opened = refuse_special(&file.path, false, expected).and_then(|()| open(file));
        match opened {
            Ok(reader) => Ok(Self { source, most: most.max(1), reader: Some(reader), _spool: spool }),
            Err(problem) => Err(problem.in_file(&source)),
        }
    }

    fn piece(&mut self) -> Parsed<Option<PointTable>> {
        let Some(reader) = &mut self.reader else { return Ok(None) };
        let table = reader.piece(self.most)?;
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
