//! What differs between instruction sets: which of sixteen squares are below a bound, and moving those together.
//!
//! Everything else is written once, as loops over arrays of fixed length that the compiler turns into vectors. A [`Job`] is
//! compiled for each [`InstructionSet`], and the best that the processor has runs. All levels give the same bits: none fuses a
//! multiplication with an addition, and sums run over sixteen columns whatever the width of a vector.
//!
//! There is no `unsafe` here: pulp's tokens prove that the processor has an instruction before it can be named.

use sph_core::Scalar;

/// Candidates that are looked at together.
pub(crate) const BLOCK: usize = 16;

/// The instruction set of one [`Job`].
pub trait Isa<T>: Copy {
    /// Bit k: `squares[k] < limits[k]`.
    fn below(self, squares: &[T; BLOCK], limits: &[T; BLOCK]) -> u32;

    /// Moves the values whose bit is set to the front of `out`; what follows them is left open.
    fn pack(self, mask: u32, values: &[T; BLOCK], out: &mut [T; BLOCK]);

    /// Likewise places.
    fn pack_places(self, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]);

    /// Sixteen quadruples turned over: all the first numbers, all the second, …
    #[inline(always)]
    fn turn(self, quadruples: &[&[T; 4]; BLOCK]) -> [[T; BLOCK]; 4]
    where
        T: Copy,
    {
        std::array::from_fn(
            #[inline(always)]
            |number| {
                std::array::from_fn(
                    #[inline(always)]
                    |k| quadruples[k][number],
                )
            },
        )
    }
}

/// Work that is compiled once for each instruction set.
pub trait Job<T> {
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
    /// √x by the processor's instruction, which rounds correctly, as libm's does.
    #[doc(hidden)]
    fn root(self) -> Self;

    /// So small that the square of a smaller distance, in units of h, is hardly a number.
    #[doc(hidden)]
    const SMALL: Self;
}

impl Real for f32 {
    const SMALL: Self = 1e-18;

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
}

impl Real for f64 {
    const SMALL: Self = 1e-150;

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
}

mod sealed {
    use super::{InstructionSet, Job};

    /// Runs jobs on vectors of a float.
    pub trait Sealed: Sized {
        /// Runs a job at a level, or at the next lower one that the processor has.
        fn dispatch<J: Job<Self>>(level: InstructionSet, job: J) -> J::Output;
    }
}

/// Without any instruction of its own.
#[derive(Clone, Copy)]
struct Baseline;

impl<T: Real> Isa<T> for Baseline {
    #[inline(always)]
    fn below(self, squares: &[T; BLOCK], limits: &[T; BLOCK]) -> u32 {
        let mut mask = 0;
        for k in 0..BLOCK {
            mask |= u32::from(squares[k] < limits[k]) << k;
        }
        mask
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: &[T; BLOCK], out: &mut [T; BLOCK]) {
        pack(mask, values, out);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]) {
        pack(mask, places, out);
    }
}

#[inline(always)]
fn pack<V: Copy>(mask: u32, values: &[V; BLOCK], out: &mut [V; BLOCK]) {
    let mut end = 0;
    for k in 0..BLOCK {
        out[end & (BLOCK - 1)] = values[k];
        end += (mask >> k & 1) as usize;
    }
}

#[cfg(target_arch = "x86_64")]
mod turn;
#[cfg(target_arch = "x86_64")]
mod x86;

#[cfg(not(target_arch = "x86_64"))]
mod other {
    use super::*;

    impl sealed::Sealed for f32 {
        fn dispatch<J: Job<Self>>(_: InstructionSet, job: J) -> J::Output {
            job.run(Baseline)
        }
    }

    impl sealed::Sealed for f64 {
        fn dispatch<J: Job<Self>>(_: InstructionSet, job: J) -> J::Output {
            job.run(Baseline)
        }
    }
}
