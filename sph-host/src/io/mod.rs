//! Particle files: tables of points with named arrays.
//!
//! [`read()`] takes a file by its ending and gives a [`PointTable`]: coordinates in 1 to 3 dimensions and arrays of
//! one or more numbers a point. Nothing here knows what the numbers mean beyond the special names: `x`, `y`, `z` are
//! coordinates, `m` or `mass` the mass, `rho` or `density` the density, in any case of letters.
//!
//! | ending | what is read |
//! |---|---|
//! | `.csv`, `.tsv` | RFC 4180 with a header; `#` comments, blank lines and blanks around cells are passed over |
//! | `.vtk` | VTK's legacy format to version 5.1, ASCII and binary: unstructured grid, polygonal data, structured grid |
//! | `.vtu`, `.vtp` | VTK's XML: ASCII, base64 and raw, inline and appended, plain and zlib |
//! | `.npz` | NumPy: arrays `x`, `y`, `z`, or `pos` of N×D; stored or deflated |
//!
//! [`Pieces`] reads text tables and archives some points at a time, for files larger than memory.
//!
//! What is wrong with an array that nobody uses does no harm: the array carries its [`Fault`], and asking for it by
//! [`PointTable::quantity`] is the error. Whether values are finite or positive is asked when they are used, by
//! [`PointTable::require_finite`] and [`PointTable::require_positive`].
//!
//! No claim of a file (counts, sizes) is believed before the bytes are there: a damaged file is an error, never a
//! panic nor an allocation beyond what the file's own bytes can hold.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let dir = tempfile::tempdir()?;
//! # let path = dir.path().join("drop.csv");
//! std::fs::write(&path, "x,y,rho,velocity_x,velocity_y\n0,0,1000,1,2\n0.1,0,998,3,4\n")?;
//! let table = sph_host::io::read(&path)?;
//! assert_eq!((table.len(), table.dimensions()), (2, 2));
//! let density = table.density()?.ok_or("no density")?;
//! table.require_positive(&density)?;
//! assert_eq!(*table.quantity("velocity")?.values, [1.0, 2.0, 3.0, 4.0]);
//! # Ok(())
//! # }
//! ```

mod error;
mod numbers;
mod quantity;
mod read;
mod table;

pub use error::ReadError;
pub use quantity::Quantity;
pub use read::{ENDINGS, Pieces, read};
pub use table::{Array, Fault, PointTable};
