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

/// q = r/h, held at 1, beyond which every kernel is zero.
#[inline(always)]
fn q<T: Real, R: Register<T>>(square: R, scale: R) -> R {
    (square * scale).min(R::ONE).root()
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
        let uniform = I::Reg::splat(self.inverse * self.inverse);
        match self.inverses {
            None => self.all::<I>(
                #[inline(always)]
                |_| uniform,
            ),
            Some(inverses) => {
                let inverses = &inverses[..self.squares.len()];
                self.all::<I>(
                    #[inline(always)]
                    |first| {
                        let inverse = I::Reg::load_at(inverses, first);
                        inverse * inverse
                    },
                );
            }
        }
    }
}

impl<T: Real, K: Kernel, const D: usize> Evaluate<'_, T, K, D> {
    /// `scale` has 1 / h² of the particles from a place on.
    #[inline(always)]
    fn all<I: Isa<T>>(self, scale: impl Fn(usize) -> I::Reg) {
        let Self { squares, profiles, slopes, .. } = self;
        let width = I::Reg::WIDTH;
        let squares = squares.chunks_exact(width).enumerate();
        if slopes.is_empty() {
            for ((number, squares), profiles) in squares.zip(profiles.chunks_exact_mut(width)) {
                profile::<I::Reg, K, D>(q(I::Reg::load(squares), scale(number * width))).store(profiles);
            }
        } else if profiles.is_empty() {
            for ((number, squares), slopes) in squares.zip(slopes.chunks_exact_mut(width)) {
                slope::<T, I::Reg, K, D>(q(I::Reg::load(squares), scale(number * width))).store(slopes);
            }
        } else {
            let out = profiles.chunks_exact_mut(width).zip(slopes.chunks_exact_mut(width));
            for ((number, squares), (profiles, slopes)) in squares.zip(out) {
                let q = q(I::Reg::load(squares), scale(number * width));
                slope::<T, I::Reg, K, D>(q).store(slopes);
                profile::<I::Reg, K, D>(q).store(profiles);
            }
        }
    }
}
