//! Kernels on what was found about a point, as many numbers at once as a vector has.

use sph_core::Arithmetic;
use sph_core::kernel::Kernel;

use super::lanes::Lanes;
use super::simd::{BLOCK, Real};

/// f(q) for s = q², held at 1.
#[inline(always)]
pub(super) fn profile<T: Real, K: Kernel, const D: usize, const N: usize>(s: Lanes<T, N>) -> Lanes<T, N> {
    let q = s.min(Lanes::ONE).root();
    if D == 1 { K::profile_in_1d(q) } else { K::profile(q) }
}

/// f(q) and f′(q) / q; what the latter is at q = 0 matters to nobody, since it is multiplied with x = 0.
#[inline(always)]
pub(super) fn profile_and_slope<T: Real, K: Kernel, const D: usize, const N: usize>(
    s: Lanes<T, N>,
) -> (Lanes<T, N>, Lanes<T, N>) {
    let q = s.min(Lanes::ONE).root();
    let divisor = q.max(Lanes::splat(T::SMALL));
    if D == 1 {
        (K::profile_in_1d(q), K::slope_in_1d(q) / divisor)
    } else {
        (K::profile(q), K::slope(q) / divisor)
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
        total(&std::array::from_fn(
            #[inline(always)]
            |k| self.0[k / N].0[k % N],
        ))
    }
}

/// The sum, halves first. Not inlined: a sum within sight lets the compiler narrow the vectors that lead to it.
#[inline(never)]
fn total<T: Real>(columns: &[T; BLOCK]) -> T {
    let mut columns = *columns;
    let mut half = BLOCK / 2;
    while half > 0 {
        for k in 0..half {
            columns[k] = columns[k] + columns[k + half];
        }
        half /= 2;
    }
    columns[0]
}
