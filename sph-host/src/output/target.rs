//! Where a result goes: the path, what its ending means, and writing beside it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::format::{Content, FORMATS, Format, Output, Unwritten};
use super::interrupt::Unfinished;
use super::table::TableError;
use crate::io::unknown_ending;
use crate::picture::PictureError;

/// Why a result was not written. The target is as it was before.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The ending of the path names no format.
    #[error("{}: {}: one of {} is expected", .0.display(), unknown_ending(.0), endings(|_| true))]
    UnknownEnding(PathBuf),
    /// Something that this format does not hold, such as image data of points that are no grid.
    #[error(
        "{}: this ending is for {}, but {}; {}", path.display(), about(path), is_instead(path, *content), holders(*content)
    )]
    Unfit {
        /// The target.
        path: PathBuf,
        /// What was to be written.
        content: Content,
    },
    /// The target exists and may not be replaced.
    #[error("{}: the file exists already and is kept", .0.display())]
    Exists(PathBuf),
    /// The target is a directory.
    #[error("{}: is a directory, expected a file", .0.display())]
    IsDirectory(PathBuf),
    /// The name belongs to a pipe or a device, which must not be replaced by a file.
    #[error(
        "{}: this is a pipe or a device, expected a file or a name that is free; without a name, text goes to standard output",
        .0.display()
    )]
    NotAFile(PathBuf),
    /// The name is a symbolic link to nothing, or to what cannot be reached.
    #[error("{}: this is a symbolic link to nothing, expected a file or a name that is free", .0.display())]
    DanglingLink(PathBuf),
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

fn about(path: &Path) -> &'static str {
    Format::of(path).map_or("something else", |format| format.about)
}

/// What there is instead of what a format holds.
fn is_instead(path: &Path, content: Content) -> &'static str {
    let needs_grid = Format::of(path).is_some_and(|format| format.holds.contains(&Content::Grid));
    match content {
        Content::Surface => "this is a surface",
        Content::Points if needs_grid => "the points are no grid",
        Content::Points => "these are points",
        Content::Grid => "this is a grid without a surface",
    }
}

/// The formats that hold something.
fn holders(content: Content) -> String {
    let what = match content {
        Content::Points => "points",
        Content::Grid => "a grid",
        Content::Surface => "a surface",
    };
    format!("{what} can be written as one of {}", endings(|format| format.holds.contains(&content)))
}

/// The endings of some formats, with commas between.
fn endings(wanted: impl Fn(&Format) -> bool) -> String {
    let formats = FORMATS.iter().filter(|format| wanted(format));
    formats.map(|format| format.ending).collect::<Vec<_>>().join(", ")
}

impl WriteError {
    /// Whether the words of the command line are wrong (exit status 2) rather than files or data (exit status 1).
    #[must_use]
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::UnknownEnding(_) | Self::Unfit { .. })
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

    /// Before the work: is the ending known, can it hold what is coming, is the place free and writable?
    ///
    /// # Errors
    ///
    /// [`WriteError::UnknownEnding`] and [`WriteError::Unfit`] first, for they are seen without looking at any file;
    /// then what [`Target::check_place`] reports.
    pub fn check(&self, content: Content) -> Result<&'static Format, WriteError> {
        let format = Format::of(&self.path).ok_or_else(|| WriteError::UnknownEnding(self.path.clone()))?;
        if !format.holds.contains(&content) {
            return Err(WriteError::Unfit { path: self.path.clone(), content });
        }
        self.check_place()?;
        Ok(format)
    }

    /// Whether a file of any ending could be made here: the directory exists and is writable, nothing is in the way.
    ///
    /// # Errors
    ///
    /// [`WriteError::IsDirectory`], [`WriteError::NotAFile`], [`WriteError::DanglingLink`], [`WriteError::Exists`], [`WriteError::Directory`].
    pub fn check_place(&self) -> Result<(), WriteError> {
        if self.path.is_dir() {
            return Err(WriteError::IsDirectory(self.path.clone()));
        }
        self.refuse_device()?;
        if !self.force && self.path.symlink_metadata().is_ok() {
            return Err(WriteError::Exists(self.path.clone()));
        }
        self.begin().map(drop)
    }

    /// Creates the file: `fill` writes to a temporary file beside it, whose bytes are brought to the disk before it is renamed,
    /// and the folder behind it. So after a failure of power there is the old file or the whole new one.
    ///
    /// # Errors
    ///
    /// What [`Target::check_place`] reports, and what `fill` and the file system report, as [`WriteError::Io`].
    pub fn create(
        &self,
        fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        self.create_as(|output| Ok(fill(output)?))
    }

    /// [`create`](Self::create) where not only writing can fail.
    pub(super) fn create_as(
        &self,
        fill: impl FnOnce(&mut Output<'_>) -> Result<(), Unwritten>,
    ) -> Result<(), WriteError> {
        self.refuse_device()?;
        let failed = |source| WriteError::Io { path: self.path.clone(), source };
        let mut unfinished = self.begin()?;
        let file = unfinished.file().map_err(failed)?;
        let mut writer = BufWriter::with_capacity(1 << 20, file);
        fill(&mut writer).and_then(|()| Ok(writer.flush()?)).map_err(|unwritten| match unwritten {
            Unwritten::Io(source) => failed(source),
            Unwritten::Picture(error) => WriteError::Picture(error),
            Unwritten::Unfit(content) => WriteError::Unfit { path: self.path.clone(), content },
        })?;
        drop(writer);
        unfinished.sync().map_err(failed)?;
        unfinished.finish(&self.real_path(), self.force).map_err(|source| match source.kind() {
            io::ErrorKind::AlreadyExists => WriteError::Exists(self.path.clone()),
            _ => failed(source),
        })
    }

    /// Renaming a file to the name of a pipe, a device or a link to nothing would take it away.
    fn refuse_device(&self) -> Result<(), WriteError> {
        match self.path.metadata() {
            Ok(found) if !found.is_file() && !found.is_dir() => Err(WriteError::NotAFile(self.path.clone())),
            Err(_) if self.force && self.path.is_symlink() => {
                Err(WriteError::DanglingLink(self.path.clone()))
            }
            _ => Ok(()),
        }
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
