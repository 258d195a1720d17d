//! The neighbours of some particles now: of the candidates in their rows those within the support radius, with offsets and slopes.

use std::ops::Range;

use sph_core::vector::norm_squared;
use sph_core::{Arithmetic, Lane};

use super::records::ParticleRecords;
use super::verlet_lists::ListChunk;
use crate::fast::{
    BLOCK, Evaluate, Evaluator, Fronts, InstructionSet, Isa, Job, Real, Register, evaluator, last_store,
    reserve, sixteen_mut,
};
use crate::kernel_choice::{KernelName, with_kernel};

/// The kernel of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct SimdKernel<T> {
    evaluate: Evaluator<T>,
    /// 1/h²
    inverse_square: T,
    /// σ h^{-D−2}: ∇W = this · f′(q)/q · x
    pub(super) gradient_scale: T,
    /// σ h^{-D}: W = this · f(q)
    pub(super) influence_scale: T,
    pub(super) level: InstructionSet,
}

impl<T: Real> SimdKernel<T> {
    /// For a support radius.
    pub(super) fn new<const D: usize>(kernel: KernelName, support: T) -> Self {
        let h = support.to_f64();
        let constant = kernel.normalisation(D as u32) / h.powi(D as i32 + 2);
        Self {
            evaluate: with_kernel!(kernel, K => evaluator::<T, K>(D)),
            inverse_square: T::from_f64(1.0 / (h * h)),
            gradient_scale: T::from_f64(constant),
            influence_scale: T::from_f64(constant * h * h),
            level: InstructionSet::best(),
        }
    }
}

/// What a sum needs of the kernel.
#[derive(Clone, Copy, Debug)]
pub(super) enum Needed {
    /// f(q)
    Profiles,
    /// f′(q)/q
    Slopes,
    /// Both.
    Both,
}

impl Needed {
    fn profiles(self) -> bool {
        matches!(self, Self::Profiles | Self::Both)
    }

    fn slopes(self) -> bool {
        matches!(self, Self::Slopes | Self::Both)
    }
}

/// The neighbours of one particle among all: whole blocks, the last filled up with padding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Span {
    /// The first block.
    pub(super) first: usize,
    /// How many neighbours there are.
    pub(super) count: usize,
}

impl Span {
    /// The blocks.
    #[inline(always)]
    pub(super) fn blocks(self) -> Range<usize> {
        self.first..self.first + self.count.div_ceil(BLOCK)
    }

    /// How many blocks have a neighbour in one of their parts: what is behind is padding, which adds nothing.
    #[inline(always)]
    pub(super) fn blocks_of_part<T: Copy, I: Isa<T>>(self, part: usize) -> usize {
        (self.count + BLOCK - 1 - part * I::Reg::WIDTH) / BLOCK
    }
}

/// The neighbours of some consecutive particles: of each those in the fluid and in the walls.
#[derive(Clone, Debug)]
pub(super) struct Neighbourhoods<T, const D: usize> {
    pub(super) spans: Vec<[Span; 2]>,
    /// Records.
    pub(super) places: Vec<u32>,
    /// x_ij, axis by axis.
    pub(super) offsets: [Vec<T>; D],
    /// (r/h)²
    squares: Vec<T>,
    /// f(q)
    pub(super) profiles: Vec<T>,
    /// f′(q)/q
    pub(super) slopes: Vec<T>,
}

impl<T, const D: usize> Default for Neighbourhoods<T, D> {
    fn default() -> Self {
        Self {
            spans: Vec::new(),
            places: Vec::new(),
            offsets: std::array::from_fn(|_| Vec::new()),
            squares: Vec::new(),
            profiles: Vec::new(),
            slopes: Vec::new(),
        }
    }
}

/// Where neighbours are searched, and what is worked out of the kernel for each.
#[derive(Clone, Copy)]
pub(super) struct Search<'a, T> {
    pub(super) kernel: &'a SimdKernel<T>,
    pub(super) records: &'a ParticleRecords<T>,
    /// The record that pads blocks.
    pub(super) padding: u32,
    pub(super) needed: Needed,
}

impl<T: Real, const D: usize> Neighbourhoods<T, D> {
    /// Finds the neighbours of the particles at `places`, whose rows are those of a chunk from number `first` on.
    pub(super) fn find_neighbours(
        &mut self,
        search: Search<'_, T>,
        chunk: &ListChunk,
        first: usize,
        places: impl Iterator<Item = usize>,
    ) {
        let Search { kernel, records, padding, needed } = search;
        let inverse_square = kernel.inverse_square;
        let job = FindNeighbours { near: self, inverse_square, records, chunk, first, places, padding };
        let end = T::dispatch(kernel.level, job);
        let [profiles, slopes] =
            [needed.profiles(), needed.slopes()].map(|is_needed| if is_needed { end } else { 0 });
        reserve(&mut self.profiles, profiles);
        reserve(&mut self.slopes, slopes);
        let squares = &self.squares[..end];
        let (profiles, slopes) = (&mut self.profiles[..profiles], &mut self.slopes[..slopes]);
        (kernel.evaluate)(kernel.level, Evaluate { squares, scale: T::ONE, profiles, slopes });
    }

    #[inline(always)]
    fn reserve(&mut self, room: usize) {
        reserve(&mut self.places, room);
        reserve(&mut self.squares, room);
        self.offsets.iter_mut().for_each(|axis| reserve(axis, room));
    }

    /// Fills up a block with padding, at the end of the support.
    #[inline(always)]
    fn fill_up(&mut self, end: usize, padding: u32) {
        *sixteen_mut(&mut self.places, end) = [padding; BLOCK];
        *sixteen_mut(&mut self.squares, end) = [T::ONE; BLOCK];
        for axis in &mut self.offsets {
            *sixteen_mut(axis, end) = [T::ZERO; BLOCK];
        }
    }

    /// The blocks of a span, with a list's numbers about them.
    #[inline(always)]
    pub(super) fn blocks<'a>(&'a self, span: Span, list: &'a [T]) -> Blocks<'a, T, D> {
        self.blocks_in(span.blocks(), list)
    }

    /// Some blocks, with a list's numbers about them.
    #[inline(always)]
    pub(super) fn blocks_in<'a>(&'a self, range: Range<usize>, list: &'a [T]) -> Blocks<'a, T, D> {
        let numbers = &list.as_chunks().0[range.clone()];
        let mut offsets = [numbers; D];
        for axis in 0..D {
            offsets[axis] = &self.offsets[axis].as_chunks().0[range.clone()];
        }
        Blocks { places: &self.places.as_chunks().0[range], offsets, numbers }
    }
}

/// The neighbours of one particle in blocks.
pub(super) struct Blocks<'a, T, const D: usize> {
    places: &'a [[u32; BLOCK]],
    offsets: [&'a [[T; BLOCK]]; D],
    numbers: &'a [[T; BLOCK]],
}

impl<'a, T: Real, const D: usize> Blocks<'a, T, D> {
    /// Of one part of a block the records, the offsets, and the list's numbers.
    #[inline(always)]
    pub(super) fn part<I: Isa<T>>(&self, block: usize, part: usize) -> (&'a [u32], [I::Reg; D], I::Reg) {
        let (first, width) = (part * I::Reg::WIDTH, I::Reg::WIDTH);
        let mut offsets = [I::Reg::ZERO; D];
        for axis in 0..D {
            offsets[axis] = I::Reg::load_at(&self.offsets[axis][block], first);
        }
        let numbers = I::Reg::load_at(&self.numbers[block], first);
        (&self.places[block][first..first + width], offsets, numbers)
    }
}

/// The search of [`Neighbourhoods::find_neighbours`].
struct FindNeighbours<'a, T, P, const D: usize> {
    near: &'a mut Neighbourhoods<T, D>,
    inverse_square: T,
    records: &'a ParticleRecords<T>,
    chunk: &'a ListChunk,
    first: usize,
    places: P,
    padding: u32,
}

impl<T: Real, P: Iterator<Item = usize>, const D: usize> Job<T> for FindNeighbours<'_, T, P, D> {
    /// How long the lists are.
    type Output = usize;

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) -> usize {
        let Self { near, inverse_square, records, chunk, first, places, padding } = self;
        let inverse_square = I::Reg::splat(inverse_square);
        let width = I::Reg::WIDTH;
        near.spans.clear();
        let mut end = 0;
        for (k, place) in places.enumerate() {
            let x: [I::Reg; D] = records.position(place);
            let mut spans = [Span::default(); 2];
            for (span, row) in spans.iter_mut().zip(chunk.row(first + k)) {
                let start = end;
                let room = end + (row.len() + 1) * BLOCK;
                near.reserve(room);
                let (squares, found) = (&mut near.squares[..room], &mut near.places[..room]);
                let mut offsets = Fronts::new(&mut near.offsets, room);
                let last_store = last_store(room, width);
                for block in row {
                    for part in 0..I::PARTS {
                        let candidates = &block[part * width..(part + 1) * width];
                        let other: [I::Reg; D] = records.positions(isa, candidates);
                        let mut offset = x;
                        for axis in 0..D {
                            offset[axis] -= other[axis];
                        }
                        let square = norm_squared(&offset) * inverse_square;
                        let mask = isa.less_than_mask(square, I::Reg::ONE);
                        assert!(end <= last_store, "room for a register");
                        for axis in 0..D {
                            isa.pack(mask, offset[axis], &mut offsets.list(axis)[end..][..width]);
                        }
                        isa.pack(mask, square, &mut squares[end..][..width]);
                        isa.pack_places(mask, candidates, &mut found[end..][..width]);
                        end += mask.count_ones() as usize;
                    }
                }
                near.fill_up(end, padding);
                *span = Span { first: start / BLOCK, count: end - start };
                end = end.next_multiple_of(BLOCK);
            }
            near.spans.push(spans);
        }
        end
    }
}
