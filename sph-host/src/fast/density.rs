//! ρ_i = Σ m_j W(x_i − x_j) at every particle (Thm 3.2).

use std::marker::PhantomData;
use std::ops::Range;

use sph_core::kernel::Kernel;
use sph_core::{Error, KernelInfluence, Parameter, PerSample};

use super::cells::Run;
use super::pairs::{Gather, PairScratch, Pairs};
use super::shared_neighbourhood::SharedNeighbourhood;
use super::simd::Real;
use super::sort::to_f64;
use super::sorted_cells::{SortedCells, check_length};
use crate::parallel;

/// Particles that a thread takes at a time.
const CHUNK: usize = 4096;

impl<T: Real, const D: usize> SortedCells<T, D> {
    /// ρ_i at every particle, itself included, in the order of the input. Masses are a slice, or one
    /// [`Uniform`](sph_core::Uniform) value; one that is not finite spoils the densities around it.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is a mass for each particle; those of [`KernelInfluence::new`].
    ///
    /// ```
    /// use sph_core::{Uniform, kernel::CubicSpline};
    /// use sph_host::fast::SortedCells;
    /// let row: Vec<[f64; 1]> = (0..100).map(|i| [0.1 * f64::from(i)]).collect();
    /// let density = SortedCells::sort(&row, 0.4)?.density::<CubicSpline>(Uniform(0.1))?;
    /// assert!((density[50] - 1.0).abs() < 1e-12);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn density<K: Kernel>(&self, masses: impl PerSample<T>) -> Result<Vec<T>, Error> {
        let w = KernelInfluence::<T, D, K>::new(self.radius)?;
        self.weighted_densities(add_pairs::<T, K, D>, w.normalisation(), masses)
    }

    fn weighted_densities(
        &self,
        pairs: AddPairs<T, D>,
        constant: T,
        masses: impl PerSample<T>,
    ) -> Result<Vec<T>, Error> {
        if let Some(count) = masses.count() {
            check_length(count, self.len(), Parameter::Mass)?;
            let own = self.sorted.order.iter().map(|&j| masses.get(j as usize).unwrap_or(T::ZERO)).collect();
            return Ok(self.densities(pairs, constant, Some(own)));
        }
        let mass = masses.get(0).unwrap_or(T::ZERO);
        Ok(self.densities(pairs, constant * mass, None))
    }

    /// constant · Σ m_j f, m_j = 1 where there are no masses.
    fn densities(&self, pairs: AddPairs<T, D>, constant: T, masses: Option<Vec<T>>) -> Vec<T> {
        let chunks = (0..self.len()).step_by(CHUNK);
        let windows = parallel::map(chunks, |_, first| {
            let particles = first..self.len().min(first + CHUNK);
            self.window(pairs, particles, masses.as_deref())
        });
        let mut sorted = vec![T::ZERO; self.len()];
        windows.iter().for_each(|window| window.add_to(&mut sorted));
        let mut density = vec![T::ZERO; self.len()];
        for (&index, &sum) in self.sorted.order.iter().zip(&sorted) {
            density[index as usize] = sum * constant;
        }
        density
    }

    /// What pairs with some consecutive particles contribute to them and to those that come later.
    fn window(
        &self,
        pairs: AddPairs<T, D>,
        particles: Range<usize>,
        masses: Option<&[T]>,
    ) -> ScatterBuffer<T> {
        let mut window = ScatterBuffer::new(self.later(&particles));
        let mut scratch = PairScratch::default();
        let mut rest = particles;
        while !rest.is_empty() {
            let group = SharedNeighbourhood::group(self, &rest);
            let shared = &mut scratch.shared;
            T::dispatch(self.level, Gather { cells: self, group: group.clone(), shared });
            pairs(self, group.clone(), masses, &mut scratch);
            window.add(scratch.shared.places(), &scratch.sums);
            rest.start = group.end;
        }
        window
    }

    /// The places, not before some consecutive particles, that are in reach of them: ranges in order, which do not overlap.
    fn later(&self, particles: &Range<usize>) -> Vec<Range<usize>> {
        let row = |place: usize| self.layout.row(&self.sorted.position(place));
        let (first, last) = (row(particles.start), row(particles.end - 1));
        let cells: Vec<Run> = if first == last {
            let (lower, upper) = self.corners(particles.clone());
            let (mut lower, mut upper) = (to_f64(&lower), to_f64(&upper));
            // a little wider, lest another rounding make it narrower than what a group of these reaches
            let margin = 1e-3 * self.radius.to_f64();
            (lower[0], upper[0]) = (lower[0] - margin, upper[0] + margin);
            self.layout.runs(&lower, &upper).to_vec()
        } else {
            self.layout.later_rows(first, last).to_vec()
        };
        let ranges = cells.iter().map(|run| self.sorted.range(run));
        ranges
            .map(|(first, last)| particles.start.max(first as usize)..last as usize)
            .filter(|range| !range.is_empty())
            .collect()
    }
}

/// Runs [`Pairs`] with some kernel: the one function here that is compiled for each.
type AddPairs<T, const D: usize> = fn(&SortedCells<T, D>, Range<usize>, Option<&[T]>, &mut PairScratch<T, D>);

fn add_pairs<T: Real, K: Kernel, const D: usize>(
    cells: &SortedCells<T, D>,
    group: Range<usize>,
    masses: Option<&[T]>,
    scratch: &mut PairScratch<T, D>,
) {
    T::dispatch(cells.level, Pairs { cells, group, masses, scratch, kernel: PhantomData::<K> });
}

/// Sums at ranges of places.
struct ScatterBuffer<T> {
    ranges: Vec<Range<usize>>,
    /// Range by range.
    sums: Vec<T>,
}

impl<T: Real> ScatterBuffer<T> {
    fn new(ranges: Vec<Range<usize>>) -> Self {
        let length = ranges.iter().map(ExactSizeIterator::len).sum();
        Self { ranges, sums: vec![T::ZERO; length] }
    }

    /// Adds numbers at ascending places.
    #[inline]
    fn add(&mut self, places: &[u32], numbers: &[T]) {
        let mut ranges = self.ranges.iter();
        let (mut end, mut shift, mut length) = (0, 0, 0);
        for (&place, &number) in places.iter().zip(numbers) {
            while place as usize >= end
                && let Some(range) = ranges.next()
            {
                (end, shift) = (range.end, range.start - length);
                length += range.len();
            }
            self.sums[place as usize - shift] += number;
        }
    }

    /// Adds all sums where they belong.
    fn add_to(&self, sorted: &mut [T]) {
        let mut sums = &self.sums[..];
        for range in &self.ranges {
            let (own, rest) = sums.split_at(range.len());
            sorted[range.clone()].iter_mut().zip(own).for_each(|(sum, &more)| *sum += more);
            sums = rest;
        }
    }
}
