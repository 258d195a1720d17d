//! Wavefront OBJ, text: the triangles of a surface.
//!
//! Source: *Advanced Visualizer Manual*, appendix B1, "Object Files (.obj)", Wavefront Technologies.

use std::io::{self, Write};

use super::names::comment;
use super::number::format_into;
use super::{Precision, Surface};

/// Writes vertices (`v`), their normals (`vn`) and triangles (`f`), whose numbers count from 1.
pub(super) fn write(surface: &Surface, writer: &mut impl Write) -> io::Result<()> {
    let mesh = &surface.mesh;
    writeln!(writer, "# {}", comment(&surface.caption))?;
    for vertex in &mesh.vertices {
        write_vector(writer, "v", vertex.position)?;
    }
    for vertex in &mesh.vertices {
        write_vector(writer, "vn", vertex.normal)?;
    }
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| vertex + 1);
        writeln!(writer, "f {a}//{a} {b}//{b} {c}//{c}")?;
    }
    Ok(())
}

fn write_vector(writer: &mut impl Write, keyword: &str, vector: [f64; 3]) -> io::Result<()> {
    writer.write_all(keyword.as_bytes())?;
    let mut buffer = zmij::Buffer::new();
    for number in vector {
        write!(writer, " {}", format_into(&mut buffer, number, Precision::F64))?;
    }
    writeln!(writer)
}
