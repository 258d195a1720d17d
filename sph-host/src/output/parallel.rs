//! Files that name the pieces of one result: `.pvti` and `.pvtu`, which ParaView opens as one, and `.pvd`, a series in time.
//!
//! Source: *VTK File Formats*, "XML File Formats", Kitware.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::vtk_legacy::{ImageGeometry, joined};
use super::vtk_xml::attribute;
use super::{Precision, Table, Target, WriteError};
use crate::part::Part;

/// Where part of a result goes: `field.vti` becomes `field_2.vti`, with as many digits as the last part has.
#[must_use]
pub fn piece_path(path: &Path, part: Part) -> PathBuf {
    let width = part.of().to_string().len();
    with_stem(path, &format!("_{:0width$}", part.number()))
}

/// The same path with more at the end of the stem.
fn with_stem(path: &Path, more: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().display().to_string();
    let ending = path.extension().map(|ending| format!(".{}", ending.display())).unwrap_or_default();
    path.with_file_name(format!("{stem}{more}{ending}"))
}

/// The file that names the pieces of a result at this path; none where its format has none.
#[must_use]
pub fn joint_path(path: &Path) -> Option<PathBuf> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    matches!(&*ending, "vti" | "vtu").then(|| path.with_extension(format!("p{ending}")))
}

/// Writes the file that names the pieces of a result, of which `table` is one.
///
/// # Errors
/// What [`Target::create`] reports.
pub fn write_joint(table: &Table, target: &Target, part: Part, piece_at: &Path) -> Result<(), WriteError> {
    target.create(|writer| {
        let sources: Vec<(Part, String)> =
            part.all().map(|part| (part, file_name(&piece_path(piece_at, part)))).collect();
        match &table.grid {
            Some(grid) if target.path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pvti")) => {
                let ImageGeometry { origin, spacing, .. } = ImageGeometry::of(grid);
                let whole = grid.whole_extent();
                let (origin, spacing) = (joined(origin), joined(spacing));
                begin(writer, "PImageData")?;
                writeln!(
                    writer,
                    r#"<PImageData WholeExtent="{}" GhostLevel="0" Origin="{origin}" Spacing="{spacing}">"#,
                    extent(whole)
                )?;
                point_data(table, writer)?;
                for (part, source) in sources {
                    let piece = grid.piece_extent(part);
                    writeln!(writer, r#"<Piece Extent="{}" Source="{source}"/>"#, extent(piece))?;
                }
                writeln!(writer, "</PImageData>\n</VTKFile>")
            }
            _ => {
                begin(writer, "PUnstructuredGrid")?;
                writeln!(writer, r#"<PUnstructuredGrid GhostLevel="0">"#)?;
                point_data(table, writer)?;
                writeln!(
                    writer,
                    "<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>"
                )?;
                for (_, source) in sources {
                    writeln!(writer, r#"<Piece Source="{source}"/>"#)?;
                }
                writeln!(writer, "</PUnstructuredGrid>\n</VTKFile>")
            }
        }
    })
}

/// Writes a series: the time and the file of each moment, which are beside it.
///
/// # Errors
/// What [`Target::create`] reports.
pub fn write_collection(moments: &[(f64, PathBuf)], target: &Target) -> Result<(), WriteError> {
    target.create(|writer| {
        writeln!(
            writer,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>"
        )?;
        for (time, file) in moments {
            writeln!(writer, r#"<DataSet timestep="{time}" file="{}"/>"#, file_name(file))?;
        }
        writeln!(writer, "</Collection>\n</VTKFile>")
    })
}

fn begin(writer: &mut impl Write, kind: &str) -> io::Result<()> {
    writeln!(writer, r#"<?xml version="1.0"?>"#)?;
    writeln!(
        writer,
        r#"<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#
    )
}

fn point_data(table: &Table, writer: &mut impl Write) -> io::Result<()> {
    let kind = if table.precision == Precision::F32 { "Float32" } else { "Float64" };
    writeln!(writer, "<PPointData>")?;
    for column in &table.columns {
        writeln!(writer, r#"<PDataArray type="{kind}" Name="{}"/>"#, attribute(&column.name))?;
    }
    writeln!(writer, "</PPointData>")
}

/// The name of a file as an attribute that names a file beside this one.
fn file_name(path: &Path) -> String {
    attribute(&path.file_name().unwrap_or_default().display().to_string())
}

/// First and last point along each axis, as an attribute.
pub(super) fn extent(axes: [(usize, usize); 3]) -> String {
    axes.map(|(first, last)| format!("{first} {last}")).join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_beside_each_other() {
        let part = Part::new(2, 12).unwrap();
        assert_eq!(piece_path(Path::new("a/b.c.vti"), part), Path::new("a/b.c_02.vti"));
        assert_eq!(joint_path(Path::new("a/b.VTU")).as_deref(), Some(Path::new("a/b.pvtu")));
        assert_eq!(joint_path(Path::new("a/b.csv")), None);
    }
}
