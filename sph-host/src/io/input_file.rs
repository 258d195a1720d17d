//! A file to be read, and how where its name does not say.

use super::error::{Problem, ReadError};
use super::read::{self, Format, Pieces, Takes};
use super::steady::Steady;
use super::table::PointTable;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::{NamedTempFile, TempPath};

/// A file of points, and what its name does not say of how it is read.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let dir = tempfile::tempdir()?;
/// # let path = dir.path().join("two.csv");
/// std::fs::write(&path, "x,y,old_x,old_y\n0,0,5,5\n1,0,6,5\n")?;
/// let file = sph_host::io::InputFile { position: vec!["old".into()], ..path.into() };
/// assert_eq!(file.read()?.coordinates, [[5.0, 6.0], [5.0, 5.0]]);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct InputFile {
    /// Where it is; `-` is standard input.
    pub path: PathBuf,
    /// An ending without its first dot, such as `csv` or `csv.gz`, where that of the path does not count.
    pub format: Option<String>,
    /// The array of the coordinates, or the column of each axis; none: found by the names that programs give them.
    pub position: Vec<String>,
    /// Lines of a text table before the header that are passed over.
    pub skip_lines: usize,
    /// The set of particles of a file that has several: PySPH's name of the set, such as `fluid`, or the place of the group in the
    /// file, such as `PartType1`; none: `PartType0`, or else the only group with particles.
    pub group: Option<String>,
}

/// A file that formats can open: what is packed is unpacked, and standard input is written, to a temporary file.
#[derive(Clone, Debug)]
pub(crate) struct AtHand {
    file: InputFile,
    /// For messages.
    name: String,
    format: &'static Format,
    /// The temporary file is there as long as this.
    spool: Option<Arc<TempPath>>,
}

impl From<PathBuf> for InputFile {
    fn from(path: PathBuf) -> Self {
        Self { path, ..Self::default() }
    }
}

impl From<&Path> for InputFile {
    fn from(path: &Path) -> Self {
        path.to_owned().into()
    }
}

impl InputFile {
    /// The name for messages.
    pub fn name(&self) -> String {
        if self.is_standard_input() { "standard input".to_owned() } else { self.path.display().to_string() }
    }

    /// Whether this is standard input.
    pub fn is_standard_input(&self) -> bool {
        self.path == Path::new("-")
    }

    /// Reads all points.
    ///
    /// # Errors
    /// [`ReadError::UnknownEnding`] before the file is looked at; [`ReadError::NotAFile`] for a device, and for a pipe where a
    /// format needs more than one pass; [`ReadError::Io`] when the system would not give its bytes; [`ReadError::Position`]
    /// where it is not clear what the coordinates are; [`ReadError::Invalid`] when its content is at fault.
    pub fn read(&self) -> Result<PointTable, ReadError> {
        let AtHand { file, name, format, spool: _spool } = self.at_hand()?;
        match read::whole(format, &file) {
            Ok(table) => Ok(PointTable { source: name, ..table }),
            Err(problem) => Err(problem.in_file(&name)),
        }
    }

    /// The format, and whether the file is packed by gzip.
    ///
    /// # Errors
    /// It is not known, or has not what is asked of it.
    pub(crate) fn known_format(&self) -> Result<(&'static Format, bool), ReadError> {
        let unknown = || match &self.format {
            Some(format) => ReadError::UnknownFormat { format: format.clone() },
            None if self.is_standard_input() => ReadError::NoFormat,
            None => ReadError::UnknownEnding { file: self.name() },
        };
        let ending = match &self.format {
            Some(format) => format!(".{}", format.trim_start_matches('.')),
            // a name that begins with a dot has no ending by it
            None => {
                let name = self.path.file_name().map(|name| name.display().to_string());
                name.unwrap_or_default().trim_start_matches('.').to_owned()
            }
        };
        let ending = ending.to_ascii_lowercase();
        let (inner, is_packed) = match ending.strip_suffix(".gz") {
            Some(inner) => (inner, true),
            None => (ending.as_str(), false),
        };
        let format = read::format_of(inner).ok_or_else(unknown)?;
        let file = self.name();
        if self.group.is_some() && format.takes != Takes::Groups {
            return Err(ReadError::NoGroups { file });
        }
        if self.skip_lines > 0 && format.takes != Takes::Lines {
            return Err(ReadError::NoLines { file });
        }
        if format.takes == Takes::Folder && (is_packed || self.is_standard_input()) {
            return Err(ReadError::NotBeside { file });
        }
        Ok((format, is_packed))
    }

    /// The file as one that formats can open.
    ///
    /// # Errors
    /// Its format is not known, or its bytes cannot be had.
    pub(crate) fn at_hand(&self) -> Result<AtHand, ReadError> {
        let (format, is_packed) = self.known_format()?;
        let (mut file, name) = (self.clone(), self.name());
        let mut spool = None;
        if is_packed || self.is_standard_input() {
            let path = self.spooled(is_packed).map_err(|problem| problem.in_file(&name))?;
            file.path = path.to_path_buf();
            spool = Some(Arc::new(path));
        }
        Ok(AtHand { file, name, format, spool })
    }

    /// The bytes of the file in a temporary one.
    fn spooled(&self, is_packed: bool) -> Result<TempPath, Problem> {
        let no_spool = |error: io::Error| {
            Problem::new(format!("a temporary file in {}: {error}", std::env::temp_dir().display()))
        };
        let mut spool = NamedTempFile::new().map_err(no_spool)?;
        let mut write = |bytes: &[u8]| spool.write_all(bytes).map_err(no_spool);
        if self.is_standard_input() {
            copy(io::stdin().lock(), is_packed, &mut write)?;
        } else {
            read::refuse_special(&self.path, true, "a file is expected")?;
            copy(File::open(&self.path)?, is_packed, &mut write)?;
        }
        Ok(spool.into_temp_path())
    }
}

impl AtHand {
    /// The name for messages.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The points in tables of at most so many.
    ///
    /// # Errors
    /// As [`Pieces::open`].
    pub(crate) fn pieces(&self, most: usize) -> Result<Pieces, ReadError> {
        let Self { file, name, format, spool } = self;
        Pieces::of(file, name, format, spool.clone(), most)
    }
}

/// Hands on all bytes, unpacked where they are packed.
fn copy(
    input: impl Read,
    is_packed: bool,
    write: &mut impl FnMut(&[u8]) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let mut counted = Counted { input: Steady(input), bytes: 0 };
    let mut buffer = vec![0; 1 << 16];
    if !is_packed {
        loop {
            match counted.read(&mut buffer)? {
                0 => return Ok(()),
                bytes => write(&buffer[..bytes])?,
            }
        }
    }
    let mut unpacked = flate2::read::MultiGzDecoder::new(&mut counted);
    let mut total = 0;
    loop {
        let damaged =
            |error: io::Error| Problem::new(format!("not packed by gzip, damaged or cut short: {error}"));
        let bytes = unpacked.read(&mut buffer).map_err(damaged)?;
        if bytes == 0 {
            return Ok(());
        }
        total += bytes as u64;
        if total > (1 << 20) + unpacked.get_ref().bytes.saturating_mul(read::budget::MOST_PACKED) {
            return Err(Problem::new("it unpacks to more than Deflate can pack"));
        }
        write(&buffer[..bytes])?;
    }
}

/// Counts the bytes that are read.
struct Counted<R> {
    input: R,
    bytes: u64,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let bytes = self.input.read(buffer)?;
        self.bytes += bytes as u64;
        Ok(bytes)
    }
}
