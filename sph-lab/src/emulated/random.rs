//! Numbers for stochastic rounding: on each thread the same after the same seed.

use std::cell::Cell;

thread_local! {
    static STATE: Cell<u64> = const { Cell::new(0) };
}

/// Begins anew; returns where it was.
pub(super) fn seed(seed: u64) -> u64 {
    STATE.replace(seed)
}

/// Where it is.
pub(super) fn state() -> u64 {
    STATE.get()
}

/// 64 random bits (G. L. Steele, D. Lea, C. H. Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014).
pub(super) fn next() -> u64 {
    let state = STATE.get().wrapping_add(0x9E37_79B9_7F4A_7C15);
    STATE.set(state);
    let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// From 0 to below 1.
pub(super) fn unit() -> f64 {
    (next() >> 11) as f64 / (1_u64 << 53) as f64
}
