//! What an instruction set without an instruction for it does number by number.

use super::Real;

/// Moves the values whose bit is set to the front of `out`, one by one.
#[inline(always)]
pub(super) fn pack<V: Copy, const N: usize>(mask: u32, values: &[V; N], out: &mut [V]) {
    let out: &mut [V; N] = out.first_chunk_mut().expect("room for a register");
    let mut end = 0;
    for k in 0..N {
        out[end & (N - 1)] = values[k];
        end += (mask >> k & 1) as usize;
    }
}

/// The first N of some places.
#[inline(always)]
pub(super) fn first<const N: usize>(places: &[u32]) -> &[u32; N] {
    places.first_chunk().expect("places for a register")
}

/// The sum of N columns, halves first.
#[inline(always)]
pub(super) fn total<T: Real, const N: usize>(mut columns: [T; N]) -> T {
    let mut half = N / 2;
    while half > 0 {
        for k in 0..half {
            columns[k] += columns[k + half];
        }
        half /= 2;
    }
    columns[0]
}

/// N quadruples transposed.
#[cfg(any(test, not(target_arch = "x86_64")))]
#[inline(always)]
pub(super) fn transpose<'a, T: Real, const N: usize>(quadruple: impl Fn(usize) -> &'a [T; 4]) -> [[T; N]; 4] {
    let mut out = [[T::ZERO; N]; 4];
    for k in 0..N {
        let from = quadruple(k);
        for number in 0..4 {
            out[number][k] = from[number];
        }
    }
    out
}

/// Bit k: `a[k] < b[k]`.
#[cfg(any(test, not(target_arch = "x86_64")))]
#[inline(always)]
pub(super) fn less_than_mask<T: Real, const N: usize>(a: [T; N], b: [T; N]) -> u32 {
    let mut mask = 0;
    for k in 0..N {
        mask |= u32::from(a[k] < b[k]) << k;
    }
    mask
}
