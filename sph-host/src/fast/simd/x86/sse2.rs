//! Registers of 128 bits: SSE2, which every x86-64 processor has.

use std::arch::x86_64::{__m128, __m128d};

use pulp::cast;
use pulp::x86::V1;

use super::super::Isa;
use super::super::array::{first, pack, total};

register! {
    F32x4: 4 x f32 in __m128, by v: V1;
    sse: _mm_set1_ps _mm_add_ps _mm_sub_ps _mm_mul_ps _mm_div_ps;
    negate(a) => v.sse._mm_xor_ps(a, v.sse._mm_set1_ps(-0.0));
    root(a) => v.sse._mm_sqrt_ps(a);
    min(a, b) => v.sse._mm_min_ps(a, b);
    max(a, b) => v.sse._mm_max_ps(a, b);
    where_above_zero(a, condition) => v.sse._mm_and_ps(v.sse._mm_cmpgt_ps(condition, v.sse._mm_setzero_ps()), a);
    total(a) => total::<f32, 4>(cast(a));
}

register! {
    F64x2: 2 x f64 in __m128d, by v: V1;
    sse2: _mm_set1_pd _mm_add_pd _mm_sub_pd _mm_mul_pd _mm_div_pd;
    negate(a) => v.sse2._mm_xor_pd(a, v.sse2._mm_set1_pd(-0.0));
    root(a) => v.sse2._mm_sqrt_pd(a);
    min(a, b) => v.sse2._mm_min_pd(a, b);
    max(a, b) => v.sse2._mm_max_pd(a, b);
    where_above_zero(a, condition) => v.sse2._mm_and_pd(v.sse2._mm_cmpgt_pd(condition, v.sse2._mm_setzero_pd()), a);
    total(a) => total::<f64, 2>(cast(a));
}

/// SSE2.
#[derive(Clone, Copy)]
pub(super) struct Sse2(V1);

impl Sse2 {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self(V1::try_new().expect("every x86-64 processor has SSE2"))
    }
}

impl Isa<f32> for Sse2 {
    type Reg = F32x4;
    type Parts<U: Copy> = [U; 4];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 4] {
        [value; 4]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f32; 4]) -> [F32x4; 4] {
        let v = self.0.sse;
        let [a, b, c, d]: [__m128; 4] =
            [cast(*quadruple(0)), cast(*quadruple(1)), cast(*quadruple(2)), cast(*quadruple(3))];
        let (ab, cd) = (v._mm_unpacklo_ps(a, b), v._mm_unpacklo_ps(c, d));
        let (ab_rest, cd_rest) = (v._mm_unpackhi_ps(a, b), v._mm_unpackhi_ps(c, d));
        [
            F32x4(v._mm_movelh_ps(ab, cd)),
            F32x4(v._mm_movehl_ps(cd, ab)),
            F32x4(v._mm_movelh_ps(ab_rest, cd_rest)),
            F32x4(v._mm_movehl_ps(cd_rest, ab_rest)),
        ]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F32x4, b: F32x4) -> u32 {
        self.0.sse._mm_movemask_ps(self.0.sse._mm_cmplt_ps(a.0, b.0)) as u32
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: F32x4, out: &mut [f32]) {
        pack::<f32, 4>(mask, &cast(values.0), out);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]) {
        pack(mask, first::<4>(places), out);
    }
}

impl Isa<f64> for Sse2 {
    type Reg = F64x2;
    type Parts<U: Copy> = [U; 8];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 8] {
        [value; 8]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f64; 4]) -> [F64x2; 4] {
        let v = self.0.sse2;
        let [[a, a_rest], [b, b_rest]]: [[__m128d; 2]; 2] = [cast(*quadruple(0)), cast(*quadruple(1))];
        [
            F64x2(v._mm_unpacklo_pd(a, b)),
            F64x2(v._mm_unpackhi_pd(a, b)),
            F64x2(v._mm_unpacklo_pd(a_rest, b_rest)),
            F64x2(v._mm_unpackhi_pd(a_rest, b_rest)),
        ]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F64x2, b: F64x2) -> u32 {
        self.0.sse2._mm_movemask_pd(self.0.sse2._mm_cmplt_pd(a.0, b.0)) as u32
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: F64x2, out: &mut [f64]) {
        pack::<f64, 2>(mask, &cast(values.0), out);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]) {
        pack(mask, first::<2>(places), out);
    }
}
