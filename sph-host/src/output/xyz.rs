//! Extended XYZ: the number of points, a line that says what each has, and a line for each point.
//!
//! Source: the extended XYZ specification, libAtoms, <https://github.com/libAtoms/extxyz>.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::names::plain_names;
use super::number::format_into;
use super::{Precision, Table};

/// Names that the format takes itself.
const TAKEN: [&str; 2] = ["species", "pos"];

/// Writes the table: every point is an atom of species X, with three coordinates, and a property for each column.
pub(super) fn write(table: &Table, writer: &mut impl Write) -> io::Result<()> {
    let mut properties = String::from("species:S:1:pos:R:3");
    for name in plain_names(&table.columns, &TAKEN) {
        // Writing to a string cannot fail.
        let _ = write!(properties, ":{name}:R:1");
    }
    write!(writer, "{}\nProperties={properties}\n", table.points())?;
    let mut buffer = zmij::Buffer::new();
    for (point, position) in table.positions().enumerate() {
        writer.write_all(b"X")?;
        for coordinate in position {
            write!(writer, " {}", number(&mut buffer, coordinate, Precision::F64))?;
        }
        for column in &table.columns {
            write!(writer, " {}", number(&mut buffer, column.values[point], table.precision))?;
        }
        writer.write_all(b"\n")?;
    }
    Ok(())
}

/// A number that reads back to the same bits; a cell cannot be empty here.
fn number(buffer: &mut zmij::Buffer, value: f64, precision: Precision) -> &str {
    if value.is_nan() { "nan" } else { format_into(buffer, value, precision) }
}
