//! Particle files: tables of points with named arrays.
//!
//! [`read()`] takes a file by its ending and gives a [`PointTable`]: coordinates in 1 to 3 dimensions and arrays of
//! one or more numbers a point. Nothing here knows what the numbers mean beyond the special names: `x`, `y`, `z` are
//! coordinates, `m` or `mass` the mass, `rho` or `density` the density, in any case of letters. Coordinates are also known as
//! programs call them: `Points:0`, `Points_0`, `pos_x`, `Pos.x` and so on, or an array `pos`, `positions`, `coordinates` of
//! vectors. A unit in brackets behind a name is dropped. [`InputFile`] says what a name does not: which arrays the coordinates
//! are, the format of standard input, lines to skip.
//!
//! A file of HDF5 may hold several sets of particles: [`InputFile::group`] names one. What it says of its units is in
//! [`PointTable::notes`], and is not applied.
//!
//! [`FORMATS`] lists what is read. [`Pieces`] reads some of them a few points at a time, for files larger than memory.
//!
//! What is wrong with an array that nobody uses does no harm: text among the numbers, too few of them, a length that is
//! not that of the points, damage. The array carries its [`Fault`], and asking for it by [`PointTable::quantity`] is the
//! error. Whether values are finite or positive is asked when they are used, by [`PointTable::require_finite`] and
//! [`PointTable::require_positive`]. Checksums (`.npz`, zlib, LZMA) are compared to the last byte; LZ4 in VTK's files has none.
//!
//! NaN and infinity may be spelled as C, C++ and Fortran programs print them (`-nan(ind)`, `1.#INF`). An empty cell of a
//! text table is no value: NaN, and called empty where a number is wanted. An array without any number (text, empty cells,
//! NaN) is not among the [default quantities](PointTable::default_quantities); one with some numbers is, and what is wrong
//! with it is then an error. An array without a name is called `array_` and its position from 0: `array_0`.
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
mod input_file;
mod names;
mod numbers;
mod position;
mod quantity;
mod read;
mod rows;
mod series;
mod steady;
mod table;

pub use error::ReadError;
pub(crate) use error::unknown_ending;
pub(crate) use input_file::AtHand;
pub use input_file::InputFile;
pub(crate) use names::fill_empty_names;
pub use quantity::Quantity;
pub use read::{ENDINGS, FORMATS, Format, Pieces, Takes, endings_that_take, read};
pub use series::{Moment, is_series, read_series};
pub use table::{Array, Fault, PointTable};
