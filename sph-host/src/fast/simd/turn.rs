//! Sixteen quadruples turned over by AVX-512.

use std::arch::x86_64::{__m128, __m512, __m512d};

use pulp::bytemuck::Pod;
use pulp::cast;
use pulp::x86::V4;

use super::BLOCK;

/// All the first numbers, all the second, …
#[inline(always)]
pub(super) fn turn_f32(isa: V4, quadruples: &[&[f32; 4]; BLOCK]) -> [[f32; BLOCK]; 4] {
    let f = isa.avx512f;
    let a = join::<f32, 4>(isa, quadruples, 0, 4, 0);
    let b = join::<f32, 4>(isa, quadruples, 1, 4, 0);
    let c = join::<f32, 4>(isa, quadruples, 2, 4, 0);
    let d = join::<f32, 4>(isa, quadruples, 3, 4, 0);
    let (ab, cd) = (f._mm512_unpacklo_ps(a, b), f._mm512_unpacklo_ps(c, d));
    let (ab_rest, cd_rest) = (f._mm512_unpackhi_ps(a, b), f._mm512_unpackhi_ps(c, d));
    [
        cast(f._mm512_shuffle_ps::<0x44>(ab, cd)),
        cast(f._mm512_shuffle_ps::<0xee>(ab, cd)),
        cast(f._mm512_shuffle_ps::<0x44>(ab_rest, cd_rest)),
        cast(f._mm512_shuffle_ps::<0xee>(ab_rest, cd_rest)),
    ]
}

/// All the first numbers, all the second, …
#[inline(always)]
pub(super) fn turn_f64(isa: V4, quadruples: &[&[f64; 4]; BLOCK]) -> [[f64; BLOCK]; 4] {
    let mut fields = [[0.0; BLOCK]; 4];
    for half in [0, 8] {
        for pair in [0, 2] {
            let even: __m512d = cast(join::<f64, 2>(isa, quadruples, half, 2, pair));
            let odd: __m512d = cast(join::<f64, 2>(isa, quadruples, half + 1, 2, pair));
            let first: [f64; 8] = cast(isa.avx512f._mm512_unpacklo_pd(even, odd));
            let second: [f64; 8] = cast(isa.avx512f._mm512_unpackhi_pd(even, odd));
            fields[pair][half..half + 8].copy_from_slice(&first);
            fields[pair + 1][half..half + 8].copy_from_slice(&second);
        }
    }
    fields
}

/// 16 bytes, from number `at` on, of four quadruples that are `step` apart, one after another.
#[inline(always)]
fn join<T: Pod, const N: usize>(
    isa: V4,
    quadruples: &[&[T; 4]; BLOCK],
    first: usize,
    step: usize,
    at: usize,
) -> __m512
where
    [T; N]: Pod,
{
    let a: __m128 = cast(numbers::<T, N>(quadruples[first], at));
    let b: __m128 = cast(numbers::<T, N>(quadruples[first + step], at));
    let c: __m128 = cast(numbers::<T, N>(quadruples[first + 2 * step], at));
    let d: __m128 = cast(numbers::<T, N>(quadruples[first + 3 * step], at));
    let ab = isa.avx512f._mm512_insertf32x4::<1>(isa.avx512f._mm512_castps128_ps512(a), b);
    isa.avx512f._mm512_insertf32x4::<3>(isa.avx512f._mm512_insertf32x4::<2>(ab, c), d)
}

/// `quadruple[at..at + N]`
#[inline(always)]
fn numbers<T: Copy, const N: usize>(quadruple: &[T; 4], at: usize) -> [T; N] {
    std::array::from_fn(
        #[inline(always)]
        |k| quadruple[at + k],
    )
}
