//! The particles in reach of a point, moved together: sixteen candidates at a time.

use sph_core::Lane;

use super::blocks::{Block, Fronts, candidates, last_store, reserve, sixteen_mut, squares};
use super::simd::{BLOCK, Isa, Job, Real, Register};
use super::sort::Sorted;
use super::sorted_cells::SortedCells;

/// What was found about some points. The lists are longer than what was found: the rest is left over.
#[derive(Clone, Debug, Default)]
pub(super) struct Found<T> {
    /// r², below h², and beyond any support between.
    pub(super) squares: Vec<T>,
    /// Where they came from.
    pub(super) blocks: Vec<Block>,
    /// One for each point.
    pub(super) spans: Vec<Span>,
}

/// The part of the lists that is about one point: whole blocks, of which `count` numbers are particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) start: usize,
    pub(super) count: usize,
    /// How many blocks of candidates there were.
    blocks: usize,
}

impl Span {
    /// The places of its particles in the lists, with what fills up the last block.
    #[inline(always)]
    pub(super) fn padded(self) -> std::ops::Range<usize> {
        self.start..self.start + self.count.next_multiple_of(BLOCK)
    }

    /// Their numbers in a list.
    #[inline(always)]
    pub(super) fn blocks_of<T>(self, list: &[T]) -> &[[T; BLOCK]] {
        list[self.padded()].as_chunks().0
    }
}

/// Finds what is in reach of some consecutive points of a sorted set.
pub(super) struct Collect<'a, T, const D: usize> {
    pub(super) cells: &'a SortedCells<T, D>,
    pub(super) own_limits: Option<&'a [T]>,
    pub(super) points: &'a Sorted<T, D>,
    pub(super) range: std::ops::Range<usize>,
    pub(super) found: &'a mut Found<T>,
}

impl<T: Real, const D: usize> Job<T> for Collect<'_, T, D> {
    /// How long the list of squares is.
    type Output = usize;

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) -> usize {
        let Found { squares, blocks, spans } = self.found;
        spans.clear();
        let (mut start, mut first) = (0, 0);
        for place in self.range {
            let x = self.points.position(place);
            let last = candidates(self.cells, &x, &x, 0, blocks, first);
            reserve(squares, start + (last - first + 1) * BLOCK);
            let (blocks, mut end) = (&mut blocks[first..last], start);
            let out = &mut squares[..];
            let last_store = last_store(out.len(), I::Reg::WIDTH);
            near(
                isa,
                self.cells,
                self.own_limits,
                &x,
                blocks,
                #[inline(always)]
                |_, _, mask, r2| {
                    assert!(end <= last_store, "room for a register");
                    isa.pack(mask, r2, &mut out[end..][..I::Reg::WIDTH]);
                    end += mask.count_ones() as usize;
                },
            );
            spans.push(Span { start, count: end - start, blocks: last - first });
            *sixteen_mut(squares, end) = [T::MAX; BLOCK];
            (start, first) = (end.next_multiple_of(BLOCK), last);
        }
        start
    }
}

/// Leaves of the candidates those with r² < h² about x, and hands over the mask and the squares of each register of a block, with
/// the block and where in it they begin. h is the cells' own, or each
/// particle's where `own_limits` has their squares.
#[inline(always)]
fn near<T: Real, const D: usize, I: Isa<T>>(
    isa: I,
    cells: &SortedCells<T, D>,
    own_limits: Option<&[T]>,
    x: &[T; D],
    blocks: &mut [Block],
    take: impl FnMut(&Block, usize, u32, I::Reg),
) {
    let axes = cells.sorted.padded();
    let limit = I::Reg::splat(cells.radius * cells.radius);
    match own_limits {
        None => filter::<T, D, I>(
            isa,
            &axes,
            x,
            blocks,
            #[inline(always)]
            |_| limit,
            take,
        ),
        Some(limits) => {
            let limits = &limits[..axes[0].len()];
            filter::<T, D, I>(
                isa,
                &axes,
                x,
                blocks,
                #[inline(always)]
                |first| I::Reg::load_at(limits, first),
                take,
            );
        }
    }
}

/// The loop of [`near`]; `limit` has h² of the particles from a place on.
#[inline(always)]
fn filter<T: Real, const D: usize, I: Isa<T>>(
    isa: I,
    axes: &[&[T]; D],
    x: &[T; D],
    blocks: &mut [Block],
    limit: impl Fn(usize) -> I::Reg,
    mut take: impl FnMut(&Block, usize, u32, I::Reg),
) {
    let x: [I::Reg; D] = I::splat_vector(x);
    for block in blocks {
        let mut found = 0;
        for part in 0..I::PARTS {
            let shift = part * I::Reg::WIDTH;
            let first = block.first as usize + shift;
            let squares: I::Reg = squares(
                axes,
                first,
                #[inline(always)]
                |axis, y| x[axis] - y,
            );
            let mask = (block.mask >> shift) & isa.less_than_mask(squares, limit(first));
            found |= mask << shift;
            take(block, shift, mask, squares);
        }
        block.mask = found;
    }
}

/// Lists the places of the particles with r² < h² about x, in the order of the cells, after the first `end`; returns where they end
/// then. There is room for a block more.
#[inline(always)]
pub(crate) fn list_places<T: Real, const D: usize, I: Isa<T>>(
    isa: I,
    cells: &SortedCells<T, D>,
    x: &[T; D],
    blocks: &mut Vec<Block>,
    places: &mut Vec<u32>,
    mut end: usize,
) -> usize {
    let count = candidates(cells, x, x, 0, blocks, 0);
    reserve(places, end + (count + 1) * BLOCK);
    let out = &mut places[..];
    let last_store = last_store(out.len(), I::Reg::WIDTH);
    near(
        isa,
        cells,
        None,
        x,
        &mut blocks[..count],
        #[inline(always)]
        |block, shift, mask, _| {
            assert!(end <= last_store, "room for a register");
            isa.pack_places(mask, &block.places()[shift..], &mut out[end..][..I::Reg::WIDTH]);
            end += mask.count_ones() as usize;
        },
    );
    end
}

/// Moves C numbers of each particle found together, and puts zeros between.
pub(super) struct Pick<'a, T, const C: usize> {
    pub(super) found: &'a Found<T>,
    /// One for each particle, and a block more.
    pub(super) columns: [&'a [T]; C],
    pub(super) out: &'a mut [Vec<T>; C],
}

impl<T: Real, const C: usize> Job<T> for Pick<'_, T, C> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { found, columns, out } = self;
        // all of one length: then one check of a place is enough
        let length = columns[0].len();
        let mut columns = columns;
        for column in &mut columns {
            *column = &column[..length];
        }
        let room = found.squares.len();
        out.iter_mut().for_each(|out| reserve(out, room));
        let mut out = Fronts::new(out, room);
        let last_store = last_store(room, I::Reg::WIDTH);
        let mut blocks = &found.blocks[..];
        for span in &found.spans {
            let (own, rest) = blocks.split_at(span.blocks);
            blocks = rest;
            let mut end = span.start;
            for block in own {
                for part in 0..I::PARTS {
                    let shift = part * I::Reg::WIDTH;
                    let mask = (block.mask >> shift) & I::ALL;
                    assert!(end <= last_store, "room for a register");
                    for column in 0..C {
                        let values = I::Reg::load_at(columns[column], block.first as usize + shift);
                        isa.pack(mask, values, &mut out.list(column)[end..][..I::Reg::WIDTH]);
                    }
                    end += mask.count_ones() as usize;
                }
            }
            for column in 0..C {
                *sixteen_mut(out.list(column), end) = [T::ZERO; BLOCK];
            }
        }
    }
}
