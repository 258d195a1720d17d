//! Particles kept in the order of their cells, and every pair in reach visited once: for solvers that move them.
//!
//! Cells have side 1 (the support radius is the unit of length) and number [0, n) along each axis, the first fastest. Sorted
//! particles need no list of indices: cell c holds those from `starts[c]` to `starts[c + 1]`, and a row of cells along the first
//! axis is one run.

use super::Index;
use crate::{Error, Parameter};

/// Where each cell's particles start, in borrowed memory, in at most three dimensions.
#[derive(Debug)]
pub struct CellOrder<'a, I, const D: usize> {
    counts: [usize; D],
    starts: &'a mut [I],
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
                    let visit = reach & 1 != 0;
                    reach >>= 1; // an arithmetic shift: all bits stay all bits
                    if visit {
                        if let Some(found) = near(&this, other) {
                            pair(&this, &mut sums, other, found);
                        }
                        if reach == 0 {
                            break 'all;
                        }
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
        let (total, width) = (particles.len(), self.counts[0]);
        let (mut at, mut first, mut start) = ([0; D], 0_usize, 0);
        while first < self.starts.len() {
            let next = first.wrapping_add(width);
            let cells = if self.start(next, total) > start { first..next } else { next..next };
            for cell in cells {
                let end = self.start(cell.wrapping_add(1), total);
                if start < end {
                    at[0] = cell.wrapping_sub(first);
                    let runs = self.ahead(&at, cell, total);
                    let mut gone = runs[0].1;
                    let Some((here, mut rest)) = particles.split_at_mut_checked(gone) else { return };
                    let mut line = here.get_mut(start..).unwrap_or_default();
                    let mut beyond: [&mut [P]; MOST_RUNS - 1] = Default::default();
                    let mut count = 0;
                    for (from, to) in runs.into_iter().take(Self::RUNS).skip(1) {
                        if from < to
                            && let Some(slot) = beyond.get_mut(count)
                        {
                            let Some((run, behind)) = rest.split_at_mut_checked(to.wrapping_sub(gone)) else {
                                return;
                            };
                            *slot = run.get_mut(from.wrapping_sub(gone)..).unwrap_or_default();
                            (rest, gone) = (behind, to);
                            count += 1;
                        }
                    }
                    let beyond = beyond.get_mut(..count).unwrap_or_default();
                    let later = line.len().wrapping_sub(end.wrapping_sub(start));
                    while line.len() > later
                        && let Some((particle, ahead)) = core::mem::take(&mut line).split_first_mut()
                    {
                        visit(particle, ahead, beyond);
                        line = ahead;
                    }
                }
                start = end;
            }
            first = next;
            self.advance(&mut at);
        }
    }

    /// The runs in reach that lie ahead of the cell with these coordinates and this number.
    #[inline(always)]
    fn ahead(&self, at: &[usize; D], cell: usize, total: usize) -> [(usize, usize); MOST_RUNS] {
        let right = usize::from(at[0].wrapping_add(1) < self.counts[0]).wrapping_add(1);
        let left = usize::from(at[0] > 0);
        let start = |cell: usize| self.start(cell, total);
        let row = |offset: usize| {
            let middle = cell.wrapping_add(offset);
            (start(middle.wrapping_sub(left)), start(middle.wrapping_add(right)))
        };
        let mut runs = [(0, 0); MOST_RUNS];
        runs[0] = (start(cell), start(cell.wrapping_add(right)));
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
        let mut particles = [([0_i32; D], 0_usize, 0_usize); 200];
        for (id, particle) in particles.iter_mut().take(points).enumerate() {
            *particle = (core::array::from_fn(|axis| random(counts[axis]) as i32), id, 0);
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
