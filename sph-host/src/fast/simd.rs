//! What differs between instruction sets: a register of numbers, and moving numbers between registers.
//!
//! Everything else is written once, over an [`Isa`] and its [`Register`]. A [`Job`] is compiled for each [`InstructionSet`], and
//! the best that the processor has runs. All levels give the same bits: none fuses a multiplication with an addition, and sums
//! run over sixteen columns whatever the width of a register: over one register of sixteen numbers, two of eight, four of four …
//!
//! | file | registers |
//! |---|---|
//! | `x86/sse2` | 4 `f32`, 2 `f64`: every x86-64 processor |
//! | `x86/avx2` | 8 `f32`, 4 `f64` |
//! | `x86/avx512` | 16 `f32`, 8 `f64` |
//! | `neon`, `wasm` | 4 `f32`, 2 `f64` |
//! | `portable` | 4 `f32`, 4 `f64`, in arrays: every other target |
//!
//! pulp's tokens prove that the processor has an instruction before it can be named. A register carries no token, so the operators
//! get theirs from a constant in `register`, the only `unsafe` of this crate.

use sph_core::{Lane, Scalar};

/// Columns of every sum, and candidates that are tested together.
pub(crate) const BLOCK: usize = 16;

/// One register: WIDTH numbers side by side, each of which belongs to a pair of its own.
pub trait Register<T>: Lane<T, Sum = Self> {
    /// How many numbers it has: a power of two that divides [`BLOCK`].
    const WIDTH: usize;

    /// Loads the first WIDTH numbers of a list, which must have as many.
    fn load(from: &[T]) -> Self;

    /// Loads the WIDTH numbers of a list from a place on.
    #[inline(always)]
    fn load_at(from: &[T], first: usize) -> Self {
        Self::load(&from[first..first + Self::WIDTH])
    }

    /// Stores the numbers as the first of a list, which must have room.
    fn store(self, to: &mut [T]);

    /// √x of each number, rounded correctly.
    fn root(self) -> Self;

    /// The smaller of each two numbers; `other` where they are not comparable.
    fn min(self, other: Self) -> Self;

    /// The larger of each two numbers; `other` where they are not comparable.
    fn max(self, other: Self) -> Self;
}

/// The instruction set of one [`Job`].
pub trait Isa<T: Copy>: Copy {
    /// What a lane is here.
    type Reg: Register<T>;

    /// Registers that make sixteen columns.
    const PARTS: usize = BLOCK / Self::Reg::WIDTH;

    /// A value for each part: `[U; PARTS]`.
    type Parts<U: Copy>: Copy + AsRef<[U]> + AsMut<[U]>;

    /// A bit for each number of a register.
    const ALL: u32 = (1 << Self::Reg::WIDTH) - 1;

    /// The same value for each part.
    fn parts<U: Copy>(value: U) -> Self::Parts<U>;

    /// Gathers WIDTH quadruples and transposes them: all the first numbers, all the second, …
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [T; 4]) -> [Self::Reg; 4]
    where
        T: 'a;

    /// Bit k: `a[k] < b[k]`. Bits from WIDTH on are zero.
    fn less_than_mask(self, a: Self::Reg, b: Self::Reg) -> u32;

    /// Moves the numbers whose bit is set to the front of `out`, which has room for WIDTH: what follows them is left open. Bits
    /// from WIDTH on are ignored.
    fn pack(self, mask: u32, values: Self::Reg, out: &mut [T]);

    /// Likewise the first WIDTH of some places.
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]);

    /// Joins the sums of all parts, halves first: the order in which [`Lane::total`] adds up the columns of one register.
    #[inline(always)]
    fn join_parts<U: Copy>(mut parts: Self::Parts<U>, join: impl Fn(&mut U, &U)) -> U {
        let parts = parts.as_mut();
        let mut half = Self::PARTS / 2;
        while half > 0 {
            for part in 0..half {
                let other = parts[part + half];
                join(&mut parts[part], &other);
            }
            half /= 2;
        }
        parts[0]
    }

    /// A vector of the same register for all axes.
    #[inline(always)]
    fn splat_vector<const D: usize>(x: &[T; D]) -> [Self::Reg; D] {
        let mut wide = [Self::Reg::EMPTY; D];
        for axis in 0..D {
            wide[axis] = Self::Reg::splat(x[axis]);
        }
        wide
    }

    /// The sum of sixteen columns.
    #[inline(always)]
    fn total_of_parts(parts: Self::Parts<Self::Reg>) -> T {
        let joined = Self::join_parts(
            parts,
            #[inline(always)]
            |sum, other| *sum += *other,
        );
        Self::Reg::total(joined)
    }
}

/// Work that is compiled once for each instruction set.
pub trait Job<T: Copy> {
    /// What comes of it.
    type Output;

    /// Does the work. Must be `#[inline(always)]`, with all that it calls in a hot loop.
    fn run<I: Isa<T>>(self, isa: I) -> Self::Output;
}

/// An instruction set that the fast path has code for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// What every processor of this architecture has: SSE2 on x86-64, NEON on AArch64.
    Baseline,
    /// x86-64-v3: AVX2.
    Avx2,
    /// x86-64-v4: AVX-512.
    Avx512,
}

impl InstructionSet {
    /// The best that this processor has.
    ///
    /// ```
    /// use sph_host::fast::InstructionSet;
    /// assert_eq!(InstructionSet::available().last(), Some(&InstructionSet::best()));
    /// ```
    #[must_use]
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if pulp::x86::V4::try_new().is_some() {
                return Self::Avx512;
            }
            if pulp::x86::V3::try_new().is_some() {
                return Self::Avx2;
            }
        }
        Self::Baseline
    }

    /// Those that this processor has, the best last.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let best = Self::best();
        [Self::Baseline, Self::Avx2, Self::Avx512].into_iter().filter(|&level| level <= best).collect()
    }
}

/// A float that the fast path computes in: f32 or f64.
pub trait Real: Scalar + sealed::Sealed {
    /// So small that the square of a smaller distance, in units of h, is hardly a number.
    #[doc(hidden)]
    const SMALL: Self;
}

impl Real for f32 {
    const SMALL: Self = 1e-18;
}

impl Real for f64 {
    const SMALL: Self = 1e-150;
}

mod sealed {
    use super::{InstructionSet, Job};

    /// Runs jobs on registers of a float.
    pub trait Sealed: Copy {
        /// Runs a job at a level, or at the next lower one that the processor has.
        fn dispatch<J: Job<Self>>(level: InstructionSet, job: J) -> J::Output;
    }
}

#[macro_use]
mod register;
mod array;
#[cfg(target_arch = "aarch64")]
mod neon;
#[cfg(any(test, not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128"))))]
mod portable;
#[cfg(test)]
mod tests;
#[cfg(target_feature = "simd128")]
mod wasm;
#[cfg(target_arch = "x86_64")]
mod x86;
