//! How the sums come by neighbours.

use crate::{BruteForce, CellGrid, CellLayout, Error, Index, Neighbour, Neighbours, Scalar};

/// The neighbours of each particle.
pub trait Pairs<T, const D: usize> {
    /// Visits every particle within `radius` of particle i, itself included, in an order that is the same every time.
    fn for_each_of(&self, i: usize, radius: T, visit: impl FnMut(Neighbour<T, D>));
}

/// Finds the neighbours of particles that move. Called twice a step, with positions that differ little from call to call.
pub trait Search<T: Scalar, const D: usize> {
    /// The neighbours at one time.
    type Found<'a>: Pairs<T, D>
    where
        Self: 'a;

    /// The neighbours at these positions, the first `fluid` of which are fluid. Of a wall particle, the fluid is enough.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutsideDomain`] for a particle that is nowhere, and what the search itself reports.
    fn find<'a>(
        &'a mut self,
        layout: &CellLayout<T, D>,
        positions: &'a [[T; D]],
        fluid: usize,
    ) -> Result<Self::Found<'a>, Error>;
}

/// Sorts anew into cells every time.
#[derive(Debug)]
pub struct CellStorage<'a, I> {
    /// Cells + 1 indices.
    pub starts: &'a mut [I],
    /// An index for each particle.
    pub entries: &'a mut [I],
}

impl<T: Scalar, I: Index + Sync, const D: usize> Search<T, D> for CellStorage<'_, I> {
    type Found<'a>
        = CellGrid<'a, T, I, D>
    where
        Self: 'a;

    fn find<'a>(
        &'a mut self,
        layout: &CellLayout<T, D>,
        positions: &'a [[T; D]],
        _: usize,
    ) -> Result<CellGrid<'a, T, I, D>, Error> {
        CellGrid::build(*layout, positions, self.starts, self.entries)
    }
}

impl<T: Scalar, I: Index, const D: usize> Pairs<T, D> for CellGrid<'_, T, I, D> {
    #[inline(always)]
    fn for_each_of(&self, i: usize, radius: T, visit: impl FnMut(Neighbour<T, D>)) {
        if let Some(x) = self.positions().get(i) {
            self.for_each(x, radius, visit);
        }
    }
}

impl<T: Scalar, const D: usize> Pairs<T, D> for BruteForce<'_, T, D> {
    fn for_each_of(&self, i: usize, radius: T, visit: impl FnMut(Neighbour<T, D>)) {
        if let Some(x) = self.positions().get(i) {
            self.for_each(x, radius, visit);
        }
    }
}
