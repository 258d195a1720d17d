//! Registers of 512 bits: AVX-512.

use std::arch::x86_64::{__m128, __m512, __m512d};

use pulp::x86::V4;
use pulp::{Simd, cast};

use super::super::Isa;
use super::super::array::first;

register! {
    F32x16: 16 x f32 in __m512, by v: V4;
    avx512f: _mm512_set1_ps _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps;
    negate(a) => v.avx512dq._mm512_xor_ps(a, v.avx512f._mm512_set1_ps(-0.0));
    root(a) => v.avx512f._mm512_sqrt_ps(a);
    min(a, b) => v.avx512f._mm512_min_ps(a, b);
    max(a, b) => v.avx512f._mm512_max_ps(a, b);
    where_above_zero(a, condition) => {
        let above = v.avx512f._mm512_cmplt_ps_mask(v.avx512f._mm512_setzero_ps(), condition);
        v.avx512f._mm512_maskz_mov_ps(above, a)
    };
    total(a) => v.reduce_sum_f32s(cast(a));
}

register! {
    F64x8: 8 x f64 in __m512d, by v: V4;
    avx512f: _mm512_set1_pd _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd;
    negate(a) => v.avx512dq._mm512_xor_pd(a, v.avx512f._mm512_set1_pd(-0.0));
    root(a) => v.avx512f._mm512_sqrt_pd(a);
    min(a, b) => v.avx512f._mm512_min_pd(a, b);
    max(a, b) => v.avx512f._mm512_max_pd(a, b);
    where_above_zero(a, condition) => {
        let above = v.avx512f._mm512_cmplt_pd_mask(v.avx512f._mm512_setzero_pd(), condition);
        v.avx512f._mm512_maskz_mov_pd(above, a)
    };
    total(a) => v.reduce_sum_f64s(cast(a));
}

/// AVX-512.
#[derive(Clone, Copy)]
pub(super) struct Avx512(V4);

impl Avx512 {
    #[inline(always)]
    pub(super) fn new(token: V4) -> Self {
        Self(token)
    }

    /// 16 bytes of each of four quadruples, one after another.
    #[inline(always)]
    fn join(self, quarters: [__m128; 4]) -> __m512 {
        let (v, [a, b, c, d]) = (self.0.avx512f, quarters);
        let ab = v._mm512_insertf32x4::<1>(v._mm512_castps128_ps512(a), b);
        v._mm512_insertf32x4::<3>(v._mm512_insertf32x4::<2>(ab, c), d)
    }
}

/// Half of a quadruple.
#[inline(always)]
fn half(quadruple: &[f64; 4], from: usize) -> __m128 {
    cast([quadruple[from], quadruple[from + 1]])
}

impl Isa<f32> for Avx512 {
    type Reg = F32x16;
    type Parts<U: Copy> = [U; 1];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 1] {
        [value]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f32; 4]) -> [F32x16; 4] {
        let v = self.0.avx512f;
        let mut abcd = [v._mm512_setzero_ps(); 4];
        for k in 0..4 {
            abcd[k] = self.join([
                cast(*quadruple(k)),
                cast(*quadruple(k + 4)),
                cast(*quadruple(k + 8)),
                cast(*quadruple(k + 12)),
            ]);
        }
        let [a, b, c, d] = abcd;
        let (ab, cd) = (v._mm512_unpacklo_ps(a, b), v._mm512_unpacklo_ps(c, d));
        let (ab_rest, cd_rest) = (v._mm512_unpackhi_ps(a, b), v._mm512_unpackhi_ps(c, d));
        [
            F32x16(v._mm512_shuffle_ps::<0x44>(ab, cd)),
            F32x16(v._mm512_shuffle_ps::<0xee>(ab, cd)),
            F32x16(v._mm512_shuffle_ps::<0x44>(ab_rest, cd_rest)),
            F32x16(v._mm512_shuffle_ps::<0xee>(ab_rest, cd_rest)),
        ]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F32x16, b: F32x16) -> u32 {
        self.0.avx512f._mm512_cmplt_ps_mask(a.0, b.0).into()
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: F32x16, out: &mut [f32]) {
        let packed = self.0.avx512f._mm512_maskz_compress_ps(mask as u16, values.0);
        *out.first_chunk_mut::<16>().expect("room for a register") = cast(packed);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]) {
        let packed = self.0.avx512f._mm512_maskz_compress_epi32(mask as u16, cast(*first::<16>(places)));
        *out.first_chunk_mut::<16>().expect("room for a register") = cast(packed);
    }
}

impl Isa<f64> for Avx512 {
    type Reg = F64x8;
    type Parts<U: Copy> = [U; 2];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 2] {
        [value; 2]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f64; 4]) -> [F64x8; 4] {
        let v = self.0.avx512f;
        let mut halves = [[v._mm512_setzero_pd(); 2]; 2];
        for from in 0..2 {
            for k in 0..2 {
                halves[from][k] = cast(self.join([
                    half(quadruple(k), 2 * from),
                    half(quadruple(k + 2), 2 * from),
                    half(quadruple(k + 4), 2 * from),
                    half(quadruple(k + 6), 2 * from),
                ]));
            }
        }
        let [[even, odd], [even_rest, odd_rest]] = halves;
        [
            F64x8(v._mm512_unpacklo_pd(even, odd)),
            F64x8(v._mm512_unpackhi_pd(even, odd)),
            F64x8(v._mm512_unpacklo_pd(even_rest, odd_rest)),
            F64x8(v._mm512_unpackhi_pd(even_rest, odd_rest)),
        ]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F64x8, b: F64x8) -> u32 {
        self.0.avx512f._mm512_cmplt_pd_mask(a.0, b.0).into()
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: F64x8, out: &mut [f64]) {
        let packed = self.0.avx512f._mm512_maskz_compress_pd(mask as u8, values.0);
        *out.first_chunk_mut::<8>().expect("room for a register") = cast(packed);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]) {
        let packed = self.0.avx512f._mm256_maskz_compress_epi32(mask as u8, cast(*first::<8>(places)));
        *out.first_chunk_mut::<8>().expect("room for a register") = cast(packed);
    }
}
