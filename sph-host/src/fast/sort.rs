//! Two passes of counting sort: first chunks of the input into buckets of cells, then each bucket into its cells.
//!
//! Both passes move whole particles between pieces that fit a core's cache, which is what makes a shuffled set cost little more
//! than a sorted one. Chunks and buckets do not depend on the number of threads, and both passes are stable, so the
//! order of the particles is that of their cells, and within a cell that of the input.

use super::cells::{BandLayout, Run};
use super::simd::{BLOCK, Real};
use crate::parallel;

/// Particles of a chunk of the input.
const CHUNK: usize = 1 << 16;
/// Numbers of a column that a thread takes at a time.
const COLUMN_CHUNK: usize = 1 << 12;
/// Particles that a bucket should have about.
const BUCKET: usize = 1 << 14;

/// A particle on its way.
#[derive(Clone, Copy)]
struct Moved<T, const D: usize> {
    x: [T; D],
    cell: u32,
    index: u32,
}

/// Particles in the order of their cells.
#[derive(Clone, Debug)]
pub(super) struct Sorted<T, const D: usize> {
    /// Coordinates axis by axis, and after the last particle a block of zeros, so that a whole block can always be read.
    pub(super) coordinates: [Vec<T>; D],
    /// Where each came from.
    pub(super) order: Vec<u32>,
    /// The first particle of each cell, and at the end how many there are.
    pub(super) starts: Vec<u32>,
}

impl<T, const D: usize> Sorted<T, D> {
    /// The places of a run's particles: from the first to before the last.
    #[inline(always)]
    pub(super) fn range(&self, run: &Run) -> (u32, u32) {
        (self.starts[run.first as usize], self.starts[run.end as usize])
    }
}

impl<T: Real, const D: usize> Sorted<T, D> {
    /// The position at a place.
    #[inline(always)]
    pub(super) fn position(&self, place: usize) -> [T; D] {
        let mut x = [T::ZERO; D];
        for axis in 0..D {
            x[axis] = self.coordinates[axis][place];
        }
        x
    }

    /// The coordinates and a block of zeros, all of a length that can be seen to be the same.
    #[inline(always)]
    pub(super) fn padded(&self) -> [&[T]; D] {
        let length = self.order.len() + BLOCK;
        let mut padded: [&[T]; D] = [&[]; D];
        for axis in 0..D {
            padded[axis] = &self.coordinates[axis][..length];
        }
        padded
    }

    /// A number for each particle, found by its index, in the order of the cells; and after the last a block of zeros.
    pub(super) fn column(&self, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
        let mut column = vec![T::ZERO; self.order.len() + BLOCK];
        let rows = column.chunks_mut(COLUMN_CHUNK).zip(self.order.chunks(COLUMN_CHUNK));
        parallel::for_each(rows, |_, (out, order)| {
            for (out, &index) in out.iter_mut().zip(order) {
                *out = value(index as usize);
            }
        });
        column
    }
}

/// Sorts particles into the cells of a layout; there are fewer than 2³² of both.
pub(super) fn sort<T: Real, const D: usize>(layout: &BandLayout<D>, positions: &[[T; D]]) -> Sorted<T, D> {
    let cells = layout.cells();
    let buckets = (positions.len() / BUCKET).clamp(1, 1024).min(cells);
    let cells_each = cells.div_ceil(buckets);
    let (moved, ends) = into_buckets(layout, positions, buckets, cells_each);

    let mut sorted = Sorted {
        coordinates: std::array::from_fn(|_| vec![T::ZERO; positions.len() + BLOCK]),
        order: vec![0; positions.len()],
        starts: vec![0; cells + 1],
    };
    sorted.starts[cells] = positions.len() as u32;
    let mut first = 0;
    let mut work = Vec::with_capacity(buckets);
    let mut coordinates = sorted.coordinates.each_mut().map(|axis| &mut axis[..]);
    let mut order = &mut sorted.order[..];
    for (bucket, starts) in sorted.starts[..cells].chunks_mut(cells_each).enumerate() {
        let size = (0..ends.len() / buckets).map(|chunk| range(&ends, buckets, chunk, bucket).len()).sum();
        let coordinates = coordinates.each_mut().map(|axis| axis.split_off_mut(..size).unwrap_or_default());
        let order = order.split_off_mut(..size).unwrap_or_default();
        work.push(Bucket { number: bucket, first, starts, coordinates, order });
        first += size;
    }
    parallel::for_each(work.into_iter(), |_, bucket| {
        let chunks = moved.chunks(CHUNK).enumerate();
        let number = bucket.number;
        let pieces = chunks.map(|(chunk, moved)| &moved[range(&ends, buckets, chunk, number)]);
        bucket.fill(pieces, cells_each);
    });
    sorted
}

/// A position in f64.
#[inline(always)]
pub(super) fn to_f64<T: Real, const D: usize>(x: &[T; D]) -> [f64; D] {
    let mut wide = [0.0; D];
    for axis in 0..D {
        wide[axis] = x[axis].to_f64();
    }
    wide
}

/// Where a chunk's particles of one bucket are within the chunk.
fn range(ends: &[u32], buckets: usize, chunk: usize, bucket: usize) -> std::ops::Range<usize> {
    let ends = &ends[chunk * buckets..][..buckets];
    let first = if bucket == 0 { 0 } else { ends[bucket - 1] };
    first as usize..ends[bucket] as usize
}

/// Each chunk of the input in the order of its buckets, and for each chunk where each bucket ends.
fn into_buckets<T: Real, const D: usize>(
    layout: &BandLayout<D>,
    positions: &[[T; D]],
    buckets: usize,
    cells_each: usize,
) -> (Vec<Moved<T, D>>, Vec<u32>) {
    let mut moved = vec![Moved { x: [T::ZERO; D], cell: 0, index: 0 }; positions.len()];
    let mut ends = vec![0_u32; positions.len().div_ceil(CHUNK) * buckets];
    let bucket_of = Reciprocal::new(cells_each);
    let chunks = positions.chunks(CHUNK).zip(moved.chunks_mut(CHUNK)).zip(ends.chunks_mut(buckets));
    parallel::for_each(chunks, |chunk, ((positions, moved), ends)| {
        let mut cells = vec![0; positions.len()];
        for (cell, x) in cells.iter_mut().zip(positions) {
            *cell = layout.cell(&to_f64(x));
            ends[bucket_of.quotient(*cell)] += 1;
        }
        running_starts(ends, 0);
        for (k, (&x, &cell)) in positions.iter().zip(&cells).enumerate() {
            let end = &mut ends[bucket_of.quotient(cell)];
            moved[*end as usize] = Moved { x, cell, index: (chunk * CHUNK + k) as u32 };
            *end += 1;
        }
    });
    (moved, ends)
}

/// Replaces counts by the places where each begins.
fn running_starts(counts: &mut [u32], first: u32) {
    let mut next = first;
    for count in counts {
        next += std::mem::replace(count, next);
    }
}

/// Division by a number known beforehand, as one multiplication.
#[derive(Clone, Copy)]
struct Reciprocal(u64);

impl Reciprocal {
    /// For dividends below 2³²: ⌈2⁶⁴ / d⌉, or 0 for d = 1.
    fn new(divisor: usize) -> Self {
        Self((u64::MAX / divisor as u64).wrapping_add(1))
    }

    #[inline(always)]
    fn quotient(self, dividend: u32) -> usize {
        if self.0 == 0 {
            dividend as usize
        } else {
            ((u128::from(dividend) * u128::from(self.0)) >> 64) as usize
        }
    }
}

/// A bucket of cells and the places of its particles.
struct Bucket<'a, T, const D: usize> {
    number: usize,
    /// Particles in the buckets before.
    first: usize,
    starts: &'a mut [u32],
    coordinates: [&'a mut [T]; D],
    order: &'a mut [u32],
}

impl<'p, T: Real, const D: usize> Bucket<'_, T, D> {
    /// Puts the pieces' particles into their cells.
    fn fill(self, pieces: impl Iterator<Item = &'p [Moved<T, D>]> + Clone, cells_each: usize) {
        let first_cell = (self.number * cells_each) as u32;
        let mut places = vec![0_u32; self.starts.len()];
        for moved in pieces.clone().flatten() {
            places[(moved.cell - first_cell) as usize] += 1;
        }
        running_starts(&mut places, 0);
        for (start, place) in self.starts.iter_mut().zip(&places) {
            *start = self.first as u32 + place;
        }
        for moved in pieces.flatten() {
            let place = &mut places[(moved.cell - first_cell) as usize];
            for axis in 0..D {
                self.coordinates[axis][*place as usize] = moved.x[axis];
            }
            self.order[*place as usize] = moved.index;
            *place += 1;
        }
    }
}
