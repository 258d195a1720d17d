//! Kernels, a register at a time.

use std::marker::PhantomData;

use sph_core::kernel::Kernel;
use sph_core::{Arithmetic, Lane};

use super::simd::{Isa, Job, Real, Register};

/// f(q) in D dimensions.
#[inline(always)]
pub(super) fn profile<T: Arithmetic, K: Kernel, const D: usize>(q: T) -> T {
    if D == 1 { K::profile_in_1d(q) } else { K::profile(q) }
}

/// f′(q) / q in D dimensions. At q = 0 it is some finite number: it is multiplied with x = 0 there.
#[inline(always)]
fn slope<T: Real, R: Register<T>, K: Kernel, const D: usize>(q: R) -> R {
    let slope = if D == 1 { K::slope_in_1d(q) } else { K::slope(q) };
    slope / q.max(R::splat(T::SMALL))
}

/// f(q) and f′(q) / q for many particles.
pub(crate) struct Evaluate<'a, T, K, const D: usize> {
    /// r², in whole blocks.
    pub(crate) squares: &'a [T],
    /// 1 / h
    pub(crate) inverse: T,
    /// 1 / h_j, where each has its own.
    pub(crate) inverses: Option<&'a [T]>,
    /// Overwritten: f(q); empty where values are not wanted.
    pub(crate) profiles: &'a mut [T],
    /// Overwritten: f′(q) / q; empty where gradients are not wanted.
    pub(crate) slopes: &'a mut [T],
    pub(crate) kernel: PhantomData<K>,
}

impl<T: Real, K: Kernel, const D: usize> Job<T> for Evaluate<'_, T, K, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        let Self { squares, inverses, profiles, slopes, .. } = self;
        let uniform = I::Reg::splat(self.inverse * self.inverse);
        let width = I::Reg::WIDTH;
        let count = squares.len();
        let (with_profiles, with_slopes) = (!profiles.is_empty(), !slopes.is_empty());
        let profiles = if with_profiles { &mut profiles[..count] } else { profiles };
        let slopes = if with_slopes { &mut slopes[..count] } else { slopes };
        for first in (0..count).step_by(width) {
            let square = I::Reg::load_at(squares, first);
            let scale = match inverses {
                None => uniform,
                Some(inverses) => {
                    let inverse = I::Reg::load_at(inverses, first);
                    inverse * inverse
                }
            };
            // held at 1, beyond which every kernel is zero
            let q = (square * scale).min(I::Reg::ONE).root();
            if with_slopes {
                slope::<T, I::Reg, K, D>(q).store(&mut slopes[first..first + width]);
            }
            if with_profiles {
                profile::<I::Reg, K, D>(q).store(&mut profiles[first..first + width]);
            }
        }
    }
}
