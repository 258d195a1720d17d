//! Registers of AArch64: NEON.

use std::arch::aarch64::{float32x4_t, float64x2_t};

use pulp::aarch64::Neon as Token;
use pulp::cast;

use super::array::{first, less_than_mask, pack, total, transpose};
use super::{InstructionSet, Isa, Job, sealed::Sealed};

// smaller and larger by comparison: the instructions of that name treat what is not a number in another way than the other sets
register! {
    F32x4: 4 x f32 in float32x4_t, by v: Token;
    neon: vdupq_n_f32 vaddq_f32 vsubq_f32 vmulq_f32 vdivq_f32;
    negate(a) => v.neon.vnegq_f32(a);
    root(a) => v.neon.vsqrtq_f32(a);
    min(a, b) => v.neon.vbslq_f32(v.neon.vcltq_f32(a, b), a, b);
    max(a, b) => v.neon.vbslq_f32(v.neon.vcgtq_f32(a, b), a, b);
    where_above_zero(a, condition) => {
        let zero = v.neon.vdupq_n_f32(0.0);
        v.neon.vbslq_f32(v.neon.vcgtq_f32(condition, zero), a, zero)
    };
    total(a) => total::<f32, 4>(cast(a));
}

register! {
    F64x2: 2 x f64 in float64x2_t, by v: Token;
    neon: vdupq_n_f64 vaddq_f64 vsubq_f64 vmulq_f64 vdivq_f64;
    negate(a) => v.neon.vnegq_f64(a);
    root(a) => v.neon.vsqrtq_f64(a);
    min(a, b) => v.neon.vbslq_f64(v.neon.vcltq_f64(a, b), a, b);
    max(a, b) => v.neon.vbslq_f64(v.neon.vcgtq_f64(a, b), a, b);
    where_above_zero(a, condition) => {
        let zero = v.neon.vdupq_n_f64(0.0);
        v.neon.vbslq_f64(v.neon.vcgtq_f64(condition, zero), a, zero)
    };
    total(a) => total::<f64, 2>(cast(a));
}

/// NEON.
#[derive(Clone, Copy)]
struct Neon(Token);

impl Neon {
    fn new() -> Self {
        Self(Token::try_new().expect("every processor of this target has NEON"))
    }
}

impl Isa<f32> for Neon {
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

impl Isa<f64> for Neon {
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
        job.run(Neon::new())
    }
}

impl Sealed for f64 {
    fn dispatch<J: Job<Self>>(_: InstructionSet, job: J) -> J::Output {
        job.run(Neon::new())
    }
}
