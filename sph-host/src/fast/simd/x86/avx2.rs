//! Registers of 256 bits: AVX2.

use std::arch::x86_64::{__m128, __m256, __m256d, __m256i, _CMP_GT_OQ, _CMP_LT_OQ};

use pulp::x86::V3;
use pulp::{Simd, cast};

use super::super::Isa;
use super::super::array::first;

register! {
    F32x8: 8 x f32 in __m256, by v: V3;
    avx: _mm256_set1_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps;
    negate(a) => v.avx._mm256_xor_ps(a, v.avx._mm256_set1_ps(-0.0));
    root(a) => v.avx._mm256_sqrt_ps(a);
    min(a, b) => v.avx._mm256_min_ps(a, b);
    max(a, b) => v.avx._mm256_max_ps(a, b);
    where_above_zero(a, condition) => {
        v.avx._mm256_and_ps(v.avx._mm256_cmp_ps::<_CMP_GT_OQ>(condition, v.avx._mm256_setzero_ps()), a)
    };
    total(a) => v.reduce_sum_f32s(cast(a));
}

register! {
    F64x4: 4 x f64 in __m256d, by v: V3;
    avx: _mm256_set1_pd _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd;
    negate(a) => v.avx._mm256_xor_pd(a, v.avx._mm256_set1_pd(-0.0));
    root(a) => v.avx._mm256_sqrt_pd(a);
    min(a, b) => v.avx._mm256_min_pd(a, b);
    max(a, b) => v.avx._mm256_max_pd(a, b);
    where_above_zero(a, condition) => {
        v.avx._mm256_and_pd(v.avx._mm256_cmp_pd::<_CMP_GT_OQ>(condition, v.avx._mm256_setzero_pd()), a)
    };
    total(a) => v.reduce_sum_f64s(cast(a));
}

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

/// For each mask of four lanes of 32 bits, the lanes that are set, in order.
static LANES_OF_4: [[u32; 4]; 16] = {
    let mut table = [[0; 4]; 16];
    let mut mask = 0;
    while mask < 16 {
        let mut lane = 0;
        while lane < 4 {
            table[mask][lane] = LANES_OF_8[mask][lane];
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// AVX2.
#[derive(Clone, Copy)]
pub(super) struct Avx2(V3);

impl Avx2 {
    #[inline(always)]
    pub(super) fn new(token: V3) -> Self {
        Self(token)
    }

    /// One quadruple after another.
    #[inline(always)]
    fn join(self, a: &[f32; 4], b: &[f32; 4]) -> __m256 {
        let v = self.0.avx;
        let a: __m128 = cast(*a);
        v._mm256_insertf128_ps::<1>(v._mm256_castps128_ps256(a), cast(*b))
    }
}

impl Isa<f32> for Avx2 {
    type Reg = F32x8;
    type Parts<U: Copy> = [U; 2];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 2] {
        [value; 2]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f32; 4]) -> [F32x8; 4] {
        let v = self.0.avx;
        let (a, b) = (self.join(quadruple(0), quadruple(4)), self.join(quadruple(1), quadruple(5)));
        let (c, d) = (self.join(quadruple(2), quadruple(6)), self.join(quadruple(3), quadruple(7)));
        let (ab, cd) = (v._mm256_unpacklo_ps(a, b), v._mm256_unpacklo_ps(c, d));
        let (ab_rest, cd_rest) = (v._mm256_unpackhi_ps(a, b), v._mm256_unpackhi_ps(c, d));
        [
            F32x8(v._mm256_shuffle_ps::<0x44>(ab, cd)),
            F32x8(v._mm256_shuffle_ps::<0xee>(ab, cd)),
            F32x8(v._mm256_shuffle_ps::<0x44>(ab_rest, cd_rest)),
            F32x8(v._mm256_shuffle_ps::<0xee>(ab_rest, cd_rest)),
        ]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F32x8, b: F32x8) -> u32 {
        self.0.avx._mm256_movemask_ps(self.0.avx._mm256_cmp_ps::<_CMP_LT_OQ>(a.0, b.0)) as u32
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: F32x8, out: &mut [f32]) {
        let lanes: __m256i = cast(LANES_OF_8[(mask & 0xff) as usize]);
        let packed = self.0.avx2._mm256_permutevar8x32_ps(values.0, lanes);
        *out.first_chunk_mut::<8>().expect("room for a register") = cast(packed);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]) {
        let lanes: __m256i = cast(LANES_OF_8[(mask & 0xff) as usize]);
        let packed = self.0.avx2._mm256_permutevar8x32_epi32(cast(*first::<8>(places)), lanes);
        *out.first_chunk_mut::<8>().expect("room for a register") = cast(packed);
    }
}

impl Isa<f64> for Avx2 {
    type Reg = F64x4;
    type Parts<U: Copy> = [U; 4];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 4] {
        [value; 4]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f64; 4]) -> [F64x4; 4] {
        let v = self.0.avx;
        let [a, b, c, d]: [__m256d; 4] =
            [cast(*quadruple(0)), cast(*quadruple(1)), cast(*quadruple(2)), cast(*quadruple(3))];
        let (ab, cd) = (v._mm256_unpacklo_pd(a, b), v._mm256_unpacklo_pd(c, d));
        let (ab_rest, cd_rest) = (v._mm256_unpackhi_pd(a, b), v._mm256_unpackhi_pd(c, d));
        [
            F64x4(v._mm256_permute2f128_pd::<0x20>(ab, cd)),
            F64x4(v._mm256_permute2f128_pd::<0x20>(ab_rest, cd_rest)),
            F64x4(v._mm256_permute2f128_pd::<0x31>(ab, cd)),
            F64x4(v._mm256_permute2f128_pd::<0x31>(ab_rest, cd_rest)),
        ]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F64x4, b: F64x4) -> u32 {
        self.0.avx._mm256_movemask_pd(self.0.avx._mm256_cmp_pd::<_CMP_LT_OQ>(a.0, b.0)) as u32
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: F64x4, out: &mut [f64]) {
        let halves: __m256i = cast(HALVES_OF_4[(mask & 0xf) as usize]);
        let packed = self.0.avx2._mm256_permutevar8x32_ps(cast(values.0), halves);
        *out.first_chunk_mut::<4>().expect("room for a register") = cast(packed);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]) {
        let lanes = LANES_OF_4[(mask & 0xf) as usize];
        let packed = self.0.avx._mm_permutevar_ps(cast(*first::<4>(places)), cast(lanes));
        *out.first_chunk_mut::<4>().expect("room for a register") = cast(packed);
    }
}
