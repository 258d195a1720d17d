//! What is in reach of a few particles that lie together, copied to one place for all of them.

use std::ops::Range;

use sph_core::Lane;

use super::blocks::{Block, Fronts, candidates, last_store, reserve, sixteen_mut, squares};
use super::simd::{BLOCK, Isa, Real, Register};
use super::sorted_cells::SortedCells;

/// Particles that share a search: with more, fewer of those that are near one of them are near another.
pub(super) const GROUP: usize = 12;

/// The particles in reach of the box of a group. The lists are longer than what was found: the rest is left over.
#[derive(Clone, Debug)]
pub(super) struct SharedNeighbourhood<T, const D: usize> {
    blocks: Vec<Block>,
    /// Axis by axis, and up to a whole block numbers beyond any support.
    coordinates: [Vec<T>; D],
    /// Their places, ascending.
    places: Vec<u32>,
    count: usize,
}

impl<T, const D: usize> Default for SharedNeighbourhood<T, D> {
    fn default() -> Self {
        let coordinates = [const { Vec::new() }; D];
        Self { blocks: Vec::new(), coordinates, places: Vec::new(), count: 0 }
    }
}

impl<T: Real, const D: usize> SharedNeighbourhood<T, D> {
    /// Splits off the first few of some consecutive particles: they are in one row of cells and not far apart.
    #[inline(always)]
    pub(super) fn group(cells: &SortedCells<T, D>, particles: &Range<usize>) -> Range<usize> {
        let first = cells.sorted.position(particles.start);
        let (row, spread) = (cells.layout.row(&first), cells.radius);
        let together = |place: &usize| {
            let x = cells.sorted.position(*place);
            cells.layout.row(&x) == row && x[0] - first[0] < spread
        };
        let last = particles.end.min(particles.start + GROUP);
        let more = (particles.start + 1..last).take_while(together).count();
        particles.start..particles.start + 1 + more
    }

    /// Copies what is in reach of the box of a group, of the particles from a place on.
    #[inline(always)]
    pub(super) fn gather<I: Isa<T>>(
        &mut self,
        isa: I,
        cells: &SortedCells<T, D>,
        group: Range<usize>,
        from: usize,
    ) {
        let axes = cells.sorted.padded();
        let (lower, upper) = cells.corners(group);
        let blocks = candidates(cells, &lower, &upper, from, &mut self.blocks, 0);
        let room = (blocks + 1) * BLOCK;
        reserve(&mut self.places, room);
        self.coordinates.iter_mut().for_each(|axis| reserve(axis, room));
        let mut coordinates = Fronts::new(&mut self.coordinates, room);
        let places = &mut self.places[..room];
        let (lower, upper): ([I::Reg; D], [I::Reg; D]) = (I::splat_vector(&lower), I::splat_vector(&upper));
        let limit = I::Reg::splat(cells.radius * cells.radius);
        let width = I::Reg::WIDTH;
        let last_store = last_store(room, width);
        let mut end = 0;
        for block in &self.blocks[..blocks] {
            let all = block.places();
            for part in 0..I::PARTS {
                let first = block.first as usize + part * width;
                // rounding keeps the order: no particle is further from the box than from a particle in the box
                let squares: I::Reg = squares(
                    &axes,
                    first,
                    #[inline(always)]
                    |axis, x: I::Reg| x - x.max(lower[axis]).min(upper[axis]),
                );
                let mask = (block.mask >> (part * width)) & isa.less_than_mask(squares, limit);
                assert!(end <= last_store, "room for a register");
                for axis in 0..D {
                    let values = I::Reg::load_at(axes[axis], first);
                    isa.pack(mask, values, &mut coordinates.list(axis)[end..][..width]);
                }
                isa.pack_places(mask, &all[part * width..], &mut places[end..][..width]);
                end += mask.count_ones() as usize;
            }
        }
        for axis in 0..D {
            *sixteen_mut(coordinates.list(axis), end) = [T::MAX; BLOCK];
        }
        self.count = end;
    }

    /// The places of what was copied.
    #[inline(always)]
    pub(super) fn places(&self) -> &[u32] {
        &self.places[..self.count]
    }

    /// The same in whole blocks, with what is beyond any support or left over at the end.
    #[inline(always)]
    pub(super) fn padded(&self) -> ([&[T]; D], &[u32]) {
        let length = self.count.next_multiple_of(BLOCK);
        let mut coordinates: [&[T]; D] = [&[]; D];
        for axis in 0..D {
            coordinates[axis] = &self.coordinates[axis][..length];
        }
        (coordinates, &self.places[..length])
    }
}
