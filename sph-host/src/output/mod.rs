//! Results as files: CSV, NumPy archives, VTK files for ParaView, point sets and surfaces for other programs, pictures.
//!
//! A [`Table`] is what is written: coordinates, named columns and, where the points are the cell centres of a regular box,
//! the [`Grid`] they come from. A [`Surface`] is taken of a table by [`Table::surface`]. A [`Target`] is where it goes; the ending of its path chooses one of the [`FORMATS`].
//!
//! * **No half-written files.** A file is written to a temporary file beside its target and is then renamed; after
//!   [`cleanup_on_interrupt`] that holds for Ctrl-C too.
//! * **No loss.** Numbers in text are the shortest that read back to the same bits; binary formats hold the bits.
//! * **Deterministic.** Equal tables give equal bytes: no time stamps, no random names.
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
//! target.check(table.content())?; // before the work: is the ending known, is the place free and writable?
//! write(&table, &target)?;
//! # Ok::<(), sph_host::output::WriteError>(())
//! ```

mod csv;
mod format;
mod grid;
mod interrupt;
mod names;
mod npz;
mod number;
mod obj;
mod parallel;
mod ply;
mod png;
mod surface;
mod table;
mod target;
mod vtk_legacy;
mod vtk_xml;
mod xyz;

pub use csv::write_csv;
pub use format::{Content, ENDINGS, FORMATS, Format};
pub use grid::{Grid, GridError};
pub use interrupt::cleanup_on_interrupt;
pub(crate) use interrupt::is_unfinished;
pub use number::shortest;
pub use parallel::{joint_path, piece_path, write_collection, write_joint};
pub use png::MOST_IN_PICTURE;
pub use surface::{Surface, SurfaceError, SurfaceWarning};
pub use table::{Column, Precision, Role, Table, TableError};
pub use target::{Target, WriteError};

use std::borrow::Cow;

use crate::io::fill_empty_names;

/// Writes a table to a file in the format that the ending of its path names.
///
/// # Errors
///
/// Everything [`Target::check`] reports, an inconsistent table ([`Table::check`]), and failures of the file system.
/// After an error the target is as it was before.
pub fn write(table: &Table, target: &Target) -> Result<(), WriteError> {
    let format = target.check(table.content())?;
    table.check()?;
    target.create_as(|output| (format.write)(&with_names(table), output))
}

/// Writes a surface to a file in the format that the ending of its path names.
///
/// # Errors
///
/// Everything [`Target::check`] reports, and failures of the file system. After an error the target is as it was before.
pub fn write_surface(surface: &Surface, target: &Target) -> Result<(), WriteError> {
    let format = target.check(Content::Surface)?;
    target.create_as(|output| (format.write_surface)(surface, output))
}

/// The table itself, or one with made-up names where columns have none, as [`io`](crate::io) would give them.
fn with_names(table: &Table) -> Cow<'_, Table> {
    if table.all_columns().all(|column| !column.name.is_empty()) {
        return Cow::Borrowed(table);
    }
    let mut table = table.clone();
    fill_empty_names(table.columns.iter_mut().map(|column| &mut column.name).collect());
    Cow::Owned(table)
}
