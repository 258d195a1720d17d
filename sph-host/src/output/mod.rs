//! Results as files: CSV, NumPy archives, VTK files for ParaView, pictures.
//!
//! A [`Table`] is what is written: coordinates, named columns and, where the points are the cell centres of a regular box,
//! the [`Grid`] they come from. A [`Target`] is where it goes; the ending of its path chooses the [`Format`].
//!
//! * **Nothing is half-written.** A file grows in a temporary file beside its target and is then renamed; after
//!   [`cleanup_on_interrupt`] that holds for Ctrl-C too.
//! * **Nothing is lost.** Numbers in text are the shortest that read back to the same bits; binary formats hold the bits.
//! * **Nothing is left to chance.** Equal tables give equal bytes: no time stamps, no random names.
//!
//! ```no_run
//! use sph_host::output::{Column, Precision, Table, Target, write};
//!
//! let table = Table {
//!     coordinates: vec![Column::coordinate(0, vec![0.0, 0.5]), Column::coordinate(1, vec![0.0, 0.0])],
//!     columns: vec![Column::new("density", vec![998.2, f64::NAN])],
//!     grid: None,
//!     precision: Precision::F64,
//!     caption: String::from("cubic-spline, H = 0.1"),
//! };
//! let target = Target::new("density.vtu");
//! target.check(table.grid.is_some())?; // before the work: is the ending known, is the place free and writable?
//! write(&table, &target)?;
//! # Ok::<(), sph_host::output::WriteError>(())
//! ```

mod csv;
mod grid;
mod interrupt;
mod npz;
mod number;
mod png;
mod table;
mod target;
mod vtk_legacy;
mod vtk_xml;

pub use csv::write_csv;
pub use grid::{Grid, GridError};
pub use interrupt::cleanup_on_interrupt;
pub use number::shortest;
pub use png::MOST_IN_PICTURE;
pub use table::{Column, Precision, Role, Table, TableError};
pub use target::{Format, Target, WriteError};

/// Writes a table to a file in the format that the ending of its path names.
///
/// # Errors
///
/// Everything [`Target::check`] reports, an inconsistent table ([`Table::check`]), and failures of the file system.
/// After an error the target is as it was before.
pub fn write(table: &Table, target: &Target) -> Result<(), WriteError> {
    let format = target.check(table.grid.is_some())?;
    table.check()?;
    let picture = match format {
        Format::Png => Some(png::draw(table)?),
        _ => None,
    };
    target.create(|file| match (format, &table.grid, &picture) {
        (Format::Csv, ..) => csv::write_rows(table, file),
        (Format::Npz, ..) => npz::write(table, file),
        (Format::Vtk, ..) => vtk_legacy::write(table, file),
        (Format::Vti, Some(grid), _) => vtk_xml::write_image(table, grid, file),
        (Format::Vti | Format::Vtu, ..) => vtk_xml::write_unstructured(table, file),
        (Format::Png, ..) => picture.as_ref().map_or(Ok(()), |image| image.write_png(file)),
    })
}
