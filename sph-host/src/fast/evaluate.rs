//! Kernels on what was found about a point, as many numbers at once as a vector has.

use std::hint::black_box;
use std::marker::PhantomData;

use sph_core::Arithmetic;
use sph_core::kernel::Kernel;

use super::collect::Span;
use super::lanes::Lanes;
use super::simd::{BLOCK, Isa, Job, Real};

/// f(q) for s = q², held at 1; LINE: the form for one dimension.
#[inline(always)]
pub(super) fn profile<T: Real, K: Kernel, const LINE: bool, const N: usize>(s: Lanes<T, N>) -> Lanes<T, N> {
    let q = s.min(Lanes::ONE).root();
    if LINE { K::profile_in_1d(q) } else { K::profile(q) }
}

/// f(q) and f′(q) / q; what the latter is at q = 0 matters to nobody, since it is multiplied with x = 0.
#[inline(always)]
pub(super) fn profile_and_slope<T: Real, K: Kernel, const LINE: bool, const N: usize>(
    s: Lanes<T, N>,
) -> (Lanes<T, N>, Lanes<T, N>) {
    let q = s.min(Lanes::ONE).root();
    let divisor = q.max(Lanes::splat(T::SMALL));
    if LINE {
        (K::profile_in_1d(q), K::slope_in_1d(q) / divisor)
    } else {
        (K::profile(q), K::slope(q) / divisor)
    }
}

/// Σ c f(q) over each span.
pub(super) struct SumProfiles<'a, T, K> {
    /// r²
    pub(super) squares: &'a [T],
    pub(super) inverse_square: T,
    /// c, where these are not all 1.
    pub(super) coefficients: Option<&'a [T]>,
    pub(super) spans: &'a [Span],
    pub(super) constant: T,
    pub(super) out: &'a mut [T],
    pub(super) kernel: PhantomData<K>,
    pub(super) line: bool,
}

impl<T: Real, K: Kernel> Job<T> for SumProfiles<'_, T, K> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>, const N: usize>(self, _: I) {
        if self.line { self.all::<true, N>() } else { self.all::<false, N>() }
    }
}

impl<T: Real, K: Kernel> SumProfiles<'_, T, K> {
    #[inline(always)]
    fn all<const LINE: bool, const N: usize>(self) {
        let inverse_square = Lanes::<T, N>::splat(self.inverse_square);
        for (out, span) in self.out.iter_mut().zip(self.spans) {
            let squares = self.squares[span.padded()].as_chunks::<BLOCK>().0;
            let coefficients = self.coefficients.map(|all| all[span.padded()].as_chunks::<BLOCK>().0);
            let mut columns = Columns::<T, N>::ZERO;
            for (block, squares) in squares.iter().enumerate() {
                for group in 0..BLOCK / N {
                    let f = profile::<T, K, LINE, N>(Lanes::of(squares, group) * inverse_square);
                    columns.add(group, coefficients.map_or(f, |all| Lanes::of(&all[block], group) * f));
                }
            }
            *out = columns.total() * self.constant;
        }
    }
}

/// f(q) and f′(q) / q, block by block.
pub(crate) struct Evaluate<'a, T, K> {
    /// r² / h², replaced by f(q).
    pub(crate) squares: &'a mut [T],
    /// f′(q) / q; empty where gradients are not wanted.
    pub(crate) slopes: &'a mut [T],
    pub(crate) kernel: PhantomData<K>,
    pub(crate) line: bool,
}

impl<T: Real, K: Kernel> Job<T> for Evaluate<'_, T, K> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>, const N: usize>(self, _: I) {
        if self.line { self.all::<true, N>() } else { self.all::<false, N>() }
    }
}

impl<T: Real, K: Kernel> Evaluate<'_, T, K> {
    /// Each block is hidden from the compiler, lest it take the first numbers of sixteen blocks for a vector.
    #[inline(always)]
    fn all<const LINE: bool, const N: usize>(self) {
        let squares = self.squares.as_chunks_mut::<BLOCK>().0;
        if self.slopes.is_empty() {
            for values in squares {
                let values = black_box(values);
                for group in 0..BLOCK / N {
                    profile::<T, K, LINE, N>(Lanes::of(values, group)).put(values, group);
                }
            }
            return;
        }
        for (values, slopes) in squares.iter_mut().zip(self.slopes.as_chunks_mut::<BLOCK>().0) {
            let values = black_box(values);
            for group in 0..BLOCK / N {
                let (f, slope) = profile_and_slope::<T, K, LINE, N>(Lanes::of(values, group));
                f.put(values, group);
                slope.put(slopes, group);
            }
        }
    }
}

/// Sixteen running sums, whatever the width of a vector, so that every instruction set gives the same bits.
#[derive(Clone, Copy)]
pub(super) struct Columns<T, const N: usize>([Lanes<T, N>; BLOCK]);

impl<T: Real, const N: usize> Columns<T, N> {
    /// Sixteen times 0.
    pub(super) const ZERO: Self = Self([Lanes::ZERO; BLOCK]);

    /// Adds to the columns of a group of N.
    #[inline(always)]
    pub(super) fn add(&mut self, group: usize, terms: Lanes<T, N>) {
        self.0[group] += terms;
    }

    /// The sum of the columns.
    #[inline(always)]
    pub(super) fn total(self) -> T {
        total(black_box(std::array::from_fn(
            #[inline(always)]
            |k| self.0[k / N].0[k % N],
        )))
    }
}

/// The sum, halves first. Of columns that are hidden from the compiler: a sum within sight lets it narrow the vectors that lead
/// to it.
#[inline(always)]
pub(super) fn total<T: Real>(mut columns: [T; BLOCK]) -> T {
    let mut half = BLOCK / 2;
    while half > 0 {
        for k in 0..half {
            columns[k] += columns[k + half];
        }
        half /= 2;
    }
    columns[0]
}
