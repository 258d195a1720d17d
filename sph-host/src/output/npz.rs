//! NumPy's archive: a ZIP file with one `.npy` array a column.

use std::io::{self, Seek, Write};

use npyz::WriterBuilder;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::{Column, Precision, Table};

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
    let shape = [column.values.len() as u64];
    match precision {
        Precision::F64 => {
            let mut array =
                npyz::WriteOptions::new().default_dtype().shape(&shape).writer(archive).begin_nd()?;
            array.extend(column.values.iter().copied())?;
            array.finish()
        }
        Precision::F32 => {
            let mut array =
                npyz::WriteOptions::new().default_dtype().shape(&shape).writer(archive).begin_nd()?;
            array.extend(column.values.iter().map(|&value| value as f32))?;
            array.finish()
        }
    }
}
