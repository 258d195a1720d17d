//! Kernels, a register at a time.

use std::marker::PhantomData;

use sph_core::kernel::Kernel;
use sph_core::{Arithmetic, Lane};

use super::simd::{InstructionSet, Isa, Job, Real, Register};

/// q = r/h of a register of squares, held at 1, beyond which every kernel is zero.
#[inline(always)]
fn q<T: Real, R: Register<T>>(squares: &[T], first: usize, scale: R) -> R {
    (R::load_at(squares, first) * scale).min(R::ONE).root()
}

/// f(q), of the form used in one dimension or of that of all others.
#[inline(always)]
pub(super) fn profile<T: Arithmetic, K: Kernel>(q: T, in_1d: bool) -> T {
    if in_1d { K::profile_in_1d(q) } else { K::profile(q) }
}

/// f′(q) / q. At q = 0 it is some finite number: it is multiplied with x = 0 there.
#[inline(always)]
fn slope<T: Real, R: Register<T>, K: Kernel>(q: R, in_1d: bool) -> R {
    let slope = if in_1d { K::slope_in_1d(q) } else { K::slope(q) };
    slope / q.max(R::splat(T::SMALL))
}

/// Distances, and room for what a kernel is at each.
pub(crate) struct Evaluate<'a, T> {
    /// r², in whole blocks.
    pub(crate) squares: &'a [T],
    /// 1 / h²
    pub(crate) scale: T,
    /// Overwritten: f(q); empty where values are not wanted.
    pub(crate) profiles: &'a mut [T],
    /// Overwritten: f′(q) / q; empty where gradients are not wanted.
    pub(crate) slopes: &'a mut [T],
}

/// Evaluates a kernel at a level: the only code for points that is compiled once for each kernel.
pub(crate) type Evaluator<T> = fn(InstructionSet, Evaluate<'_, T>);

/// The [`Evaluator`] of a kernel in so many dimensions.
pub(crate) fn evaluator<T: Real, K: Kernel>(dim: usize) -> Evaluator<T> {
    fn evaluate<T: Real, K: Kernel, const IN_1D: bool>(level: InstructionSet, lists: Evaluate<'_, T>) {
        T::dispatch(level, OfKernel::<T, K, IN_1D> { lists, kernel: PhantomData });
    }
    if dim == 1 { evaluate::<T, K, true> } else { evaluate::<T, K, false> }
}

struct OfKernel<'a, T, K, const IN_1D: bool> {
    lists: Evaluate<'a, T>,
    kernel: PhantomData<K>,
}

impl<T: Real, K: Kernel, const IN_1D: bool> Job<T> for OfKernel<'_, T, K, IN_1D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        let Evaluate { squares, scale, profiles, slopes } = self.lists;
        let (scale, width) = (I::Reg::splat(scale), I::Reg::WIDTH);
        if slopes.is_empty() {
            let profiles = &mut profiles[..squares.len()];
            for first in (0..squares.len()).step_by(width) {
                profile::<I::Reg, K>(q(squares, first, scale), IN_1D)
                    .store(&mut profiles[first..first + width]);
            }
        } else if profiles.is_empty() {
            let slopes = &mut slopes[..squares.len()];
            for first in (0..squares.len()).step_by(width) {
                slope::<T, I::Reg, K>(q(squares, first, scale), IN_1D)
                    .store(&mut slopes[first..first + width]);
            }
        } else {
            let (profiles, slopes) = (&mut profiles[..squares.len()], &mut slopes[..squares.len()]);
            for first in (0..squares.len()).step_by(width) {
                let q = q(squares, first, scale);
                slope::<T, I::Reg, K>(q, IN_1D).store(&mut slopes[first..first + width]);
                profile::<I::Reg, K>(q, IN_1D).store(&mut profiles[first..first + width]);
            }
        }
    }
}
