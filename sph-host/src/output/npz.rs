//! NumPy's archive: a ZIP file with one `.npy` array a column.

use std::io::{self, Seek, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::{Column, Precision, Table};

/// Numbers that are written together.
const AT_ONCE: usize = 1 << 13;

/// Writes coordinates as float64 and the other columns at the table's precision, stored as `numpy.savez` does, with a fixed time
/// stamp.
pub(super) fn write(table: &Table, writer: impl Write + Seek) -> io::Result<()> {
    let mut archive = ZipWriter::new(writer);
    for column in &table.coordinates {
        write_array(&mut archive, column, Precision::F64)?;
    }
    for column in &table.columns {
        write_array(&mut archive, column, table.precision)?;
    }
    archive.finish()?;
    Ok(())
}

fn write_array(
    archive: &mut ZipWriter<impl Write + Seek>,
    column: &Column,
    precision: Precision,
) -> io::Result<()> {
    const HEADER: u64 = 1 << 16;
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644)
        .large_file(column.values.len() as u64 * 8 + HEADER > u64::from(u32::MAX));
    archive.start_file(format!("{}.npy", column.name), options)?;
    archive.write_all(&header(precision, column.values.len()))?;
    for values in column.values.chunks(AT_ONCE) {
        let bytes: Vec<u8> = match precision {
            Precision::F64 => values.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Precision::F32 => values.iter().flat_map(|&value| (value as f32).to_le_bytes()).collect(),
        };
        archive.write_all(&bytes)?;
    }
    Ok(())
}

/// What stands before the numbers of a one-dimensional array by NumPy's NEP 1, version 1.0: a magic word, the version, the length
/// of the rest in two bytes, and a Python dictionary, filled up with blanks to a multiple of 64 bytes.
fn header(precision: Precision, count: usize) -> Vec<u8> {
    const BEFORE: usize = 10;
    let descr = match precision {
        Precision::F64 => "<f8",
        Precision::F32 => "<f4",
    };
    let dictionary = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({count},), }}");
    let length = (BEFORE + dictionary.len() + 1).next_multiple_of(64) - BEFORE;
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    header.extend((length as u16).to_le_bytes());
    header.extend(format!("{dictionary:<0$}\n", length - 1).bytes());
    header
}
