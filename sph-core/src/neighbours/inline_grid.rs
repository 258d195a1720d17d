//! A cell grid that owns its storage inline: for a `static`, with RAM known when the program is compiled.

use super::cell_grid::{self, CellGrid};
use super::{CellLayout, Index, Space};
use crate::{Error, Scalar};

/// Storage for a [`CellGrid`] of at most STARTS − 1 cells and CAP samples; [`BYTES`](Self::BYTES) says the RAM.
///
/// ```
/// use sph_core::{CellLayout, InlineCellGrid, Neighbours};
/// // 8 × 8 cells, up to 200 samples, one byte an index
/// const RAM: usize = InlineCellGrid::<u8, 65, 200>::BYTES;
/// assert_eq!(RAM, 65 + 200);
///
/// let mut storage = InlineCellGrid::<u8, 65, 200>::new();
/// let layout = CellLayout::unbounded(0.25_f32, [8, 8])?;
/// let positions = [[0.0, 0.0], [-90.0, 4.0]];
/// let grid = storage.build(layout, &positions)?;
/// assert_eq!(grid.count(&[-90.1, 4.0], 0.25), 1);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct InlineCellGrid<I, const STARTS: usize, const CAP: usize> {
    starts: [I; STARTS],
    entries: [I; CAP],
}

impl<I: Index, const STARTS: usize, const CAP: usize> InlineCellGrid<I, STARTS, CAP> {
    /// The bytes of RAM that it takes.
    pub const BYTES: usize = size_of::<Self>();

    /// Empty storage.
    pub const fn new() -> Self {
        Self { starts: [I::ZERO; STARTS], entries: [I::ZERO; CAP] }
    }

    /// Sorts the samples into cells and gives the search over them.
    ///
    /// # Errors
    /// As [`CellGrid::build`].
    pub fn build<'a, T: Scalar, const D: usize, S: Space<T, D>>(
        &'a mut self,
        layout: CellLayout<T, D, S>,
        positions: &'a [[T; D]],
    ) -> Result<CellGrid<'a, T, I, D, S>, Error> {
        cell_grid::sort(&layout, positions, &mut self.starts, &mut self.entries)?;
        Ok(CellGrid::from_sorted(layout, positions, &self.starts, &self.entries))
    }
}

impl<I: Index, const STARTS: usize, const CAP: usize> Default for InlineCellGrid<I, STARTS, CAP> {
    fn default() -> Self {
        Self::new()
    }
}
