//! VTK's XML formats: `.vtu` (unstructured grid) and `.vti` (image data), arrays inline, base64, zlib-compressed.
//!
//! Source: *VTK File Formats*, "XML File Formats", Kitware. A compressed array is base64 of the header (number of blocks,
//! size of a block, size of the last block if it is partial else 0, compressed size of each block; here 64-bit integers) and then
//! base64 of the compressed blocks on end.

use std::io::{self, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use quick_xml::escape::escape;

use crate::parallel;

use super::parallel::extent;
use super::vtk_legacy::{ImageGeometry, joined};
use super::{Column, Grid, Precision, Table};

/// Bytes of an array that are compressed together.
const BLOCK: usize = 1 << 18;

/// Blocks that are compressed at once, by all threads.
const AT_ONCE: usize = 64;

/// A grid as image data whose points are the cell centres.
pub(super) fn write_image(table: &Table, grid: &Grid, writer: &mut impl Write) -> io::Result<()> {
    let ImageGeometry { origin, spacing, .. } = ImageGeometry::of(grid);
    let extent = extent(grid.extent());
    begin(writer, "ImageData", &table.caption)?;
    let (origin, spacing) = (joined(origin), joined(spacing));
    writeln!(writer, r#"<ImageData WholeExtent="{extent}" Origin="{origin}" Spacing="{spacing}">"#)?;
    writeln!(writer, r#"<Piece Extent="{extent}">"#)?;
    write_point_data(table, writer)?;
    writeln!(writer, "</Piece>\n</ImageData>\n</VTKFile>")
}

/// Points as vertices; a grid's cell centres are joined to lines, quadrilaterals or hexahedra, so that a surface shows.
pub(super) fn write_unstructured(table: &Table, writer: &mut impl Write) -> io::Result<()> {
    let cells = VtkCells::of(table);
    let count = cells.connectivity.len() / cells.corners;
    begin(writer, "UnstructuredGrid", &table.caption)?;
    writeln!(writer, "<UnstructuredGrid>")?;
    writeln!(writer, r#"<Piece NumberOfPoints="{}" NumberOfCells="{count}">"#, table.points())?;
    write_point_data(table, writer)?;
    writeln!(writer, "<Points>")?;
    let positions = table.positions().flatten().flat_map(f64::to_le_bytes);
    write_array(writer, r#"type="Float64" Name="Points" NumberOfComponents="3""#, positions)?;
    writeln!(writer, "</Points>\n<Cells>")?;
    let connectivity = cells.connectivity.iter().copied().flat_map(i64::to_le_bytes);
    write_array(writer, r#"type="Int64" Name="connectivity""#, connectivity)?;
    let offsets = (1..=count).flat_map(|cell| ((cell * cells.corners) as i64).to_le_bytes());
    write_array(writer, r#"type="Int64" Name="offsets""#, offsets)?;
    write_array(writer, r#"type="UInt8" Name="types""#, std::iter::repeat_n(cells.kind, count))?;
    writeln!(writer, "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

fn begin(writer: &mut impl Write, kind: &str, caption: &str) -> io::Result<()> {
    writeln!(writer, r#"<?xml version="1.0"?>"#)?;
    if !caption.is_empty() {
        // Two hyphens end a comment.
        writeln!(writer, "<!-- {} -->", caption.replace("--", "- -").trim_end_matches('-'))?;
    }
    write!(writer, r#"<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64""#)?;
    writeln!(writer, r#" compressor="vtkZLibDataCompressor">"#)
}

fn write_point_data(table: &Table, writer: &mut impl Write) -> io::Result<()> {
    writeln!(writer, "<PointData>")?;
    for Column { name, values, .. } in &table.columns {
        let name = attribute(name);
        match table.precision {
            Precision::F64 => {
                let bytes = values.iter().copied().flat_map(f64::to_le_bytes);
                write_array(writer, &format!(r#"type="Float64" Name="{name}""#), bytes)?;
            }
            Precision::F32 => {
                let bytes = values.iter().flat_map(|&value| (value as f32).to_le_bytes());
                write_array(writer, &format!(r#"type="Float32" Name="{name}""#), bytes)?;
            }
        }
    }
    writeln!(writer, "</PointData>")
}

/// A name as the value of an attribute, where a reader takes a bare line end or tab for a blank.
pub(super) fn attribute(name: &str) -> String {
    escape(name).replace('\t', "&#9;").replace('\n', "&#10;").replace('\r', "&#13;")
}

fn write_array(writer: &mut impl Write, attributes: &str, bytes: impl Iterator<Item = u8>) -> io::Result<()> {
    let mut header = [0_u64; 3].to_vec();
    let mut compressed = Vec::new();
    let mut bytes = bytes.peekable();
    while bytes.peek().is_some() {
        let blocks = (0..AT_ONCE).map_while(|_| {
            let block: Vec<u8> = bytes.by_ref().take(BLOCK).collect();
            (!block.is_empty()).then_some(block)
        });
        for packed in parallel::map(blocks, |_, block| packed(&block)) {
            let (size, packed) = packed?;
            header[0] += 1;
            header[1] = BLOCK as u64;
            header[2] = (size % BLOCK) as u64;
            header.push(packed.len() as u64);
            compressed.extend(packed);
        }
    }
    let header: Vec<u8> = header.into_iter().flat_map(u64::to_le_bytes).collect();
    writeln!(writer, r#"<DataArray {attributes} format="binary">"#)?;
    writer.write_all(STANDARD.encode(header).as_bytes())?;
    writer.write_all(STANDARD.encode(compressed).as_bytes())?;
    writeln!(writer, "\n</DataArray>")
}

/// The size of a block, and the block compressed.
fn packed(block: &[u8]) -> io::Result<(usize, Vec<u8>)> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(block)?;
    Ok((block.len(), encoder.finish()?))
}

/// Cells of one kind over the table's points.
struct VtkCells {
    connectivity: Vec<i64>,
    corners: usize,
    /// VTK's number of the kind: 1 vertex, 3 line, 9 quadrilateral, 12 hexahedron.
    kind: u8,
}

impl VtkCells {
    fn of(table: &Table) -> Self {
        let vertices = || Self { connectivity: (0..table.points() as i64).collect(), corners: 1, kind: 1 };
        let Some(grid) = &table.grid else { return vertices() };
        // The axes along which there are neighbours: (count, step to the next point).
        let mut axes = Vec::new();
        let mut step = 1;
        for &count in grid.counts() {
            if count > 1 {
                axes.push((count, step));
            }
            step *= count;
        }
        let (corners, kind) = match axes.as_slice() {
            [] => return vertices(),
            &[(_, a)] => (vec![0, a], 3),
            &[(_, a), (_, b)] => (vec![0, a, a + b, b], 9),
            &[(_, a), (_, b), (_, c), ..] => (vec![0, a, a + b, b, c, a + c, a + b + c, b + c], 12),
        };
        let is_first_corner =
            |point: &usize| axes.iter().all(|&(count, step)| point / step % count + 1 < count);
        let connectivity = (0..table.points())
            .filter(is_first_corner)
            .flat_map(|point| corners.iter().map(move |offset| (point + offset) as i64))
            .collect();
        Self { connectivity, corners: corners.len(), kind }
    }
}
