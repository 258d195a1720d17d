//! The list of formats that are written.
//!
//! A format is one module beside this one and one line in [`FORMATS`].

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use super::{Table, csv, npz, png, vtk_legacy, vtk_xml};
use crate::picture::PictureError;

/// Where a format's function writes to.
pub(super) type Output<'a> = BufWriter<&'a mut File>;

/// Why a format's function did not write.
pub(super) enum Unwritten {
    Io(io::Error),
    Picture(PictureError),
    /// Only a grid can be written so.
    NoGrid,
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

/// A format that is written, chosen by the ending of the path in any case of letters.
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// The ending with its dot, in small letters.
    pub ending: &'static str,
    /// What is written, in a few words.
    pub about: &'static str,
    /// Whether only a grid can be written so.
    pub needs_grid: bool,
    pub(super) write: fn(&Table, &mut Output<'_>) -> Result<(), Unwritten>,
}

impl Format {
    /// The format that a path's ending names, if it is known.
    #[must_use]
    pub fn of(path: &Path) -> Option<&'static Self> {
        let ending = format!(".{}", path.extension()?.to_str()?.to_ascii_lowercase());
        FORMATS.iter().find(|format| format.ending == ending)
    }
}

macro_rules! formats {
    ($($ending:literal $about:literal $needs_grid:literal $write:expr;)+) => {
        /// Every format that is written.
        ///
        /// | ending | what is written |
        /// |---|---|
        $(#[doc = concat!("| `", $ending, "` | ", $about, " |")])+
        pub const FORMATS: &[Format] =
            &[$(Format { ending: $ending, about: $about, needs_grid: $needs_grid, write: $write }),+];

        /// The endings of all [`FORMATS`].
        pub const ENDINGS: &[&str] = &[$($ending),+];
    };
}

formats! {
    ".csv" "RFC 4180 with a header" false
        |table, output| Ok(csv::write_rows(table, b',', output)?);
    ".tsv" "the same with tabs between the cells" false
        |table, output| Ok(csv::write_rows(table, b'\t', output)?);
    ".npz" "NumPy's archive, one array a column" false
        |table, output| Ok(npz::write(table, output)?);
    ".vtk" "VTK's legacy format, binary: a grid is `STRUCTURED_POINTS`, points are vertices" false
        |table, output| Ok(vtk_legacy::write(table, output)?);
    ".vtu" "VTK's XML: vertices, or a grid's cell centres joined by lines, quadrilaterals or hexahedra" false
        |table, output| Ok(vtk_xml::write_unstructured(table, output)?);
    ".vti" "VTK's XML: image data of a grid" true
        |table, output| Ok(vtk_xml::write_image(table, table.grid.as_ref().ok_or(Unwritten::NoGrid)?, output)?);
    ".png" "a picture of a grid" true
        |table, output| Ok(png::draw(table)?.write_png(output)?);
}
