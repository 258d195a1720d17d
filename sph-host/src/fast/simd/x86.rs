//! The instruction sets of x86-64.

use std::marker::PhantomData;

use pulp::x86::{V3, V4};
use pulp::{Simd, WithSimd};

use self::avx2::Avx2;
use self::avx512::Avx512;
use self::sse2::Sse2;
use super::{InstructionSet, Isa, Job, sealed::Sealed};

mod avx2;
mod avx512;
mod sse2;

/// A job on its way into a function that is compiled for an instruction set.
struct Inside<T, I, J> {
    isa: I,
    job: J,
    float: PhantomData<T>,
}

impl<T: Copy, I: Isa<T>, J: Job<T>> WithSimd for Inside<T, I, J> {
    type Output = J::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> J::Output {
        self.job.run(self.isa)
    }
}

macro_rules! dispatch {
    ($Real:ident) => {
        impl Sealed for $Real {
            fn dispatch<J: Job<Self>>(level: InstructionSet, job: J) -> J::Output {
                if let (InstructionSet::Avx512, Some(token)) = (level, V4::try_new()) {
                    let isa = Avx512::new(token);
                    return Simd::vectorize(token, Inside::<$Real, _, _> { isa, job, float: PhantomData });
                }
                if let (InstructionSet::Avx2 | InstructionSet::Avx512, Some(token)) = (level, V3::try_new()) {
                    let isa = Avx2::new(token);
                    return Simd::vectorize(token, Inside::<$Real, _, _> { isa, job, float: PhantomData });
                }
                job.run(Sse2::new())
            }
        }
    };
}

dispatch!(f32);
dispatch!(f64);
