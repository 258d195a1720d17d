//! Who is near some particles now: of the candidates in their rows those within the support radius, with offsets and slopes.

use std::marker::PhantomData;
use std::ops::Range;

use sph_core::vector::norm_squared;

use super::records::{ParticleRecords, Wide};
use super::verlet_lists::ListChunk;
use crate::fast::{BLOCK, Evaluate, InstructionSet, Isa, Job, Lanes, Real, reserve, sixteen_mut};
use crate::kernel_choice::{KernelName, with_kernel};

/// The kernel of a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct SimdKernel<T> {
    pub(super) name: KernelName,
    /// 1/h²
    inverse_square: T,
    /// σ h^{-D−2}: ∇W = this · f′(q)/q · x
    pub(super) gradient_scale: T,
    pub(super) level: InstructionSet,
}

impl<T: Real> SimdKernel<T> {
    /// For a support radius.
    pub(super) fn new<const D: usize>(kernel: KernelName, support: T) -> Self {
        let h = support.to_f64();
        let constant = kernel.normalisation(D as u32) / h.powi(D as i32 + 2);
        Self {
            name: kernel,
            inverse_square: T::from_f64(1.0 / (h * h)),
            gradient_scale: T::from_f64(constant),
            level: InstructionSet::best(),
        }
    }
}

/// What was found about some consecutive particles: of each the numbers of its blocks of fluid and of walls.
#[derive(Clone, Debug)]
pub(super) struct Neighbourhoods<T, const D: usize> {
    pub(super) spans: Vec<[Range<usize>; 2]>,
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

impl<T: Real, const D: usize> Neighbourhoods<T, D> {
    /// Looks about the particles at `places`, whose rows are those of a chunk from number `first` on.
    pub(super) fn find_neighbours(
        &mut self,
        kernel: &SimdKernel<T>,
        records: &ParticleRecords<T>,
        chunk: &ListChunk,
        first: usize,
        places: impl Iterator<Item = usize>,
        padding: u32,
    ) {
        let inverse_square = kernel.inverse_square;
        let job = FindNeighbours { near: self, inverse_square, records, chunk, first, places, padding };
        let end = T::dispatch(kernel.level, job);
        reserve(&mut self.profiles, end);
        reserve(&mut self.slopes, end);
        let squares = &self.squares[..end];
        let (profiles, slopes) = (&mut self.profiles[..end], &mut self.slopes[..end]);
        with_kernel!(kernel.name, K => {
            let profile_of = PhantomData::<K>;
            let evaluate = Evaluate::<_, _, D> { squares, inverse: T::ONE, inverses: None, profiles, slopes, kernel: profile_of };
            T::dispatch(kernel.level, evaluate);
        });
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

    /// The records of block number `block`, their offsets, and a list's numbers about them.
    #[inline(always)]
    pub(super) fn block(&self, block: usize, list: &[T]) -> (&[u32; BLOCK], [Wide<T>; D], Wide<T>) {
        let offsets = std::array::from_fn(
            #[inline(always)]
            |axis| wide(&self.offsets[axis], block),
        );
        (&self.places.as_chunks::<BLOCK>().0[block], offsets, wide(list, block))
    }
}

/// Block number `block` of a list.
#[inline(always)]
fn wide<T: Real>(list: &[T], block: usize) -> Wide<T> {
    Lanes(list.as_chunks::<BLOCK>().0[block])
}

/// Finds who is near.
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
        near.spans.clear();
        let mut end = 0;
        for (k, place) in places.enumerate() {
            let x: [Wide<T>; D] = records.position(place);
            let mut spans = [0..0, 0..0];
            for (span, row) in spans.iter_mut().zip(chunk.row(first + k)) {
                let start = end;
                near.reserve(end + (row.len() + 1) * BLOCK);
                for block in row {
                    let other: [Wide<T>; D] = records.positions(isa, block);
                    let mut offset = x;
                    for axis in 0..D {
                        offset[axis] -= other[axis];
                    }
                    let square = norm_squared(&offset) * Lanes::splat(inverse_square);
                    let mask = isa.below(&square.0, &[T::ONE; BLOCK]);
                    for axis in 0..D {
                        isa.pack(mask, &offset[axis].0, sixteen_mut(&mut near.offsets[axis], end));
                    }
                    isa.pack(mask, &square.0, sixteen_mut(&mut near.squares, end));
                    isa.pack_places(mask, block, sixteen_mut(&mut near.places, end));
                    end += mask.count_ones() as usize;
                }
                near.fill_up(end, padding);
                end = end.next_multiple_of(BLOCK);
                *span = start / BLOCK..end / BLOCK;
            }
            near.spans.push(spans);
        }
        end
    }
}
