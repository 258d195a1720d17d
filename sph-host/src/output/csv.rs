//! CSV by RFC 4180, with a header.

use std::io::{self, Write};

use super::number::format_into;
use super::{Precision, Table, TableError};

/// Writes a table as CSV, e.g. to standard output.
///
/// Coordinates are printed as `f64`, values at the table's precision; a NaN is an empty cell. Lines end with a line feed.
///
/// # Errors
///
/// [`TableError`] (as [`io::ErrorKind::InvalidInput`]) and what `writer` reports.
pub fn write_csv(table: &Table, writer: impl Write) -> io::Result<()> {
    table.check().map_err(|error: TableError| io::Error::new(io::ErrorKind::InvalidInput, error))?;
    write_rows(table, writer)
}

/// [`write_csv`] for a table that has been checked.
pub(super) fn write_rows(table: &Table, writer: impl Write) -> io::Result<()> {
    write_records(table, csv::Writer::from_writer(writer)).map_err(|error| match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    })
}

fn write_records(table: &Table, mut csv: csv::Writer<impl Write>) -> csv::Result<()> {
    csv.write_record(table.all_columns().map(|column| column.name.as_bytes()))?;
    let mut buffer = zmij::Buffer::new();
    for point in 0..table.points() {
        for column in &table.coordinates {
            csv.write_field(format_into(&mut buffer, column.values[point], Precision::F64))?;
        }
        for column in &table.columns {
            csv.write_field(format_into(&mut buffer, column.values[point], table.precision))?;
        }
        csv.write_record(None::<&[u8]>)?;
    }
    Ok(csv.flush()?)
}
