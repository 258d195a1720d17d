//! The particles in reach of a point, moved together: sixteen candidates at a time.

use super::cells::{MOST_RUNS, Run};
use super::set::Cells;
use super::simd::{BLOCK, Isa, Job, Real};
use super::sort::Sorted;

/// What was found about one point. The lists are longer than what was found: the rest is left over.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found<T> {
    /// r², below h².
    pub(crate) squares: Vec<T>,
    /// The particles' places in the order of the cells, where they were asked for.
    pub(crate) places: Vec<u32>,
}

impl<T: Real> Found<T> {
    /// Room for so many.
    #[inline(always)]
    fn reserve<const SQUARES: bool, const PLACES: bool>(&mut self, room: usize) {
        if (SQUARES && self.squares.len() < room) || (PLACES && self.places.len() < room) {
            self.grow::<SQUARES, PLACES>(2 * room);
        }
    }

    #[cold]
    fn grow<const SQUARES: bool, const PLACES: bool>(&mut self, room: usize) {
        if SQUARES {
            self.squares.resize(room, T::ZERO);
        }
        if PLACES {
            self.places.resize(room, 0);
        }
    }

    /// Lists the same place again and again.
    #[inline(always)]
    pub(crate) fn fill_places(&mut self, range: std::ops::Range<usize>, place: u32) {
        self.reserve::<false, true>(range.end);
        self.places[range].fill(place);
    }

    /// Fills the lists up to a whole block with numbers beyond any support; returns where they end then.
    #[inline(always)]
    fn pad(&mut self, end: usize) -> usize {
        self.reserve::<true, true>(end + BLOCK);
        if let Some(rest) = self.squares[end..].first_chunk_mut::<BLOCK>() {
            *rest = [T::MAX; BLOCK];
        }
        end.next_multiple_of(BLOCK)
    }
}

/// The part of the lists that is about one point: whole blocks, of which `count` numbers are particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) start: usize,
    pub(crate) count: usize,
}

impl Span {
    /// The places of its particles in the lists.
    #[inline(always)]
    pub(crate) fn particles(self) -> std::ops::Range<usize> {
        self.start..self.start + self.count
    }

    /// The numbers of its blocks.
    #[inline(always)]
    pub(crate) fn blocks(self) -> std::ops::Range<usize> {
        self.start / BLOCK..self.padded().end / BLOCK
    }

    /// The same with what fills up the last block.
    #[inline(always)]
    pub(crate) fn padded(self) -> std::ops::Range<usize> {
        self.start..self.start + self.count.next_multiple_of(BLOCK)
    }
}

/// Finds what is in reach of some consecutive points of a sorted set, squares and places.
pub(super) struct Collect<'a, T, const D: usize> {
    pub(super) cells: &'a Cells<T, D>,
    pub(super) own_limits: Option<&'a [T]>,
    pub(super) points: &'a Sorted<T, D>,
    pub(super) range: std::ops::Range<usize>,
    pub(super) places: bool,
    pub(super) found: &'a mut Found<T>,
    /// Overwritten: one for each point.
    pub(super) spans: &'a mut Vec<Span>,
}

impl<T: Real, const D: usize> Job<T> for Collect<'_, T, D> {
    /// How long the lists are.
    type Output = usize;

    #[inline(always)]
    fn run<I: Isa<T>, const N: usize>(self, isa: I) -> usize {
        if self.places { self.all::<I, true>(isa) } else { self.all::<I, false>(isa) }
    }
}

impl<T: Real, const D: usize> Collect<'_, T, D> {
    #[inline(always)]
    fn all<I: Isa<T>, const PLACES: bool>(self, isa: I) -> usize {
        self.spans.clear();
        let mut start = 0;
        for place in self.range {
            let x = self.points.position(place);
            let end =
                collect::<T, D, I, true, PLACES>(isa, self.cells, self.own_limits, &x, self.found, start);
            self.spans.push(Span { start, count: end - start });
            start = self.found.pad(end);
        }
        start
    }
}

/// Finds the particles with r² < h² about x, in the order of the cells, and lists them after the first `end` of what was
/// found before; returns how many are listed then. h is the cells' own, or each particle's where `own_limits` has their
/// squares.
#[inline(always)]
pub(crate) fn collect<T: Real, const D: usize, I: Isa<T>, const SQUARES: bool, const PLACES: bool>(
    isa: I,
    cells: &Cells<T, D>,
    own_limits: Option<&[T]>,
    x: &[T; D],
    found: &mut Found<T>,
    mut end: usize,
) -> usize {
    let mut runs = [Run::default(); MOST_RUNS];
    let count = cells.layout.runs(&x.map(|c| c.to_f64()), &mut runs);
    let limit = [cells.radius * cells.radius; BLOCK];
    for run in &runs[..count] {
        let (first, last) = cells.sorted.range(run);
        let size = last - first;
        found.reserve::<SQUARES, PLACES>(end + size + BLOCK);
        let padded = first..first + size.next_multiple_of(BLOCK);
        let axes: [&[[T; BLOCK]]; D] = std::array::from_fn(
            #[inline(always)]
            |axis| cells.sorted.coordinates[axis][padded.clone()].as_chunks().0,
        );
        let own_limits = own_limits.map(|limits| limits[padded].as_chunks::<BLOCK>().0);
        let mut rest = size;
        for block in 0..size.div_ceil(BLOCK) {
            let squares = squares(&axes, block, x);
            let limit = own_limits.map_or(&limit, |limits| &limits[block]);
            let real = if rest < BLOCK { (1 << rest) - 1 } else { 0xffff };
            rest = rest.wrapping_sub(BLOCK);
            let mask = isa.below(&squares, limit) & real;
            if SQUARES && let Some(out) = found.squares[end..].first_chunk_mut() {
                isa.pack(mask, &squares, out);
            }
            if PLACES && let Some(out) = found.places[end..].first_chunk_mut() {
                isa.pack_index(mask, (first + block * BLOCK) as u32, out);
            }
            end += mask.count_ones() as usize;
        }
    }
    end
}

/// r² of sixteen particles, summed axis by axis.
#[inline(always)]
fn squares<T: Real, const D: usize>(axes: &[&[[T; BLOCK]]; D], block: usize, x: &[T; D]) -> [T; BLOCK] {
    let mut sum = [T::ZERO; BLOCK];
    for axis in 0..D {
        let coordinates = &axes[axis][block];
        for k in 0..BLOCK {
            let d = x[axis] - coordinates[k];
            sum[k] = if axis == 0 { d * d } else { sum[k] + d * d };
        }
    }
    sum
}
