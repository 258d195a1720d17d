//! Particles kept in the order of their cells, and every pair in reach visited once: for solvers that move them.
//!
//! Cells have side 1 (the support radius is the unit of length) and number [0, n) along each axis, the first fastest. Sorted
//! particles need no list of indices: cell c holds `starts[c]..ends[c]`, and a row of cells along the first axis is one run.

use super::Index;
use crate::{Error, Parameter};

/// Where each cell's particles start and end, in borrowed memory, in at most three dimensions.
#[derive(Debug)]
pub struct CellOrder<'a, I, const D: usize> {
    counts: [usize; D],
    starts: &'a mut [I],
    ends: &'a mut [I],
}

/// Runs ahead of a particle in three dimensions: the rest of its row and the next, and three rows of the next layer.
const MOST_RUNS: usize = 5;

impl<'a, I: Index, const D: usize> CellOrder<'a, I, D> {
    const RUNS: usize = match D {
        1 => 1,
        2 => 2,
        3 => MOST_RUNS,
        _ => panic!("one, two or three dimensions"),
    };

    /// `counts` cells along the axes, of which nothing is known before [`sort`](Self::sort); an element of either slice for each.
    ///
    /// # Errors
    /// [`Error::CapacityExceeded`] where a slice is shorter than there are cells.
    #[inline(always)]
    pub fn new(counts: [usize; D], starts: &'a mut [I], ends: &'a mut [I]) -> Result<Self, Error> {
        let needed = counts.iter().fold(1_usize, |product, &count| product.saturating_mul(count));
        let capacity = starts.len().min(ends.len());
        let full = Error::CapacityExceeded { parameter: Parameter::Cells, capacity, needed };
        let starts = starts.get_mut(..needed).ok_or(full)?;
        let ends = ends.get_mut(..needed).ok_or(full)?;
        Ok(Self { counts, starts, ends })
    }

    /// The number of the cell with these coordinates, each held in range.
    #[inline(always)]
    pub fn cell_of(&self, coordinates: [i32; D]) -> usize {
        let mut cell = 0_usize;
        for axis in (0..D).rev() {
            let count = self.counts[axis];
            let along = (coordinates[axis].max(0) as usize).min(count.saturating_sub(1));
            cell = cell.wrapping_mul(count).wrapping_add(along);
        }
        cell
    }

    /// Sorts the particles in place by counting; `cell_of` gives the number of a cell that there is.
    ///
    /// The new order follows from the old one alone. Each particle is moved at most once, behind a swap at most twice.
    #[inline(always)]
    pub fn sort<P: Copy>(&mut self, particles: &mut [P], cell_of: impl Fn(&P) -> usize) {
        self.ends.fill(I::ZERO);
        for particle in particles.iter() {
            let cell = cell_of(particle);
            if let Some(count) = self.ends.get_mut(cell) {
                *count = I::from_usize(count.to_usize().wrapping_add(1));
            }
        }
        let mut total = 0_usize;
        for (start, end) in self.starts.iter_mut().zip(self.ends.iter_mut()) {
            *start = I::from_usize(total);
            total = total.wrapping_add(end.to_usize());
            *end = *start;
        }
        // Cell by cell: what lies at the next place of its own cell stays, anything else goes to the next place of its.
        for cell in 0..self.ends.len() {
            let full = self.starts.get(cell.wrapping_add(1)).map_or(total, |start| start.to_usize());
            while let Some(here) = self.ends.get(cell).map(|end| end.to_usize()).filter(|&here| here < full) {
                let Some(particle) = particles.get(here) else { return };
                let home = cell_of(particle);
                let Some(end) = self.ends.get_mut(home) else { return };
                let there = end.to_usize();
                *end = I::from_usize(there.wrapping_add(1));
                if home != cell
                    && let Ok([one, other]) = particles.get_disjoint_mut([here, there])
                {
                    exchange(one, other);
                }
            }
        }
    }

    /// Visits the particles in order: sums that are `empty`, every particle ahead in touching cells, then `finish`.
    ///
    /// `near` says whether two are in reach, and what of, which `pair` then receives. When `finish` is called for a particle, all
    /// its pairs have been visited: those with particles before it by them. It receives a mask for [`revisit`](Self::revisit), bit k for
    /// the k-th particle ahead, all bits where there are more than 31.
    #[inline(always)]
    pub fn sweep<P: Copy, A: Copy, X>(
        &self,
        particles: &mut [P],
        empty: A,
        near: impl Fn(&P, &P) -> Option<X>,
        pair: impl Fn(&P, &mut A, &mut P, X),
        finish: impl Fn(&mut P, A, i32),
    ) {
        self.each(particles, |particle, row, beyond| {
            let this = *particle;
            let mut sums = empty;
            let (mut reach, mut bit) = (0_i32, 1_i32);
            let (mut run, mut later) = (row, beyond.iter_mut());
            loop {
                for other in run.iter_mut() {
                    if let Some(found) = near(&this, other) {
                        reach |= bit;
                        pair(&this, &mut sums, other, found);
                    }
                    bit = bit.wrapping_shl(1);
                }
                let Some(next) = later.next() else { break };
                run = next;
            }
            finish(particle, sums, if bit == 0 { -1 } else { reach });
        });
    }

    /// As [`sweep`](Self::sweep), in the same order, over the pairs that `reach` has a bit for and that are still near.
    #[inline(always)]
    pub fn revisit<P: Copy, A: Copy, X>(
        &self,
        particles: &mut [P],
        empty: A,
        reach: impl Fn(&P) -> i32,
        near: impl Fn(&P, &P) -> Option<X>,
        pair: impl Fn(&P, &mut A, &mut P, X),
        mut finish: impl FnMut(&mut P, A),
    ) {
        self.each(particles, |particle, row, beyond| {
            let this = *particle;
            let (mut sums, mut reach) = (empty, reach(&this));
            let (mut run, mut later) = (row, beyond.iter_mut());
            'all: loop {
                for other in run.iter_mut() {
                    if reach & 1 != 0
                        && let Some(found) = near(&this, other)
                    {
                        pair(&this, &mut sums, other, found);
                    }
                    reach >>= 1; // an arithmetic shift: all bits stay all bits
                    if reach == 0 {
                        break 'all;
                    }
                }
                let Some(next) = later.next() else { break };
                run = next;
            }
            finish(particle, sums);
        });
    }

    /// Each particle with those ahead of it in reach: behind it in its row, and the runs beyond the row, none of them empty.
    #[inline(always)]
    fn each<P>(&self, particles: &mut [P], mut visit: impl FnMut(&mut P, &mut [P], &mut [&mut [P]])) {
        let mut at = [0_usize; D];
        let mut start = 0;
        for (cell, end) in self.ends.iter().enumerate() {
            let end = end.to_usize();
            if start < end {
                let runs = self.ahead(&at, cell);
                let mut rest = particles.get_mut(start..).unwrap_or_default();
                let mut gone = runs[0].1;
                let mut row = take(&mut rest, gone.wrapping_sub(start));
                let mut beyond: [&mut [P]; MOST_RUNS - 1] = Default::default();
                let mut count = 0;
                for (from, to) in runs.into_iter().take(Self::RUNS).skip(1) {
                    if from < to
                        && let Some(slot) = beyond.get_mut(count)
                    {
                        take(&mut rest, from.wrapping_sub(gone));
                        *slot = take(&mut rest, to.wrapping_sub(from));
                        gone = to;
                        count += 1;
                    }
                }
                let beyond = beyond.get_mut(..count).unwrap_or_default();
                for _ in start..end {
                    let Some((particle, behind)) = row.split_first_mut() else { break };
                    visit(particle, behind, beyond);
                    row = behind;
                }
            }
            start = end;
            if !self.advance(&mut at) {
                return;
            }
        }
    }

    /// The runs in reach that lie ahead of the cell with these coordinates and this number.
    #[inline(always)]
    fn ahead(&self, at: &[usize; D], cell: usize) -> [(usize, usize); MOST_RUNS] {
        let right = usize::from(at[0].wrapping_add(1) < self.counts[0]);
        let left = usize::from(at[0] > 0);
        let row = |offset: usize| {
            let middle = cell.wrapping_add(offset);
            self.run(middle.wrapping_sub(left), middle.wrapping_add(right))
        };
        let mut runs = [(0, 0); MOST_RUNS];
        runs[0] = self.run(cell, cell.wrapping_add(right));
        if D > 1 {
            let width = self.counts[0];
            let above = at[1].wrapping_add(1) < self.counts[1];
            if above {
                runs[1] = row(width);
            }
            if D > 2 && at[2].wrapping_add(1) < self.counts[2] {
                let layer = width.wrapping_mul(self.counts[1]);
                if at[1] > 0 {
                    runs[2] = row(layer.wrapping_sub(width));
                }
                runs[3] = row(layer);
                if above {
                    runs[4] = row(layer.wrapping_add(width));
                }
            }
        }
        runs
    }

    /// The particles of the cells `first` to `last`.
    #[inline(always)]
    fn run(&self, first: usize, last: usize) -> (usize, usize) {
        match (self.starts.get(first), self.ends.get(last)) {
            (Some(start), Some(end)) => (start.to_usize(), end.to_usize()),
            _ => (0, 0),
        }
    }

    /// Moves to the coordinates of the next cell; false behind the last.
    #[inline(always)]
    fn advance(&self, at: &mut [usize; D]) -> bool {
        for axis in 0..D {
            at[axis] = at[axis].wrapping_add(1);
            if at[axis] < self.counts[axis] {
                return true;
            }
            at[axis] = 0;
        }
        false
    }
}

/// The first `count` elements, or all there are, which `rest` then lacks.
#[inline(always)]
fn take<'a, P>(rest: &mut &'a mut [P], count: usize) -> &'a mut [P] {
    let all = core::mem::take(rest);
    let (first, behind) = all.split_at_mut(count.min(all.len()));
    *rest = behind;
    first
}

/// The cells along each axis, not the particles in them.
/// Two references in a call of its own are known to be apart; `swap` by indices links a memmove, 1.6 kB on Cortex-M.
#[inline(never)]
fn exchange<P: Copy>(one: &mut P, other: &mut P) {
    (*one, *other) = (*other, *one);
}

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
        let (mut starts, mut ends) = ([9_u16; CELLS], [9; CELLS]);
        let mut order = CellOrder::new(counts, &mut starts, &mut ends).unwrap();
        let mut state = 12345_u32;
        let mut random = |n: usize| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) as usize % n
        };
        let mut particles = [([0_i32; D], 0_usize, 0_usize); 200];
        for (id, particle) in particles.iter_mut().take(points).enumerate() {
            *particle = (core::array::from_fn(|axis| random(counts[axis]) as i32), id, 0);
        }
        let particles = &mut particles[..points];
        let (mut starts, mut ends) = ([0_u16; CELLS], [0; CELLS]);
        let numbers = CellOrder::new(counts, &mut starts, &mut ends).unwrap();
        order.sort(particles, |p| numbers.cell_of(p.0));
        assert!(particles.is_sorted_by_key(|p| order.cell_of(p.0)));
        assert_eq!(particles.iter().map(|p| p.1).sum::<usize>(), points * points.saturating_sub(1) / 2);

        order.sweep(
            particles,
            0,
            |_, _| Some(()),
            |_, seen, other, ()| {
                *seen += 1;
                other.2 += 1;
            },
            |p, seen, _| p.2 += seen,
        );
        for p in particles.iter() {
            let touches =
                |q: &&([i32; D], usize, usize)| (0..D).all(|axis| (p.0[axis] - q.0[axis]).abs() <= 1);
            assert_eq!(p.2 + 1, particles.iter().filter(touches).count(), "{p:?}");
        }
    }

    #[test]
    fn every_pair_of_touching_cells_is_visited_once() {
        check::<1, 9>([9], 40);
        check::<2, 20>([4, 5], 150);
        check::<2, 7>([1, 7], 60);
        check::<3, 64>([4, 3, 5], 200);
        check::<3, 64>([2, 1, 2], 100);
        check::<2, 4>([2, 2], 0);
    }

    #[test]
    fn too_many_cells_are_an_error() {
        let (mut starts, mut ends) = ([0_u8; 500], [0; 499]);
        let parameter = Parameter::Cells;
        let error = Error::CapacityExceeded { parameter, capacity: 499, needed: 600 };
        assert_eq!(CellOrder::new([30, 20], &mut starts, &mut ends).unwrap_err(), error);
        assert!(CellOrder::new([25, 20], &mut starts, &mut ends).is_err());
        assert!(CellOrder::new([usize::MAX, 3], &mut starts, &mut ends).is_err());
        let order = CellOrder::new([24, 20], &mut starts, &mut ends).unwrap();
        assert_eq!(order.cell_of([-7, 90]), 19 * 24);
    }
}
