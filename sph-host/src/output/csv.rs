//! CSV by RFC 4180, with a header; and the same with tabs.

use std::io::{self, Write};

use super::number::format_into;
use super::{Precision, Table, TableError, with_names};

/// Writes a table as CSV, e.g. to standard output.
///
/// Coordinates are printed as `f64`, values at the table's precision; a NaN is an empty cell. Lines end with a line feed.
///
/// # Errors
///
/// [`TableError`] (as [`io::ErrorKind::InvalidInput`]) and what `writer` reports.
pub fn write_csv(table: &Table, writer: impl Write) -> io::Result<()> {
    table.check().map_err(|error: TableError| io::Error::new(io::ErrorKind::InvalidInput, error))?;
    write_rows(&with_names(table), b',', writer)
}

/// Writes a table that has been checked, with `delimiter` between the cells.
pub(super) fn write_rows(table: &Table, delimiter: u8, mut writer: impl Write) -> io::Result<()> {
    let mut builder = csv::WriterBuilder::new();
    builder.delimiter(delimiter);
    // Without quotation marks a reader takes blanks around a name off, and a header of numbers for a row of them.
    let quotes = if table.all_columns().all(|column| is_plain(&column.name)) {
        csv::QuoteStyle::Necessary
    } else {
        csv::QuoteStyle::Always
    };
    let header = builder.quote_style(quotes).from_writer(&mut writer);
    write_header(table, header).map_err(failed)?;
    let rows = builder.quote_style(csv::QuoteStyle::Necessary).from_writer(&mut writer);
    write_records(table, rows).map_err(failed)
}

fn failed(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// Whether a name starts as a word does and has no blanks around.
fn is_plain(name: &str) -> bool {
    name.starts_with(|first: char| first.is_alphabetic() || first == '_') && name.trim() == name
}

fn write_header(table: &Table, mut csv: csv::Writer<impl Write>) -> csv::Result<()> {
    csv.write_record(table.all_columns().map(|column| column.name.as_bytes()))?;
    Ok(csv.flush()?)
}

fn write_records(table: &Table, mut csv: csv::Writer<impl Write>) -> csv::Result<()> {
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
