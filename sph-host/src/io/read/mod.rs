//! The list of formats that are read, and how a file's bytes come in.
//!
//! A format is one module beside this one and one line in [`FORMATS`].

mod appended;
mod bgeo;
pub(super) mod budget;
mod csv;
mod fields;
mod hdf5;
mod hdf5_arrays;
mod hdf5_plain;
mod hdf5_sets;
mod hdf5_units;
mod join;
mod legacy;
mod legacy_arrays;
mod legacy_text;
mod literal;
mod npy;
mod npy_file;
mod npz;
mod npz_rows;
mod packer;
mod parted;
mod pieces;
mod ply;
mod ply_header;
mod records;
mod text_columns;
mod text_numbers;
mod xml;
pub(super) mod xml_arrays;
mod xyz;
mod xz;

use super::error::{Parsed, Problem, ReadError, shown};
use super::input_file::InputFile;
use super::rows::Rows;
use super::steady::Steady;
use super::table::{Array, PointTable};
pub use pieces::Pieces;
use pieces::Source;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Component, Path, PathBuf};

/// A format that is read, chosen by the file's ending.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// The endings with their dots, in small letters.
    pub endings: &'static [&'static str],
    /// What is read, in a few words.
    pub about: &'static str,
    /// What can be said of such a file beyond its name.
    pub takes: Takes,
    read: fn(&InputFile) -> Parsed<PointTable>,
    pieces: Option<OpenPieces>,
}

/// What a file of a format can be asked for, or cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Takes {
    /// Lines before a header to pass over: [`InputFile::skip_lines`].
    Lines,
    /// The name of a group of particles: [`InputFile::group`].
    Groups,
    /// A place in its own folder alone, beside the files that it names: neither packed nor from standard input.
    Folder,
    /// None of these.
    Nothing,
}

/// Opens a file to be read some points at a time.
type OpenPieces = fn(&InputFile) -> Parsed<Box<dyn Source>>;

impl Format {
    /// Whether [`Pieces`] reads this format some points at a time.
    pub fn is_read_in_pieces(&self) -> bool {
        self.pieces.is_some()
    }
}

macro_rules! formats {
    ($($endings:tt $about:literal $takes:ident $read:expr, $pieces:expr;)+) => {
        /// Every format that is read: what [`read`] and [`Pieces`] know.
        ///
        /// | ending | what is read |
        /// |---|---|
        $(#[doc = formats!(@row $endings $about)])+
        pub const FORMATS: &[Format] =
            &[$(Format { endings: &$endings, about: $about, takes: Takes::$takes, read: $read, pieces: $pieces }),+];

        /// The endings of all [`FORMATS`]; they are known in any case of letters.
        pub const ENDINGS: &[&str] = formats!(@endings $($endings)+);
    };
    (@row [$first:literal $(, $other:literal)*] $about:literal) => {
        concat!("| `", $first, "`", $(", `", $other, "`",)* " | ", $about, " |")
    };
    (@endings $([$($ending:literal),+])+) => { &[$($($ending),+),+] };
}

formats! {
    [".csv"] "RFC 4180 with a header, or `;` between cells and decimal commas; `#` comments, blank lines and blanks around cells (not those between quotation marks) are passed over"
        Lines csv::read::<b','>, Some(csv::pieces::<b','>);
    [".tsv"] "the same with tabs between the cells"
        Lines csv::read::<b'\t'>, Some(csv::pieces::<b'\t'>);
    [".vtk"] "VTK's legacy format to version 5.1, ASCII and binary: unstructured grid, polygonal data, structured grid and points"
        Nothing legacy::read, None;
    [".vtu", ".vtp"] "VTK's XML: ASCII, base64 and raw, inline and appended, plain and packed by zlib, LZ4 and LZMA"
        Nothing xml::read, None;
    [".pvtu", ".pvtp"] "VTK's XML that names pieces by paths beside it: `.vtu` and `.vtp`, read one after the other"
        Folder parted::read, None;
    [".npz"] "NumPy's archive: arrays `x`, `y`, `z`, or `pos`, `positions`, `coordinates` of N×D, stored or deflated; a single `mass` or `density` is that of all"
        Nothing npz::read, Some(npz_rows::pieces);
    [".npy"] "a single array of NumPy: records with the fields `x`, `y`, `z`, or `pos`, and others; or positions of N×D alone"
        Nothing npy_file::read, None;
    [".ply"] "the Stanford polygon format, text and binary: the element `vertex` with its scalar properties"
        Nothing ply::read, None;
    [".xyz"] "XYZ of one frame, plain and extended: the columns are what `Properties` says, else `species x y z` and numbers"
        Nothing xyz::read, None;
    [".bgeo"] "Houdini's classic binary geometry of version 5, as Partio writes it: the points and their attributes"
        Nothing bgeo::read, None;
    [".h5", ".hdf5"] "HDF5 of PySPH, Gadget, SWIFT, AREPO and the like: a group with arrays `x`, `y`, `z`, or `Coordinates` or `pos` of N×D"
        Groups hdf5::read, None;
}

/// The endings of the formats that take this.
pub fn endings_that_take(takes: Takes) -> impl Iterator<Item = &'static &'static str> {
    FORMATS.iter().filter(move |format| format.takes == takes).flat_map(|format| format.endings)
}

/// The endings of the formats that are read in pieces.
pub(super) fn endings_in_pieces() -> impl Iterator<Item = &'static &'static str> {
    FORMATS.iter().filter(|format| format.is_read_in_pieces()).flat_map(|format| format.endings)
}

/// The format that the end of a name in small letters names.
pub(super) fn format_of(name: &str) -> Option<&'static Format> {
    let (_, ending) = name.rsplit_once('.')?;
    FORMATS.iter().find(|format| format.endings.iter().any(|known| known[1..] == *ending))
}

/// Reads a particle file by its ending: as [`InputFile::read`], where the name says all.
///
/// # Errors
/// As [`InputFile::read`].
pub fn read(path: &Path) -> Result<PointTable, ReadError> {
    InputFile::from(path).read()
}

/// Reads a file that is at hand.
pub(super) fn whole(format: &Format, file: &InputFile) -> Parsed<PointTable> {
    let table = (format.read)(file)?;
    // formats that have coordinates of their own know nothing of names
    let is_own = matches!(&file.position[..], [name] if name.eq_ignore_ascii_case("Points"));
    if file.position.is_empty() || table.is_placed || is_own {
        Ok(table)
    } else {
        table.placed(&file.position)
    }
}

/// Refuses a device, which may never end, and a pipe unless it may be one. `expected` says what can be read.
pub(super) fn refuse_special(path: &Path, may_be_pipe: bool, expected: &'static str) -> Parsed<()> {
    let kind = path.metadata()?.file_type();
    #[cfg(not(unix))]
    let _ = (kind, may_be_pipe, expected);
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let found = if kind.is_fifo() {
            (!may_be_pipe).then_some("a pipe")
        } else if kind.is_socket() {
            Some("a socket")
        } else {
            (kind.is_char_device() || kind.is_block_device()).then_some("a device")
        };
        if let Some(found) = found {
            return Err(Problem::NotAFile { found, expected });
        }
    }
    Ok(())
}

/// A file behind a buffer.
type Buffered = BufReader<Steady<File>>;

/// The file behind a buffer, of which there is at least one byte. `own` are the first bytes of the format, if it has such.
fn open(path: &Path, own: &[u8]) -> Parsed<Buffered> {
    refuse_special(path, true, "a file is expected")?;
    let mut input = BufReader::with_capacity(1 << 18, Steady(File::open(path)?));
    let start = input.fill_buf()?;
    if start.is_empty() {
        return Err(Problem::new("the file is empty"));
    }
    match foreign(start).filter(|_| own.is_empty() || !start.starts_with(own)) {
        Some(found) => Err(Problem::new(format!("the file is {found}, whatever its ending says"))),
        None => Ok(input),
    }
}

/// The whole file, of which there is at least one byte.
fn bytes(path: &Path) -> Parsed<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path, b"")?.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The path of a file beside one that names it: relative and without `..`, so that it stays in the folder.
pub(super) fn beside(name: &str) -> Result<PathBuf, String> {
    let is_below = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    let path: PathBuf = Path::new(name).components().filter(|part| *part != Component::CurDir).collect();
    if !path.as_os_str().is_empty() && Path::new(name).components().all(is_below) {
        return Ok(path);
    }
    let name = shown(name.as_bytes());
    Err(format!("{name} where a file in the folder of this one is expected: a relative path without `..`"))
}

/// The whole of a text.
pub(super) fn text(path: &Path) -> Parsed<String> {
    String::from_utf8(bytes(path)?).map_err(|_| Problem::new("not UTF-8"))
}

/// What the first bytes of a file say that it is, where no format here starts so.
fn foreign(start: &[u8]) -> Option<&'static str> {
    let known: [(&[u8], &str); 9] = [
        (b"\x1f\x8b", "packed by gzip"),
        (b"BZh91AY&SY", "packed by bzip2"),
        (b"\xfd7zXZ\0", "packed by xz"),
        (b"\x28\xb5\x2f\xfd", "packed by Zstandard"),
        (b"PK\x03\x04", "a ZIP archive (.npz, or a spreadsheet)"),
        (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
        (b"\x93NUMPY", "a single array of NumPy (.npy)"),
        (b"\xff\xfe", "text in UTF-16, not UTF-8"),
        (b"\xfe\xff", "text in UTF-16, not UTF-8"),
    ];
    known.iter().find(|(first, _)| start.starts_with(first)).map(|&(_, what)| what)
}

/// A table of VTK: three coordinates a point, one point after the other.
fn from_vtk(points: &[f64], arrays: Vec<Array>) -> Parsed<PointTable> {
    let axis = |axis: usize| points.iter().skip(axis).step_by(3).copied().collect();
    PointTable::assemble(vec![axis(0), axis(1), axis(2)], arrays, Rows::points())
}
