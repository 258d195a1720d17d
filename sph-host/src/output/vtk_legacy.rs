//! VTK's legacy format, binary (big-endian): `STRUCTURED_POINTS` for a grid, vertices of an `UNSTRUCTURED_GRID` for points.
//!
//! Source: *VTK File Formats*, "Simple Legacy Formats", Kitware.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::{Grid, Precision, Table, shortest};

/// The longest title that the format allows, without the line's end.
const TITLE: usize = 255;

/// Writes the table.
pub(super) fn write(table: &Table, writer: &mut impl Write) -> io::Result<()> {
    let title: String =
        table.caption.chars().map(|letter| if letter.is_ascii_graphic() { letter } else { ' ' }).collect();
    let title = if title.trim().is_empty() { "fluisim" } else { &title[..title.len().min(TITLE)] };
    write!(writer, "# vtk DataFile Version 3.0\n{title}\nBINARY\n")?;
    match &table.grid {
        Some(grid) => write_image(grid, writer)?,
        None => write_vertices(table, writer)?,
    }
    write!(writer, "POINT_DATA {}\nFIELD FieldData {}\n", table.points(), table.columns.len())?;
    for column in &table.columns {
        let (name, points) = (encoded(&column.name), table.points());
        match table.precision {
            Precision::F64 => writeln!(writer, "{name} 1 {points} double")?,
            Precision::F32 => writeln!(writer, "{name} 1 {points} float")?,
        }
        for &value in &column.values {
            match table.precision {
                Precision::F64 => writer.write_all(&value.to_be_bytes())?,
                Precision::F32 => writer.write_all(&(value as f32).to_be_bytes())?,
            }
        }
        writeln!(writer)?;
    }
    Ok(())
}

/// The values are at the cell centres, so these are the image's points: origin at the first, spacing the size of a cell.
fn write_image(grid: &Grid, writer: &mut impl Write) -> io::Result<()> {
    let image = ImageGeometry::of(grid);
    let [nx, ny, nz] = image.counts;
    write!(writer, "DATASET STRUCTURED_POINTS\nDIMENSIONS {nx} {ny} {nz}\n")?;
    let origin = grid.extent().map(|(first, _)| first);
    let origin = [0, 1, 2].map(|axis| image.origin[axis] + origin[axis] as f64 * image.spacing[axis]);
    write!(writer, "ORIGIN {}\nSPACING {}\n", joined(origin), joined(image.spacing))
}

fn write_vertices(table: &Table, writer: &mut impl Write) -> io::Result<()> {
    let points = i32::try_from(table.points())
        .map_err(|_| io::Error::other("legacy .vtk holds fewer than 2^31 points; .vtu holds more"))?;
    write!(writer, "DATASET UNSTRUCTURED_GRID\nPOINTS {points} double\n")?;
    for coordinate in table.positions().flatten() {
        writer.write_all(&coordinate.to_be_bytes())?;
    }
    write!(writer, "\nCELLS {points} {}\n", 2 * i64::from(points))?;
    for point in 0..points {
        writer.write_all(&1_i32.to_be_bytes())?;
        writer.write_all(&point.to_be_bytes())?;
    }
    write!(writer, "\nCELL_TYPES {points}\n")?;
    for _ in 0..points {
        writer.write_all(&1_i32.to_be_bytes())?;
    }
    writeln!(writer)
}

/// A name as VTK writes it: what is not printable, blanks, quotes and percent signs as `%` and two hexadecimal digits.
fn encoded(name: &str) -> String {
    let mut text = String::new();
    for &byte in name.as_bytes() {
        if byte.is_ascii_graphic() && byte != b'"' && byte != b'%' {
            text.push(char::from(byte));
        } else {
            // Writing to a string cannot fail.
            let _ = write!(text, "%{byte:02X}");
        }
    }
    text
}

/// A grid of cell centres as VTK's image data: always three axes, spacing never zero. The origin is that of the whole, where the grid
/// is part of one.
pub(super) struct ImageGeometry {
    pub(super) counts: [usize; 3],
    pub(super) origin: [f64; 3],
    pub(super) spacing: [f64; 3],
}

impl ImageGeometry {
    /// The geometry of a grid; along axes that it lacks it is one point.
    pub(super) fn of(grid: &Grid) -> Self {
        let mut image = Self { counts: [1; 3], origin: grid.beside(), spacing: [1.0; 3] };
        for (axis, &count) in grid.counts().iter().enumerate() {
            let place = grid.axes()[axis];
            image.counts[place] = count;
            image.origin[place] = grid.whole_centre(axis, 0);
            if grid.spacing(axis) > 0.0 {
                image.spacing[place] = grid.spacing(axis);
            }
        }
        image
    }
}

/// Three numbers with blanks between, each to the bit.
pub(super) fn joined(values: [f64; 3]) -> String {
    values.map(|value| shortest(value, Precision::F64)).join(" ")
}
