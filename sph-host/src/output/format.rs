//! The list of formats that are written.
//!
//! A format is one module beside this one and one line in [`FORMATS`].

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use super::{Surface, Table, csv, npz, obj, ply, png, vtk_legacy, vtk_xml, xyz};
use crate::picture::PictureError;

/// Where a format's function writes to.
pub(super) type Output<'a> = BufWriter<&'a mut File>;

/// Why a format's function did not write.
pub(super) enum Unwritten {
    Io(io::Error),
    Picture(PictureError),
    /// What cannot be written so.
    Unfit(Content),
}

impl From<io::Error> for Unwritten {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<PictureError> for Unwritten {
    fn from(error: PictureError) -> Self {
        Self::Picture(error)
    }
}

/// What a file can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Points that are no grid.
    Points,
    /// The cell centres of a grid.
    Grid,
    /// The triangles of a surface.
    Surface,
}

/// A format that is written, chosen by the ending of the path in any case of letters.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// The ending with its dot, in small letters.
    pub ending: &'static str,
    /// What is written, in a few words.
    pub about: &'static str,
    /// What can be written so.
    pub holds: &'static [Content],
    /// Whether names of columns stay as they are; else what is no letter of A to Z, digit or `_` becomes `_`.
    pub keeps_names: bool,
    pub(super) write: fn(&Table, &mut Output<'_>) -> Result<(), Unwritten>,
    pub(super) write_surface: fn(&Surface, &mut Output<'_>) -> Result<(), Unwritten>,
}

impl Format {
    /// The format that a path's ending names, if it is known.
    #[must_use]
    pub fn of(path: &Path) -> Option<&'static Self> {
        let ending = format!(".{}", path.extension()?.to_str()?.to_ascii_lowercase());
        FORMATS.iter().find(|format| format.ending == ending)
    }
}

/// Formats that hold no surface.
fn no_surface(_: &Surface, _: &mut Output<'_>) -> Result<(), Unwritten> {
    Err(Unwritten::Unfit(Content::Surface))
}

/// The function that writes surfaces, where there is one.
macro_rules! of_surfaces {
    () => {
        no_surface
    };
    ($write:expr) => {
        $write
    };
}

macro_rules! formats {
    ($($ending:literal $about:literal [$($content:ident)+] $keeps_names:literal $write:expr $(, surface $surface:expr)?;)+) => {
        /// Every format that is written.
        ///
        /// | ending | what is written |
        /// |---|---|
        $(#[doc = concat!("| `", $ending, "` | ", $about, " |")])+
        pub const FORMATS: &[Format] = &[$(Format {
            ending: $ending,
            about: $about,
            holds: &[$(Content::$content),+],
            keeps_names: $keeps_names,
            write: $write,
            write_surface: of_surfaces!($($surface)?),
        }),+];

        /// The endings of all [`FORMATS`].
        pub const ENDINGS: &[&str] = &[$($ending),+];
    };
}

formats! {
    ".csv" "RFC 4180 with a header" [Points Grid] true
        |table, output| Ok(csv::write_rows(table, b',', output)?);
    ".tsv" "the same with tabs between the cells" [Points Grid] true
        |table, output| Ok(csv::write_rows(table, b'\t', output)?);
    ".npz" "NumPy's archive, one array a column" [Points Grid] true
        |table, output| Ok(npz::write(table, output)?);
    ".vtk" "VTK's legacy format, binary: a grid is `STRUCTURED_POINTS`, points are vertices" [Points Grid] true
        |table, output| Ok(vtk_legacy::write(table, output)?);
    ".vtu" "VTK's XML: vertices, or a grid's cell centres joined by lines, quadrilaterals or hexahedra" [Points Grid] true
        |table, output| Ok(vtk_xml::write_unstructured(table, output)?);
    ".vti" "VTK's XML: image data of a grid" [Grid] true
        |table, output| Ok(vtk_xml::write_image(table, table.grid.as_ref().ok_or(Unwritten::Unfit(Content::Points))?, output)?);
    ".png" "a picture of a grid" [Grid] true
        |table, output| Ok(png::draw(table)?.write_png(output)?);
    ".xyz" "extended XYZ: points, or a grid's cell centres, as atoms of species X with a property for each column" [Points Grid] false
        |table, output| Ok(xyz::write(table, output)?);
    ".ply" "binary PLY: points as vertices, or the triangles of a surface" [Points Surface] false
        |table, output| Ok(ply::write_points(table, output)?),
        surface |surface, output| Ok(ply::write_surface(surface, output)?);
    ".obj" "Wavefront OBJ: the triangles of a surface" [Surface] false
        |table, _| Err(Unwritten::Unfit(table.content())),
        surface |surface, output| Ok(obj::write(surface, output)?);
}
