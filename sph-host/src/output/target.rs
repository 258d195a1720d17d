//! Where a result goes: the path, what its ending means, and writing beside it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::interrupt::Unfinished;
use super::table::TableError;
use crate::picture::PictureError;

/// A file format, chosen by the ending of the path in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `.csv`: RFC 4180 with a header.
    Csv,
    /// `.npz`: one NumPy array a column.
    Npz,
    /// `.vtk`: legacy binary; a grid is `STRUCTURED_POINTS`, points are vertices.
    Vtk,
    /// `.vtu`: vertices, or a grid's cell centres joined by lines, quadrilaterals or hexahedra.
    Vtu,
    /// `.vti`: image data; needs a grid.
    Vti,
    /// `.png`: a picture; needs a grid.
    Png,
}

impl Format {
    const ALL: [(&'static str, Self); 6] = [
        ("csv", Self::Csv),
        ("npz", Self::Npz),
        ("vtk", Self::Vtk),
        ("vtu", Self::Vtu),
        ("vti", Self::Vti),
        ("png", Self::Png),
    ];

    /// The format that a path's ending names, if it is known.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?;
        Self::ALL.iter().find(|(name, _)| name.eq_ignore_ascii_case(ending)).map(|&(_, format)| format)
    }

    /// Whether only a grid can be written in this format.
    #[must_use]
    pub fn needs_grid(self) -> bool {
        matches!(self, Self::Vti | Self::Png)
    }
}

/// Why a result was not written. The target is as it was before.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The ending of the path names no format.
    #[error("{}: unknown ending, expected .csv, .npz, .vtk, .vtu, .vti or .png", .0.display())]
    UnknownEnding(PathBuf),
    /// A picture or image data of points that are no grid.
    #[error("{}: {} needs --grid; points can be written as .csv, .npz, .vtk or .vtu", .0.display(), what_needs_grid(.0))]
    NeedsGrid(PathBuf),
    /// The target exists and may not be replaced.
    #[error("{}: already exists; use --force to replace it", .0.display())]
    Exists(PathBuf),
    /// The target is a directory.
    #[error("{}: is a directory, expected a file", .0.display())]
    IsDirectory(PathBuf),
    /// No file can be made in the target's directory.
    #[error("{}: cannot write in directory {}: {source}", path.display(), directory.display())]
    Directory {
        /// The target.
        path: PathBuf,
        /// Its directory.
        directory: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Writing failed, e.g. because the disk is full.
    #[error("{}: cannot be written: {source}", path.display())]
    Io {
        /// The target.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The table contradicts itself.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The picture cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
}

fn what_needs_grid(path: &Path) -> &'static str {
    if Format::of(path) == Some(Format::Png) { "a picture" } else { "image data" }
}

impl WriteError {
    /// Whether the words of the command line are wrong (exit status 2) rather than files or data (exit status 1).
    #[must_use]
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::UnknownEnding(_) | Self::NeedsGrid(_))
    }
}

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// The file.
    pub path: PathBuf,
    /// Whether an existing file may be replaced.
    pub force: bool,
}

impl Target {
    /// A target that is not to replace an existing file.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), force: false }
    }

    /// Before the work: is the ending known, can it hold what is coming (`grid`: on a grid), is the place free and writable?
    ///
    /// # Errors
    ///
    /// [`WriteError::UnknownEnding`] and [`WriteError::NeedsGrid`] first, for they are seen without looking at any file;
    /// then what [`Target::check_place`] reports.
    pub fn check(&self, grid: bool) -> Result<Format, WriteError> {
        let format = Format::of(&self.path).ok_or_else(|| WriteError::UnknownEnding(self.path.clone()))?;
        if format.needs_grid() && !grid {
            return Err(WriteError::NeedsGrid(self.path.clone()));
        }
        self.check_place()?;
        Ok(format)
    }

    /// Whether a file of any ending could be made here: the directory exists and is writable, nothing is in the way.
    ///
    /// # Errors
    ///
    /// [`WriteError::IsDirectory`], [`WriteError::Exists`], [`WriteError::Directory`].
    pub fn check_place(&self) -> Result<(), WriteError> {
        if self.path.is_dir() {
            return Err(WriteError::IsDirectory(self.path.clone()));
        }
        if !self.force && self.path.symlink_metadata().is_ok() {
            return Err(WriteError::Exists(self.path.clone()));
        }
        self.begin().map(drop)
    }

    /// Creates the file: `fill` writes to a temporary file beside it, which is then renamed.
    ///
    /// # Errors
    ///
    /// What [`Target::check_place`] reports, and what `fill` and the file system report, as [`WriteError::Io`].
    pub fn create(
        &self,
        fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let failed = |source| WriteError::Io { path: self.path.clone(), source };
        let mut unfinished = self.begin()?;
        let file = unfinished.file().map_err(failed)?;
        let mut writer = BufWriter::with_capacity(1 << 20, file);
        fill(&mut writer).and_then(|()| writer.flush()).map_err(failed)?;
        drop(writer);
        unfinished.finish(&self.real_path(), self.force).map_err(|source| match source.kind() {
            io::ErrorKind::AlreadyExists => WriteError::Exists(self.path.clone()),
            _ => failed(source),
        })
    }

    /// A temporary file beside the target.
    fn begin(&self) -> Result<Unfinished, WriteError> {
        let path = self.real_path();
        let directory = match path.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        Unfinished::begin(directory).map_err(|source| WriteError::Directory {
            path: self.path.clone(),
            directory: directory.to_owned(),
            source,
        })
    }

    /// The file behind a symbolic link, so that replacing it leaves the link in place.
    fn real_path(&self) -> PathBuf {
        if self.path.is_symlink() {
            fs::canonicalize(&self.path).unwrap_or_else(|_| self.path.clone())
        } else {
            self.path.clone()
        }
    }
}
