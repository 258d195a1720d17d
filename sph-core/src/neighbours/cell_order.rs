//! Particles kept in the order of their cells, and every pair in reach visited once: for solvers that move them.
//!
//! Cells have side 1 (the support radius is the unit of length) and number [0, n) along each axis, the first fastest. Sorted
//! particles need no list of indices: cell c holds those from `starts[c]` to `starts[c + 1]`, and a row of cells along the first
//! axis is one run.

use super::{Index, reach};
use crate::{Error, Parameter};
use core::ops::Range;

/// Where each cell's particles start, in borrowed memory, in at most three dimensions.
#[derive(Debug)]
pub struct CellOrder<'a, I, const D: usize> {
    counts: [usize; D],
    starts: &'a mut [I],
}

impl<'a, I: Index, const D: usize> CellOrder<'a, I, D> {
    /// `counts` cells along the axes, of which nothing is known before [`sort`](Self::sort); an element of the slice for each.
    ///
    /// # Errors
    /// [`Error::CapacityExceeded`] where the slice is shorter than there are cells.
    #[inline(always)]
    pub fn new(counts: [usize; D], starts: &'a mut [I]) -> Result<Self, Error> {
        let needed = counts.iter().fold(1_usize, |product, &count| product.saturating_mul(count));
        let capacity = starts.len();
        let full = Error::CapacityExceeded { parameter: Parameter::Cells, capacity, needed };
        Ok(Self { counts, starts: starts.get_mut(..needed).ok_or(full)? })
    }

    /// Forgets all particles.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.starts.fill(I::ZERO);
    }

    /// Counts a particle in the cell with these coordinates and gives the cell's number; any cell where there is none.
    #[inline(always)]
    pub fn count(&mut self, coordinates: [i32; D]) -> usize {
        let mut cell = 0_usize;
        for axis in (0..D).rev() {
            cell = cell.wrapping_mul(self.counts[axis]).wrapping_add(coordinates[axis] as usize);
        }
        let cell = cell.min(self.starts.len().saturating_sub(1));
        if let Some(count) = self.starts.get_mut(cell) {
            *count = I::from_usize(count.to_usize().wrapping_add(1));
        }
        cell
    }

    /// Sorts the particles in place once each has been counted; `cell_of` gives the number of its cell.
    ///
    /// The new order follows from the old one alone. What lies in its cell already is not moved unless it makes way.
    #[inline(always)]
    pub fn sort<P: Copy>(&mut self, particles: &mut [P], cell_of: impl Fn(&P) -> usize) {
        let mut total = 0_usize;
        for start in self.starts.iter_mut() {
            total = total.wrapping_add(start.to_usize());
            *start = I::from_usize(total);
        }
        // Now each holds its cell's end. It goes down to the start as the cell fills from behind; what lies before `here`, or
        // from its own cell's `start` on, is in place.
        let mut here = 0;
        while let Some(particle) = particles.get(here) {
            let home = cell_of(particle);
            let Some(start) = self.starts.get_mut(home) else { return };
            let Some(there) = start.to_usize().checked_sub(1).filter(|&there| there >= here) else {
                here = here.wrapping_add(1);
                continue;
            };
            *start = I::from_usize(there);
            if particles.get(there).is_some_and(|other| cell_of(other) != home)
                && let Ok([one, other]) = particles.get_disjoint_mut([here, there])
            {
                exchange(one, other);
            }
        }
    }

    /// Visits the particles in order: sums that are `empty`, every particle ahead in touching cells, then `finish`.
    ///
    /// `near` says whether two are in reach, and what of, which `pair` then receives. When `finish` is called for a particle, all
    /// its pairs have been visited: those with particles before it by them. It receives a mask for [`revisit`](Self::revisit), bit k
    /// for the k-th particle ahead, all bits where there are more than 31.
    #[inline(always)]
    pub fn sweep<P: Copy, A: Copy, X>(
        &self,
        particles: &mut [P],
        empty: A,
        near: impl Fn(&P, &P) -> Option<X>,
        pair: impl Fn(&P, &mut A, &mut P, X),
        finish: impl Fn(&mut P, A, u32),
    ) {
        self.each(particles, |particle, row, beyond| {
            let this = *particle;
            let mut sums = empty;
            let (mut reach, mut bit) = (0_u32, 1_u32);
            let (mut run, mut later) = (row, beyond.iter_mut());
            loop {
                for other in run.iter_mut() {
                    if let Some(found) = near(&this, other) {
                        reach |= bit;
                        pair(&this, &mut sums, other, found);
                    }
                    bit <<= 1;
                }
                let Some(next) = later.next() else { break };
                run = next;
            }
            finish(particle, sums, if bit == 0 { u32::MAX } else { reach });
        });
    }

    /// As [`sweep`](Self::sweep), in the same order, over the pairs that `mask` has a bit for and that are still near.
    /// `finish` receives how many particles of the row are behind this one, too.
    #[inline(always)]
    pub fn revisit<P: Copy, A: Copy, X>(
        &self,
        particles: &mut [P],
        empty: A,
        mask: impl Fn(&P) -> u32,
        near: impl Fn(&P, &P) -> Option<X>,
        pair: impl Fn(&P, &mut A, &mut P, X),
        finish: impl Fn(&mut P, A, usize),
    ) {
        self.each(particles, |particle, row, beyond| {
            let this = *particle;
            let behind = row.len();
            let mut sums = empty;
            reach::visit(mask(&this), row, beyond, |other| {
                if let Some(found) = near(&this, other) {
                    pair(&this, &mut sums, other, found);
                }
            });
            finish(particle, sums, behind);
        });
    }

    /// Each particle with those ahead of it in reach: behind it in its row, and the runs beyond the row.
    #[inline(always)]
    fn each<P>(&self, particles: &mut [P], mut visit: impl FnMut(&mut P, &mut [P], &mut [&mut [P]])) {
        let (total, width) = (particles.len(), self.counts[0]);
        let (mut at, mut first, mut start) = ([0; D], 0_usize, 0_usize);
        while first < self.starts.len() {
            let next = first.wrapping_add(width);
            let cells = if self.start(next, total) > start { first..next } else { next..next };
            for cell in cells {
                let end = self.start(cell.wrapping_add(1), total);
                if start < end {
                    let columns =
                        (cell.max(first.wrapping_add(1)).wrapping_sub(1), cell.wrapping_add(2).min(next));
                    let count = end.wrapping_sub(start);
                    let row = start..self.start(columns.1, total);
                    let run = |offset: usize| {
                        let start = |cell: usize| self.start(cell.wrapping_add(offset), total);
                        start(columns.0)..start(columns.1)
                    };
                    if D == 1 {
                        let Some(row) = particles.get_mut(row) else { return };
                        visit_each(row, count, &mut [], &mut visit);
                    } else if D == 2 {
                        let Ok([row, beyond]) = particles.get_disjoint_mut([row, run(width)]) else { return };
                        let some = usize::from(!beyond.is_empty());
                        visit_each(
                            row,
                            count,
                            [beyond, &mut []].get_mut(..some).unwrap_or_default(),
                            &mut visit,
                        );
                    } else {
                        let [beyond, below, level, above] = self.far_runs(&at, run);
                        let runs = [row, beyond, below, level, above];
                        let Ok([row, beyond @ ..]) = particles.get_disjoint_mut(runs) else { return };
                        let mut beyond: [&mut [P]; 4] = beyond;
                        visit_each(row, count, &mut beyond, &mut visit);
                    }
                }
                start = end;
            }
            first = next;
            self.advance(&mut at);
        }
    }

    /// In three dimensions: the runs of the next row and of three rows of the next layer, where there are such.
    #[inline(always)]
    fn far_runs(&self, at: &[usize; D], run: impl Fn(usize) -> Range<usize>) -> [Range<usize>; 4] {
        let (width, layer) = (self.counts[0], self.counts[0].wrapping_mul(self.counts[1]));
        let (below, above) = (at[1] > 0, at[1].wrapping_add(1) < self.counts[1]);
        let if_there = |is_there: bool, offset: usize| if is_there { run(offset) } else { 0..0 };
        [
            if_there(above, width),
            if_there(below, layer.wrapping_sub(width)),
            run(layer),
            if_there(above, layer.wrapping_add(width)),
        ]
    }

    /// The number of a cell's first particle of `total`, which is `total` behind the last cell.
    #[inline(always)]
    fn start(&self, cell: usize, total: usize) -> usize {
        self.starts.get(cell).map_or(total, |start| start.to_usize())
    }

    /// Moves to the next row of cells.
    #[inline(always)]
    fn advance(&self, at: &mut [usize; D]) {
        for axis in 1..D {
            at[axis] = at[axis].wrapping_add(1);
            if at[axis] < self.counts[axis] {
                return;
            }
            at[axis] = 0;
        }
    }
}

/// Visits the first `count` particles of a row, each with those behind it in the row and beyond the row.
#[inline(always)]
fn visit_each<P>(
    row: &mut [P],
    count: usize,
    beyond: &mut [&mut [P]],
    visit: &mut impl FnMut(&mut P, &mut [P], &mut [&mut [P]]),
) {
    let later = row.len().wrapping_sub(count);
    let mut row = row;
    while row.len() > later
        && let Some((particle, ahead)) = core::mem::take(&mut row).split_first_mut()
    {
        visit(particle, ahead, beyond);
        row = ahead;
    }
}

/// Two references in a call of its own are known to be apart; `swap` by indices links a memmove, 1.6 kB on Cortex-M.
#[inline(never)]
fn exchange<P: Copy>(one: &mut P, other: &mut P) {
    (*one, *other) = (*other, *one);
}

/// The cells along each axis, not the particles in them.
#[cfg(feature = "defmt")]
impl<I, const D: usize> defmt::Format for CellOrder<'_, I, D> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "CellOrder of {} cells", self.counts);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sorts points given as cells, then counts every pair of points in cells that touch.
    fn check<const D: usize, const CELLS: usize>(counts: [usize; D], points: usize) {
        let mut starts = [9_u16; CELLS];
        let mut order = CellOrder::new(counts, &mut starts).unwrap();
        let mut state = 12345_u32;
        let mut random = |n: usize| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) as usize % n
        };
        let mut particles = [([0_i32; D], 0_usize, 0_usize, 0_u32); 200];
        for (id, particle) in particles.iter_mut().take(points).enumerate() {
            *particle = (core::array::from_fn(|axis| random(counts[axis]) as i32), id, 0, 0);
        }
        let particles = &mut particles[..points];
        order.clear();
        for particle in particles.iter_mut() {
            particle.2 = order.count(particle.0);
        }
        order.sort(particles, |p| p.2);
        assert!(particles.is_sorted_by_key(|p| p.2));
        particles.iter_mut().for_each(|p| p.2 = 0);
        assert_eq!(particles.iter().map(|p| p.1).sum::<usize>(), points * points.saturating_sub(1) / 2);

        order.sweep(
            particles,
            0,
            |_, _| Some(()),
            |_, seen, other, ()| {
                *seen += 1;
                other.2 += 1;
            },
            |p, seen, reach| (p.2, p.3) = (p.2 + seen, reach),
        );
        for p in particles.iter() {
            let touches =
                |q: &&([i32; D], usize, usize, u32)| (0..D).all(|axis| (p.0[axis] - q.0[axis]).abs() <= 1);
            assert_eq!(p.2 + 1, particles.iter().filter(touches).count(), "{p:?}");
        }
        order.revisit(
            particles,
            0,
            |p| p.3,
            |_, _| Some(()),
            |_, seen, other, ()| {
                *seen += 1;
                other.2 -= 1;
            },
            |p, seen, _| p.2 -= seen,
        );
        assert!(particles.iter().all(|p| p.2 == 0), "visited again: {particles:?}");
    }

    #[test]
    fn every_pair_of_touching_cells_is_visited_once() {
        check::<1, 9>([9], 40);
        check::<1, 2>([2], 200);
        check::<2, 20>([4, 5], 150);
        check::<2, 7>([1, 7], 60);
        check::<3, 64>([4, 3, 5], 200);
        check::<3, 64>([2, 1, 2], 100);
        check::<2, 4>([2, 2], 150);
        check::<2, 4>([2, 2], 0);
    }

    #[test]
    fn too_many_cells_are_an_error() {
        let mut starts = [0_u8; 499];
        let parameter = Parameter::Cells;
        let error = Error::CapacityExceeded { parameter, capacity: 499, needed: 600 };
        assert_eq!(CellOrder::new([30, 20], &mut starts).unwrap_err(), error);
        assert!(CellOrder::new([25, 20], &mut starts).is_err());
        assert!(CellOrder::new([usize::MAX, 3], &mut starts).is_err());
        let mut order = CellOrder::new([24, 20], &mut starts).unwrap();
        assert_eq!([[23, 19], [24, 19], [-7, 90]].map(|at| order.count(at)), [479; 3]);
    }
}
