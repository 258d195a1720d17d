//! The neighbours of every particle.

use std::ops::Range;

use sph_core::Lane;

use super::blocks::{last_store, reserve, squares};
use super::shared_neighbourhood::SharedNeighbourhood;
use super::simd::{BLOCK, Isa, Job, Real, Register};
use super::sorted_cells::SortedCells;
use crate::parallel;

/// Particles whose lists are in one piece of memory.
const CHUNK: usize = 2048;

/// The neighbours of every particle of some [`SortedCells`], itself included: those with r² < h².
///
/// Particles go by their places in the order of the cells, which [`SortedCells::order`] translates; so do their neighbours, which come
/// in that order too. The lists of 2048 consecutive particles lie in one piece of memory without gaps, as u32; filling the
/// same lists again takes no new memory.
///
/// ```
/// use sph_host::fast::{SortedCells, NeighbourLists};
/// let cells = SortedCells::sort(&[[0.0_f32, 0.0], [5.0, 5.0], [0.5, 0.0]], 1.0)?;
/// let mut lists = NeighbourLists::new();
/// cells.neighbour_lists(&mut lists);
/// assert_eq!(cells.order(), [0, 2, 1]);
/// assert_eq!((lists.of(0), lists.of(1), lists.of(2)), (&[0, 1][..], &[0, 1][..], &[2][..]));
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct NeighbourLists {
    chunks: Vec<Chunk>,
}

/// The lists of consecutive particles.
#[derive(Clone, Debug, Default)]
struct Chunk {
    /// Where each list ends.
    ends: Vec<usize>,
    places: Vec<u32>,
}

impl NeighbourLists {
    /// Lists of no particles.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The neighbours of the particle at a place; none where there is no such particle.
    #[must_use]
    #[inline]
    pub fn of(&self, place: usize) -> &[u32] {
        let Some(chunk) = self.chunks.get(place / CHUNK) else { return &[] };
        let row = place % CHUNK;
        let Some(&end) = chunk.ends.get(row) else { return &[] };
        let first = if row == 0 { 0 } else { chunk.ends[row - 1] };
        &chunk.places[first..end]
    }

    /// How many neighbours all particles have together.
    #[must_use]
    pub fn pairs(&self) -> usize {
        self.chunks.iter().filter_map(|chunk| chunk.ends.last()).sum()
    }
}

impl<T: Real, const D: usize> SortedCells<T, D> {
    /// Lists the neighbours of every particle, in memory that is used again.
    pub fn neighbour_lists(&self, lists: &mut NeighbourLists) {
        lists.chunks.resize_with(self.len().div_ceil(CHUNK), Chunk::default);
        parallel::for_each_with(lists.chunks.iter_mut(), |scratch, number, chunk| {
            let particles = number * CHUNK..self.len().min((number + 1) * CHUNK);
            T::dispatch(self.level, Lists { cells: self, particles, scratch, chunk });
        });
    }
}

/// Memory that is used again: what is in reach of a group, and the lists of its particles one after the other.
#[derive(Clone, Debug)]
struct Scratch<T, const D: usize> {
    shared: SharedNeighbourhood<T, D>,
    places: Vec<u32>,
}

impl<T, const D: usize> Default for Scratch<T, D> {
    fn default() -> Self {
        Self { shared: SharedNeighbourhood::default(), places: Vec::new() }
    }
}

/// The lists of some consecutive particles.
struct Lists<'a, T, const D: usize> {
    cells: &'a SortedCells<T, D>,
    particles: Range<usize>,
    scratch: &'a mut Scratch<T, D>,
    chunk: &'a mut Chunk,
}

impl<T: Real, const D: usize> Job<T> for Lists<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { cells, particles, scratch: Scratch { shared, places: packed }, chunk } = self;
        let limit = I::Reg::splat(cells.radius * cells.radius);
        let width = I::Reg::WIDTH;
        chunk.ends.clear();
        chunk.places.clear();
        let mut rest = particles;
        while !rest.is_empty() {
            let group = SharedNeighbourhood::group(cells, &rest);
            shared.gather(isa, cells, group.clone(), 0);
            let (axes, places) = shared.padded();
            reserve(packed, group.len() * places.len() + BLOCK);
            let out = &mut packed[..];
            let last_store = last_store(out.len(), width);
            let mut end = 0;
            for place in group.clone() {
                let x: [I::Reg; D] = I::splat_vector(&cells.sorted.position(place));
                for (number, places) in places.chunks_exact(width).enumerate() {
                    let squares: I::Reg = squares(
                        &axes,
                        number * width,
                        #[inline(always)]
                        |axis, y| x[axis] - y,
                    );
                    let mask = isa.less_than_mask(squares, limit);
                    assert!(end <= last_store, "room for a register");
                    isa.pack_places(mask, places, &mut out[end..][..width]);
                    end += mask.count_ones() as usize;
                }
                chunk.ends.push(chunk.places.len() + end);
            }
            // appended, so that memory that was never used is not set to zero first
            chunk.places.extend_from_slice(&packed[..end]);
            rest.start = group.end;
        }
    }
}
