//! PLY, binary and little-endian: points as vertices with a property for each column, or the triangles of a surface.
//!
//! Source: G. Turk, *The PLY Polygon File Format*, 1994.

use std::io::{self, Write};

use super::names::{comment, plain_names};
use super::{Precision, Surface, Table};

/// Writes points: coordinates are doubles, columns as precise as the table is.
pub(super) fn write_points(table: &Table, writer: &mut impl Write) -> io::Result<()> {
    begin(writer, &table.caption, table.points())?;
    for axis in ["x", "y", "z"] {
        writeln!(writer, "property double {axis}")?;
    }
    let kind = if table.precision == Precision::F32 { "float" } else { "double" };
    for name in plain_names(&table.columns, &["x", "y", "z"]) {
        writeln!(writer, "property {kind} {name}")?;
    }
    writeln!(writer, "end_header")?;
    for (point, position) in table.positions().enumerate() {
        for coordinate in position {
            writer.write_all(&coordinate.to_le_bytes())?;
        }
        for column in &table.columns {
            let value = column.values[point];
            match table.precision {
                Precision::F64 => writer.write_all(&value.to_le_bytes())?,
                Precision::F32 => writer.write_all(&(value as f32).to_le_bytes())?,
            }
        }
    }
    Ok(())
}

/// Writes a surface: vertices with normals as floats, then triangles.
pub(super) fn write_surface(surface: &Surface, writer: &mut impl Write) -> io::Result<()> {
    let mesh = &surface.mesh;
    begin(writer, &surface.caption, mesh.vertices.len())?;
    for property in ["x", "y", "z", "nx", "ny", "nz"] {
        writeln!(writer, "property float {property}")?;
    }
    writeln!(writer, "element face {}", mesh.triangles.len())?;
    writeln!(writer, "property list uchar int vertex_indices\nend_header")?;
    for vertex in &mesh.vertices {
        for number in vertex.position.into_iter().chain(vertex.normal) {
            let single = number as f32;
            if !single.is_finite() {
                return Err(io::Error::other(format!(
                    "{number:e} is too large for the floats of .ply; .obj holds it"
                )));
            }
            writer.write_all(&single.to_le_bytes())?;
        }
    }
    for triangle in &mesh.triangles {
        writer.write_all(&[3])?;
        for vertex in triangle {
            writer.write_all(&vertex.to_le_bytes())?;
        }
    }
    Ok(())
}

fn begin(writer: &mut impl Write, caption: &str, vertices: usize) -> io::Result<()> {
    write!(writer, "ply\nformat binary_little_endian 1.0\n")?;
    if !caption.is_empty() {
        writeln!(writer, "comment {}", comment(caption))?;
    }
    writeln!(writer, "element vertex {vertices}")
}
