//! Neighbours from rows that are kept for several steps: all particles within the support radius and a margin, listed anew when
//! one has moved by half the margin.
//!
//! Where an axis is periodic, particles are sorted into cells every time instead: an image is no particle that a row could name.

use rayon::prelude::*;
use sph_core::fluid::wcsph::{Pairs, Search};
use sph_core::vector::{norm_squared, sub};
use sph_core::{CellGrid, CellLayout, Error, Neighbour, Neighbours, Scalar};

/// The margin over the support radius. Wider, rows last longer and each look at them takes longer.
pub(super) const MARGIN: f64 = 0.12;

/// Particles whose rows are kept together.
const SHARE: usize = 256;

/// Candidates that are looked at together: first all distances, without a branch, then what is near.
const BATCH: usize = 64;

/// Finds neighbours, in the way that suits the domain.
pub(super) struct Finder<T, const D: usize> {
    starts: Vec<u32>,
    entries: Vec<u32>,
    /// None where an axis is periodic.
    rows: Option<Rows<T, D>>,
}

/// Rows of candidates.
struct Rows<T, const D: usize> {
    support: T,
    /// Where the fluid was when the rows were listed; empty when they are to be listed anew. Walls do not move.
    listed_at: Vec<[T; D]>,
    shares: Vec<Share>,
}

/// The rows of [`SHARE`] particles: that of the k-th ends at `ends[k]`.
#[derive(Clone, Debug, Default)]
pub(super) struct Share {
    ends: Vec<u32>,
    candidates: Vec<u32>,
}

/// The neighbours at one time.
pub(super) enum Found<'a, T, const D: usize> {
    Rows { positions: &'a [[T; D]], shares: &'a [Share] },
    Cells(CellGrid<'a, T, u32, D>),
}

impl<T: Scalar, const D: usize> Finder<T, D> {
    /// For so many particles and cells; by rows for a support radius, else by cells alone.
    pub(super) fn new(particles: usize, cells: usize, rows_for: Option<T>) -> Self {
        let rows = |support| Rows { support, listed_at: Vec::new(), shares: Vec::new() };
        Self { starts: vec![0; cells + 1], entries: vec![0; particles], rows: rows_for.map(rows) }
    }

    /// Has rows listed anew: particles have changed places.
    pub(super) fn forget(&mut self) {
        if let Some(rows) = &mut self.rows {
            rows.listed_at.clear();
        }
    }

    /// The numbers of particles in the order of their cells, by number within a cell.
    pub(super) fn order(
        &mut self,
        layout: &CellLayout<T, D>,
        positions: &[[T; D]],
    ) -> Result<Vec<u32>, Error> {
        let grid = CellGrid::build(*layout, positions, &mut self.starts, &mut self.entries)?;
        Ok(grid.entries().to_vec())
    }
}

impl<T: Scalar, const D: usize> Rows<T, D> {
    fn have_lasted(&self, positions: &[[T; D]]) -> bool {
        let most = self.support * T::from_f64(0.499 * MARGIN);
        let near = |(x, at): (&[T; D], &[T; D])| norm_squared(&sub(x, at)) < most * most;
        !self.listed_at.is_empty() && positions.par_iter().zip(&self.listed_at).all(near)
    }

    /// Lists the rows of the fluid, and those of walls that have fluid near: walls see nothing else.
    fn list(&mut self, grid: &CellGrid<T, u32, D>, fluid: usize) {
        let positions = grid.positions();
        let reach = self.support * T::from_f64(1.0 + MARGIN);
        self.shares.resize(positions.len().div_ceil(SHARE), Share::default());
        let wet_from = fluid.div_ceil(SHARE);
        let (of_fluid, of_walls) = self.shares.split_at_mut(wet_from);
        let all = |_: usize, _: usize| true;
        of_fluid.par_iter_mut().enumerate().for_each(|(k, share)| share.list(grid, reach, k, all));
        let mut is_wet = vec![false; positions.len()];
        for &candidate in of_fluid.iter().flat_map(|share| &share.candidates) {
            is_wet[candidate as usize] = true;
        }
        let wet = |i: usize, j: usize| is_wet[i] && j < fluid;
        of_walls.par_iter_mut().enumerate().for_each(|(k, share)| share.list(grid, reach, wet_from + k, wet));
        self.listed_at.clear();
        self.listed_at.extend_from_slice(&positions[..fluid]);
    }
}

impl Share {
    /// Lists the rows of share number k: of particle i all j that `wanted(i, j)`, asked with j = 0 before anything is searched.
    fn list<T: Scalar, const D: usize>(
        &mut self,
        grid: &CellGrid<T, u32, D>,
        reach: T,
        k: usize,
        wanted: impl Fn(usize, usize) -> bool,
    ) {
        self.ends.clear();
        self.candidates.clear();
        for (i, x) in grid.positions().iter().enumerate().skip(k * SHARE).take(SHARE) {
            if wanted(i, 0) {
                grid.for_each(x, reach, |neighbour| {
                    if wanted(i, neighbour.index) {
                        self.candidates.push(neighbour.index as u32);
                    }
                });
            }
            self.ends.push(self.candidates.len() as u32);
        }
    }

    #[inline(always)]
    fn row(&self, i: usize) -> &[u32] {
        let end = |k: usize| self.ends.get(k).map_or(0, |&end| end as usize);
        let first = if i == 0 { 0 } else { end(i - 1) };
        self.candidates.get(first..end(i)).unwrap_or_default()
    }
}

impl<T: Scalar, const D: usize> Search<T, D> for Finder<T, D> {
    type Found<'a>
        = Found<'a, T, D>
    where
        Self: 'a;

    fn find<'a>(
        &'a mut self,
        layout: &CellLayout<T, D>,
        positions: &'a [[T; D]],
        fluid: usize,
    ) -> Result<Found<'a, T, D>, Error> {
        let Some(rows) = &mut self.rows else {
            return Ok(Found::Cells(CellGrid::build(
                *layout,
                positions,
                &mut self.starts,
                &mut self.entries,
            )?));
        };
        if !rows.have_lasted(positions) {
            let grid = CellGrid::build(*layout, positions, &mut self.starts, &mut self.entries)?;
            rows.list(&grid, fluid);
        }
        Ok(Found::Rows { positions, shares: &rows.shares })
    }
}

impl<T: Scalar, const D: usize> Pairs<T, D> for Found<'_, T, D> {
    #[inline(always)]
    fn for_each_of(&self, i: usize, radius: T, mut visit: impl FnMut(Neighbour<T, D>)) {
        match self {
            Self::Cells(grid) => grid.for_each_of(i, radius, visit),
            Self::Rows { positions, shares } => {
                let (Some(x), Some(share)) = (positions.get(i), shares.get(i / SHARE)) else { return };
                let radius_squared = radius * radius;
                let mut near =
                    [Neighbour { index: 0, offset: [T::ZERO; D], distance_squared: T::ZERO }; BATCH];
                for candidates in share.row(i % SHARE).chunks(BATCH) {
                    let mut count = 0;
                    for &index in candidates {
                        let index = index as usize;
                        let Some(position) = positions.get(index) else { continue };
                        let offset = sub(x, position);
                        let distance_squared = norm_squared(&offset);
                        near[count % BATCH] = Neighbour { index, offset, distance_squared };
                        count += usize::from(distance_squared < radius_squared);
                    }
                    near.iter().take(count).for_each(|neighbour| visit(*neighbour));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::setup::{cells, centre, jittered};

    fn found(pairs: &impl Pairs<f64, 2>, i: usize) -> Vec<usize> {
        let mut found = Vec::new();
        pairs.for_each_of(i, 0.25, |neighbour| found.push(neighbour.index));
        found.sort_unstable();
        found
    }

    #[test]
    fn rows_find_what_cells_find_while_particles_move() {
        let mut positions: Vec<[f64; 2]> =
            cells([0; 2], [40, 20]).iter().map(|cell| centre(cell, 0.1)).collect();
        let fluid = 600; // the rest are walls and stand still
        let layout = CellLayout::bounded(&[-1.0; 2], &[5.0, 3.0], [21, 14]).unwrap();
        let mut rows = Finder::new(positions.len(), layout.cells(), Some(0.25));
        let mut cells = Finder::new(positions.len(), layout.cells(), None);
        for step in 0..12 {
            for (i, x) in positions.iter_mut().take(fluid).enumerate() {
                *x = jittered(i + 1000 * step, *x, 0.004);
            }
            let (rows, cells) = (
                rows.find(&layout, &positions, fluid).unwrap(),
                cells.find(&layout, &positions, fluid).unwrap(),
            );
            for i in 0..positions.len() {
                let [found, expected] = [found(&rows, i), found(&cells, i)].map(|mut list| {
                    list.retain(|&j| i < fluid || j < fluid);
                    list
                });
                assert_eq!(found, expected, "particle {i} in step {step}");
            }
        }
        positions[5][0] = f64::NAN;
        assert!(rows.find(&layout, &positions, fluid).is_err());
    }
}
