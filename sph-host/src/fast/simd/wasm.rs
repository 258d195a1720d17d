//! Registers of WebAssembly: simd128.

use std::arch::wasm32::v128;

use pulp::cast;
use pulp::wasm::Simd128 as Token;

use super::array::{first, less_than_mask, pack, total, transpose};
use super::{InstructionSet, Isa, Job, sealed::Sealed};

// pmin(b, a) is `a < b ? a : b`
register! {
    F32x4: 4 x f32 in v128, by v: Token;
    simd128: f32x4_splat f32x4_add f32x4_sub f32x4_mul f32x4_div;
    negate(a) => v.simd128.f32x4_neg(a);
    root(a) => v.simd128.f32x4_sqrt(a);
    min(a, b) => v.simd128.f32x4_pmin(b, a);
    max(a, b) => v.simd128.f32x4_pmax(b, a);
    where_above_zero(a, condition) => {
        v.simd128.v128_and(v.simd128.f32x4_gt(condition, v.simd128.f32x4_splat(0.0)), a)
    };
    total(a) => total::<f32, 4>(cast(a));
}

// pmin(b, a) is `a < b ? a : b`
register! {
    F64x2: 2 x f64 in v128, by v: Token;
    simd128: f64x2_splat f64x2_add f64x2_sub f64x2_mul f64x2_div;
    negate(a) => v.simd128.f64x2_neg(a);
    root(a) => v.simd128.f64x2_sqrt(a);
    min(a, b) => v.simd128.f64x2_pmin(b, a);
    max(a, b) => v.simd128.f64x2_pmax(b, a);
    where_above_zero(a, condition) => {
        v.simd128.v128_and(v.simd128.f64x2_gt(condition, v.simd128.f64x2_splat(0.0)), a)
    };
    total(a) => total::<f64, 2>(cast(a));
}

/// simd128.
#[derive(Clone, Copy)]
struct Wasm(Token);

impl Wasm {
    fn new() -> Self {
        Self(Token::try_new().expect("the target has simd128"))
    }
}

impl Isa<f32> for Wasm {
    type Reg = F32x4;
    type Parts<U: Copy> = [U; 4];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 4] {
        [value; 4]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f32; 4]) -> [F32x4; 4] {
        let [a, b, c, d] = transpose::<f32, 4>(quadruple);
        [F32x4(cast(a)), F32x4(cast(b)), F32x4(cast(c)), F32x4(cast(d))]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F32x4, b: F32x4) -> u32 {
        less_than_mask::<f32, 4>(cast(a.0), cast(b.0))
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

impl Isa<f64> for Wasm {
    type Reg = F64x2;
    type Parts<U: Copy> = [U; 8];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 8] {
        [value; 8]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [f64; 4]) -> [F64x2; 4] {
        let [a, b, c, d] = transpose::<f64, 2>(quadruple);
        [F64x2(cast(a)), F64x2(cast(b)), F64x2(cast(c)), F64x2(cast(d))]
    }

    #[inline(always)]
    fn less_than_mask(self, a: F64x2, b: F64x2) -> u32 {
        less_than_mask::<f64, 2>(cast(a.0), cast(b.0))
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

impl Sealed for f32 {
    fn dispatch<J: Job<Self>>(_: InstructionSet, job: J) -> J::Output {
        job.run(Wasm::new())
    }
}

impl Sealed for f64 {
    fn dispatch<J: Job<Self>>(_: InstructionSet, job: J) -> J::Output {
        job.run(Wasm::new())
    }
}
