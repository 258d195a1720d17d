//! AVX2 and AVX-512.

use std::arch::x86_64::{__m256, __m256d, __m256i, __m512, __m512d, _CMP_LT_OQ};
use std::marker::PhantomData;

use pulp::x86::{V3, V4};
use pulp::{Simd, WithSimd, cast};

use super::turn::{turn_f32, turn_f64};
use super::{BLOCK, Baseline, InstructionSet, Isa, Job, sealed::Sealed};

/// A job on its way into a function that is compiled for V3 or V4.
struct Inside<T, I, J> {
    isa: I,
    job: J,
    float: PhantomData<T>,
}

impl<T, I: Isa<T>, J: Job<T>> WithSimd for Inside<T, I, J> {
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
                if let (InstructionSet::Avx512, Some(isa)) = (level, V4::try_new()) {
                    return Simd::vectorize(isa, Inside::<$Real, _, _> { isa, job, float: PhantomData });
                }
                if let (InstructionSet::Avx2 | InstructionSet::Avx512, Some(isa)) = (level, V3::try_new()) {
                    return Simd::vectorize(isa, Inside::<$Real, _, _> { isa, job, float: PhantomData });
                }
                job.run(Baseline)
            }
        }
    };
}

dispatch!(f32);
dispatch!(f64);

/// For each mask of eight lanes of 32 bits, the lanes that are set, in order.
static LANES_OF_8: [[u32; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut end) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask][end] = lane as u32;
                end += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// For each mask of four lanes of 64 bits, the halves of the lanes that are set, in order.
static HALVES_OF_4: [[u32; 8]; 16] = {
    let mut table = [[0; 8]; 16];
    let mut mask = 0;
    while mask < 16 {
        let (mut lane, mut end) = (0, 0);
        while lane < 4 {
            if mask >> lane & 1 == 1 {
                table[mask][end] = 2 * lane as u32;
                table[mask][end + 1] = 2 * lane as u32 + 1;
                end += 2;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// `values[from..from + N]`
#[inline(always)]
fn part<T: Copy, const N: usize>(values: &[T; BLOCK], from: usize) -> [T; N] {
    std::array::from_fn(
        #[inline(always)]
        |k| values[from + k],
    )
}

/// Puts `part` at `out[at..]`, which has room.
#[inline(always)]
fn put<T: Copy, const N: usize>(out: &mut [T; BLOCK], at: u32, part: [T; N]) {
    // what `at` cannot exceed: said for the compiler, so that no place needs a check
    let at = (at as usize).min(BLOCK - N);
    out[at..at + N].copy_from_slice(&part);
}

#[inline(always)]
fn pack_places_avx512(isa: V4, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]) {
    *out = cast(isa.avx512f._mm512_maskz_compress_epi32(mask as u16, cast(*places)));
}

#[inline(always)]
fn pack_places_avx2(isa: V3, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]) {
    for (at, mask, from) in [(0, mask, 0), ((mask & 0xff).count_ones(), mask >> 8, 8)] {
        let places: __m256i = cast(part::<u32, 8>(places, from));
        let lanes: __m256i = cast(LANES_OF_8[(mask & 0xff) as usize]);
        put(out, at, cast::<_, [u32; 8]>(isa.avx2._mm256_permutevar8x32_epi32(places, lanes)));
    }
}

impl Isa<f32> for V4 {
    #[inline(always)]
    fn below(self, squares: &[f32; BLOCK], limits: &[f32; BLOCK]) -> u32 {
        self.avx512f._mm512_cmplt_ps_mask(cast(*squares), cast(*limits)).into()
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: &[f32; BLOCK], out: &mut [f32; BLOCK]) {
        let values: __m512 = cast(*values);
        *out = cast(self.avx512f._mm512_maskz_compress_ps(mask as u16, values));
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]) {
        pack_places_avx512(self, mask, places, out);
    }

    #[inline(always)]
    fn turn(self, quadruples: &[&[f32; 4]; BLOCK]) -> [[f32; BLOCK]; 4] {
        turn_f32(self, quadruples)
    }
}

impl Isa<f64> for V4 {
    #[inline(always)]
    fn below(self, squares: &[f64; BLOCK], limits: &[f64; BLOCK]) -> u32 {
        let mut mask = 0;
        for from in [0, 8] {
            let (squares, limits): ([f64; 8], [f64; 8]) = (part(squares, from), part(limits, from));
            mask |= u32::from(self.avx512f._mm512_cmplt_pd_mask(cast(squares), cast(limits))) << from;
        }
        mask
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: &[f64; BLOCK], out: &mut [f64; BLOCK]) {
        for (at, mask, from) in [(0, mask, 0), ((mask & 0xff).count_ones(), mask >> 8, 8)] {
            let values: __m512d = cast(part::<f64, 8>(values, from));
            put(out, at, cast::<_, [f64; 8]>(self.avx512f._mm512_maskz_compress_pd(mask as u8, values)));
        }
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]) {
        pack_places_avx512(self, mask, places, out);
    }

    #[inline(always)]
    fn turn(self, quadruples: &[&[f64; 4]; BLOCK]) -> [[f64; BLOCK]; 4] {
        turn_f64(self, quadruples)
    }
}

impl Isa<f32> for V3 {
    #[inline(always)]
    fn below(self, squares: &[f32; BLOCK], limits: &[f32; BLOCK]) -> u32 {
        let mut mask = 0;
        for from in [0, 8] {
            let (squares, limits): ([f32; 8], [f32; 8]) = (part(squares, from), part(limits, from));
            let below = self.avx._mm256_cmp_ps::<_CMP_LT_OQ>(cast(squares), cast(limits));
            mask |= (self.avx._mm256_movemask_ps(below) as u32) << from;
        }
        mask
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: &[f32; BLOCK], out: &mut [f32; BLOCK]) {
        for (at, mask, from) in [(0, mask, 0), ((mask & 0xff).count_ones(), mask >> 8, 8)] {
            let values: __m256 = cast(part::<f32, 8>(values, from));
            let lanes: __m256i = cast(LANES_OF_8[(mask & 0xff) as usize]);
            put(out, at, cast::<_, [f32; 8]>(self.avx2._mm256_permutevar8x32_ps(values, lanes)));
        }
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]) {
        pack_places_avx2(self, mask, places, out);
    }
}

impl Isa<f64> for V3 {
    #[inline(always)]
    fn below(self, squares: &[f64; BLOCK], limits: &[f64; BLOCK]) -> u32 {
        let mut mask = 0;
        for from in [0, 4, 8, 12] {
            let (squares, limits): ([f64; 4], [f64; 4]) = (part(squares, from), part(limits, from));
            let below = self.avx._mm256_cmp_pd::<_CMP_LT_OQ>(cast(squares), cast(limits));
            mask |= (self.avx._mm256_movemask_pd(below) as u32) << from;
        }
        mask
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: &[f64; BLOCK], out: &mut [f64; BLOCK]) {
        let mut end = 0;
        for from in [0_u32, 4, 8, 12] {
            let mask = mask >> from & 0xf;
            let values: __m256d = cast(part::<f64, 4>(values, from as usize));
            let halves: __m256i = cast(HALVES_OF_4[mask as usize]);
            let packed = self.avx2._mm256_permutevar8x32_ps(cast(values), halves);
            put(out, end, cast::<_, [f64; 4]>(packed));
            end += mask.count_ones();
        }
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32; BLOCK], out: &mut [u32; BLOCK]) {
        pack_places_avx2(self, mask, places, out);
    }
}
