//! Kernels, number by number in loops that the compiler turns into vectors.

use std::marker::PhantomData;

use sph_core::Arithmetic;
use sph_core::kernel::Kernel;

use super::simd::{BLOCK, Isa, Job, Real};

/// q = √s, held at 1, beyond which every kernel is zero.
#[inline(always)]
fn root<T: Real>(s: T) -> T {
    (if s < T::ONE { s } else { T::ONE }).root()
}

/// f(q) in D dimensions.
#[inline(always)]
pub(super) fn profile<T: Arithmetic, K: Kernel, const D: usize>(q: T) -> T {
    if D == 1 { K::profile_in_1d(q) } else { K::profile(q) }
}

/// f′(q) / q in D dimensions; what that is at q = 0 matters to nobody, since it is multiplied with x = 0.
#[inline(always)]
fn slope<T: Real, K: Kernel, const D: usize>(q: T) -> T {
    let slope = if D == 1 { K::slope_in_1d(q) } else { K::slope(q) };
    slope / if q > T::SMALL { q } else { T::SMALL }
}

/// f(q) and f′(q) / q for many particles.
pub(crate) struct Evaluate<'a, T, K, const D: usize> {
    /// r²
    pub(crate) squares: &'a [T],
    /// 1 / h
    pub(crate) inverse: T,
    /// 1 / h_j, where each has its own.
    pub(crate) inverses: Option<&'a [T]>,
    /// Overwritten: f(q).
    pub(crate) profiles: &'a mut [T],
    /// Overwritten: f′(q) / q; empty where gradients are not wanted.
    pub(crate) slopes: &'a mut [T],
    pub(crate) kernel: PhantomData<K>,
}

impl<T: Real, K: Kernel, const D: usize> Job<T> for Evaluate<'_, T, K, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        let uniform = self.inverse * self.inverse;
        let squares = self.squares.iter().zip(self.profiles.iter_mut());
        match self.inverses {
            None => squares.for_each(
                #[inline(always)]
                |(&square, q)| *q = root(square * uniform),
            ),
            Some(inverses) => squares.zip(inverses).for_each(
                #[inline(always)]
                |((&square, q), &inverse)| *q = root(square * (inverse * inverse)),
            ),
        }
        for (&q, out) in self.profiles.iter().zip(self.slopes) {
            *out = slope::<T, K, D>(q);
        }
        for q in self.profiles {
            *q = profile::<T, K, D>(*q);
        }
    }
}

/// The sum of each sixteen columns. Not inlined: a sum within sight lets the compiler narrow the vectors that lead to it.
#[inline(never)]
pub(super) fn totals<T: Real, const M: usize>(columns: &[[T; BLOCK]; M]) -> [T; M] {
    columns.map(total)
}

/// The sum of sixteen columns, halves first, whatever the width of a vector, so that every instruction set gives the same bits.
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
