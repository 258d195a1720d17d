//! Archives of NumPy arrays, some rows at a time: every array has a reader of its own.

use super::Buffered;
use super::budget::Budget;
use super::npy::Header;
use super::npz::{self, Member, array_name, damaged, is_single, open_archive, unfit};
use super::pieces::Source;
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem};
use crate::io::names::fill_empty_names;
use crate::io::numbers::{Endian, Stored};
use crate::io::position::Place;
use crate::io::steady::Steady;
use crate::io::table::{PointTable, Unusable};
use flate2::{CrcReader, read::DeflateDecoder};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use zip::{CompressionMethod, ZipArchive};

/// An archive whose arrays are read side by side.
struct Archive {
    arrays: Vec<Rows>,
    /// Bytes of the file.
    size: u64,
    /// Points that are still to come.
    left: usize,
    /// The names of the coordinates, if they were named.
    position: Vec<String>,
}

/// An array that is being read.
struct Rows {
    name: String,
    /// The shape of the whole.
    shape: Vec<usize>,
    content: Content,
}

enum Content {
    /// One row a point.
    Rows(Input),
    /// One number for all points.
    Single(f64),
    Unusable(Unusable),
}

struct Input {
    stored: Stored,
    endian: Endian,
    header: Header,
    bytes: CrcReader<Box<dyn Read>>,
    /// The checksum of all bytes.
    checksum: u32,
}

/// Opens an archive to be read some rows at a time.
pub(super) fn pieces(file: &InputFile) -> Parsed<Box<dyn Source>> {
    let (mut archive, budget) = open_archive(&file.path)?;
    let mut arrays = Vec::new();
    for index in 0..archive.len() {
        arrays.extend(Rows::open(&file.path, &mut archive, index)?);
    }
    fill_empty_names(arrays.iter_mut().map(|rows| &mut rows.name).collect());
    let shapes = arrays.iter().map(|rows| (rows.name.as_str(), &rows.shape[..]));
    let place = npz::place(shapes, &file.position)?;
    let coordinates = place.as_ref().map_or(&[][..], Place::arrays);
    let left = coordinates.first().and_then(|&at| arrays[at].shape.first().copied()).unwrap_or(0);
    for (at, rows) in arrays.iter_mut().enumerate() {
        rows.fit(left, coordinates.contains(&at), &budget)?;
    }
    let (size, position) = (file.path.metadata()?.len(), file.position.clone());
    Ok(Box::new(Archive { arrays, left, size, position }))
}

impl Source for Archive {
    fn piece(&mut self, most: usize) -> Parsed<PointTable> {
        let count = self.left.min(most);
        self.left -= count;
        let is_last = self.left == 0;
        // What one piece keeps is gone with the next.
        let budget = Budget::of_file(self.size);
        npz::assemble(
            self.arrays.iter_mut().map(|rows| rows.next(count, is_last, &budget)).collect(),
            &self.position,
            &budget,
        )
    }
}

impl Rows {
    /// Opens the array with this number, `None` if the member is no array.
    fn open(path: &Path, archive: &mut ZipArchive<Buffered>, index: usize) -> Parsed<Option<Self>> {
        let unreadable = |error: String| Problem::new(format!("member {index} of the archive: {error}"));
        let file = archive.by_index(index).map_err(|error| unreadable(error.to_string()))?;
        let name = file.name().map_err(|error| unreadable(error.to_string()))?;
        let Some(name) = array_name(&name) else { return Ok(None) };
        let start = file.data_start().ok_or_else(|| unreadable("it is not said where it is".to_owned()))?;
        let mut packed = Steady(File::open(path)?);
        packed.seek(SeekFrom::Start(start))?;
        let packed = BufReader::with_capacity(1 << 16, packed.take(file.compressed_size()));
        let bytes: Box<dyn Read> = match file.compression() {
            CompressionMethod::Stored => Box::new(packed),
            CompressionMethod::Deflated => Box::new(DeflateDecoder::new(packed)),
            other => {
                let problem = format!("packed by {other}, where stored or deflated is expected");
                return Err(Problem::at(format!("array `{name}`"), problem));
            }
        };
        let mut bytes = CrcReader::new(bytes);
        let (shape, content) = match Header::read(&mut bytes) {
            Ok(header) => (header.shape.clone(), Content::of(header, bytes, file.crc32())),
            Err(problem) => (Vec::new(), Content::Unusable(Unusable::numbers(problem))),
        };
        Ok(Some(Self { name, shape, content }))
    }

    /// Sets aside an array that has not one row for each of `points` points.
    fn fit(&mut self, points: usize, is_coordinate: bool, budget: &Budget) -> Parsed<()> {
        if self.shape.first() == Some(&points) {
            return Ok(());
        }
        let Content::Rows(input) = &mut self.content else { return Ok(()) };
        if is_coordinate {
            return Err(Problem::at(format!("array `{}`", self.name), unfit(&self.shape, points)));
        }
        self.content = if is_single(&self.name, &self.shape, points) {
            match input.next(1, true, budget) {
                Ok(values) => Content::Single(values[0]),
                Err(problem) => Content::Unusable(Unusable::numbers(problem)),
            }
        } else {
            Content::Unusable(Unusable::other(unfit(&self.shape, points)))
        };
        Ok(())
    }

    /// The next rows. After the last, the bytes must be those that the archive promised.
    fn next(&mut self, count: usize, is_last: bool, budget: &Budget) -> Member {
        let mut shape = self.shape.clone();
        if let Some(rows) = shape.first_mut() {
            *rows = count;
        }
        let name = self.name.clone();
        let values = match &mut self.content {
            Content::Single(value) => return Member { name, shape: Vec::new(), values: Ok(vec![*value]) },
            Content::Unusable(unusable) => Err(unusable.clone()),
            Content::Rows(input) => input.next(count, is_last, budget).map_err(Unusable::numbers),
        };
        if let Err(unusable) = &values {
            self.content = Content::Unusable(unusable.clone());
        }
        Member { name, shape, values }
    }
}

impl Content {
    fn of(header: Header, bytes: CrcReader<Box<dyn Read>>, checksum: u32) -> Self {
        match header.stored() {
            None => Self::Unusable(Unusable::other(header.refusal())),
            Some(_) if header.fortran_order && header.shape.len() > 1 => Self::Unusable(Unusable::numbers(
                "columns one after the other (fortran_order) cannot be read some rows at a time",
            )),
            Some((stored, endian)) => Self::Rows(Input { stored, endian, header, bytes, checksum }),
        }
    }
}

impl Input {
    fn next(&mut self, count: usize, is_last: bool, budget: &Budget) -> Result<Vec<f64>, String> {
        if let Some(rows) = self.header.shape.first_mut() {
            *rows = count;
        }
        let numbers = self.header.shape.iter().try_fold(1_usize, |all, &length| all.checked_mul(length));
        let size = numbers.and_then(|numbers| self.stored.bytes(numbers)).unwrap_or(usize::MAX);
        budget.unpack(if count == 0 { 0 } else { size })?;
        let mut data = Vec::new();
        (&mut self.bytes).take(size as u64).read_to_end(&mut data).map_err(|error| damaged(&error))?;
        let values = self.header.numbers((self.stored, self.endian), &data, budget)?;
        if is_last {
            let rest =
                std::io::copy(&mut self.bytes, &mut std::io::sink()).map_err(|error| damaged(&error))?;
            if rest > 0 || self.bytes.crc().sum() != self.checksum {
                return Err(format!("{rest} bytes too many, or damaged: the checksum does not fit"));
            }
        }
        Ok(values)
    }
}
