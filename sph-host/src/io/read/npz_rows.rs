//! Archives of NumPy arrays, some rows at a time: every array has a reader of its own.

use super::npy::Header;
use super::npz::{self, Member, is_axis};
use super::open;
use crate::io::error::{Parsed, Problem};
use crate::io::numbers::{Endian, Stored};
use crate::io::table::PointTable;
use flate2::{CrcReader, read::DeflateDecoder};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use zip::{CompressionMethod, ZipArchive};

/// An archive whose arrays are read side by side.
pub(super) struct Archive {
    arrays: Vec<Rows>,
    /// Points that are still to come.
    left: usize,
}

/// An array on its way in.
struct Rows {
    name: String,
    /// The shape of the whole.
    shape: Vec<usize>,
    /// How to read it; or why it has no row a point, and whether it has numbers at all.
    input: Result<Input, (String, bool)>,
}

struct Input {
    stored: Stored,
    endian: Endian,
    header: Header,
    bytes: CrcReader<Box<dyn Read>>,
    /// The checksum of all bytes.
    checksum: u32,
}

impl Archive {
    pub(super) fn open(path: &Path) -> Parsed<Self> {
        let mut archive = ZipArchive::new(open(path)?)
            .map_err(|error| Problem::new(format!("not an .npz file: {error}")))?;
        let mut arrays = Vec::new();
        for index in 0..archive.len() {
            arrays.extend(Rows::open(path, &mut archive, index)?);
        }
        let first = |name: &str| arrays.iter().find(|rows: &&Rows| rows.name.eq_ignore_ascii_case(name));
        let leader = first("pos").or_else(|| first("x"));
        let left = leader.and_then(|rows| rows.shape.first().copied()).unwrap_or(0);
        for rows in arrays.iter_mut().filter(|rows| rows.shape.first() != Some(&left)) {
            let problem = format!("shape {:?} for {left} points", rows.shape);
            if is_axis(&rows.name) {
                return Err(Problem::at(format!("array `{}`", rows.name), problem));
            }
            if rows.input.is_ok() {
                rows.input = Err((problem, !rows.shape.is_empty()));
            }
        }
        Ok(Self { arrays, left })
    }

    /// The next points, at most so many.
    pub(super) fn piece(&mut self, most: usize) -> Parsed<PointTable> {
        let count = self.left.min(most);
        self.left -= count;
        let is_last = self.left == 0;
        let mut members = Vec::with_capacity(self.arrays.len());
        for rows in &mut self.arrays {
            let at = format!("array `{}`", rows.name);
            members.push(rows.next(count, is_last).map_err(|problem| Problem::at(at, problem))?);
        }
        npz::assemble(members)
    }
}

impl Rows {
    /// Opens the array with this number, `None` if the member is no array.
    fn open(path: &Path, archive: &mut ZipArchive<BufReader<File>>, index: usize) -> Parsed<Option<Self>> {
        let unreadable = |error: String| Problem::new(format!("member {index} of the archive: {error}"));
        let file = archive.by_index(index).map_err(|error| unreadable(error.to_string()))?;
        let name = file.name().map_err(|error| unreadable(error.to_string()))?;
        let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else { return Ok(None) };
        let wrong = |problem: String| Problem::at(format!("array `{name}`"), problem);
        let start =
            file.data_start().ok_or_else(|| wrong("the archive does not say where it is".to_owned()))?;
        let mut packed = File::open(path)?;
        packed.seek(SeekFrom::Start(start))?;
        let packed = BufReader::with_capacity(1 << 16, packed.take(file.compressed_size()));
        let bytes: Box<dyn Read> = match file.compression() {
            CompressionMethod::Stored => Box::new(packed),
            CompressionMethod::Deflated => Box::new(DeflateDecoder::new(packed)),
            other => return Err(wrong(format!("packed by {other}, where stored or deflated is expected"))),
        };
        let mut bytes = CrcReader::new(bytes);
        let header = Header::read(&mut bytes).map_err(wrong)?;
        let (shape, checksum) = (header.shape.clone(), file.crc32());
        let input = match header.stored() {
            None => Err((format!("values of type {} where numbers are expected", header.descr), false)),
            Some(_) if header.fortran_order && shape.len() > 1 => {
                Err(("columns one after the other cannot be read row by row".to_owned(), true))
            }
            Some((stored, endian)) => Ok(Input { stored, endian, header, bytes, checksum }),
        };
        Ok(Some(Self { name, shape, input }))
    }

    /// The next rows. After the last, the bytes must be those that the archive promised.
    fn next(&mut self, count: usize, is_last: bool) -> Result<Member, String> {
        let values = match &mut self.input {
            Err(problem) => Err(problem.clone()),
            Ok(input) => Ok(input.next(count, is_last)?),
        };
        let mut shape = self.shape.clone();
        if let Some(rows) = shape.first_mut() {
            *rows = count;
        }
        Ok(Member { name: self.name.clone(), shape, values })
    }
}

impl Input {
    fn next(&mut self, count: usize, is_last: bool) -> Result<Vec<f64>, String> {
        if let Some(rows) = self.header.shape.first_mut() {
            *rows = count;
        }
        let numbers = self.header.shape.iter().try_fold(1_usize, |all, &length| all.checked_mul(length));
        let size = numbers.and_then(|numbers| self.stored.bytes(numbers)).unwrap_or(usize::MAX);
        let mut data = Vec::new();
        (&mut self.bytes).take(size as u64).read_to_end(&mut data).map_err(|error| error.to_string())?;
        let values = self.header.numbers(self.stored, self.endian, &data)?;
        if is_last {
            let rest =
                std::io::copy(&mut self.bytes, &mut std::io::sink()).map_err(|error| error.to_string())?;
            if rest > 0 || self.bytes.crc().sum() != self.checksum {
                return Err(format!("{rest} bytes too many, or damaged: the checksum does not fit"));
            }
        }
        Ok(values)
    }
}
