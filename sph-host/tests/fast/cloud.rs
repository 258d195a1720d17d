//! Sets of particles, pleasant and otherwise.

use proptest::prelude::*;
use sph_host::fast::Real;

/// A set and a support radius that suits it.
#[derive(Clone, Debug)]
pub(crate) struct Cloud<T, const D: usize> {
    pub(crate) positions: Vec<[T; D]>,
    pub(crate) radius: T,
}

/// Numbers in [0, 1), the same every time (a multiplicative congruential sequence).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// `side` particles along each axis, jittered by a fifth of their spacing, which is `spacing`, about `offset`.
pub(crate) fn lattice<T: Real, const D: usize>(side: usize, spacing: f64, offset: f64) -> Cloud<T, D> {
    let mut random = Random(11);
    let positions = (0..side.pow(D as u32))
        .map(|i| {
            std::array::from_fn(|axis| {
                let k = i / side.pow(axis as u32) % side;
                T::from_f64(offset + spacing * (k as f64 + 0.5 + 0.4 * (random.next() - 0.5)))
            })
        })
        .collect();
    Cloud { positions, radius: T::from_f64(2.6 * spacing) }
}

/// Sets of up to some hundred particles: scattered, clustered, in one point, in a plane, far apart, far away, with copies.
pub(crate) fn clouds<T: Real, const D: usize>() -> impl Strategy<Value = Cloud<T, D>> {
    (0..8_u32, 0..300_usize, any::<u64>(), 0.01..3.0_f64).prop_map(|(kind, count, seed, size)| {
        let mut random = Random(seed);
        let scale = [1.0, 1e-3, 1e3][seed as usize % 3];
        let mut positions: Vec<[T; D]> = (0..count)
            .map(|i| {
                std::array::from_fn(|axis| {
                    let x = match kind {
                        0 | 1 => 4.0 * random.next(),
                        2 => (i % 5) as f64 + 0.05 * random.next(),
                        3 => 0.7,
                        4 if axis == D - 1 => 1.0,
                        4 => 4.0 * random.next(),
                        5 => 4.0 * random.next() * 10_f64.powi(i as i32 % 7),
                        6 => 1e6 * size + 4.0 * random.next(),
                        _ => (8.0 * random.next()).floor() * size / 2.0,
                    };
                    T::from_f64(scale * (x - 1.0))
                })
            })
            .collect();
        if kind == 1 {
            positions.extend_from_within(..count / 2);
        }
        Cloud { positions, radius: T::from_f64(scale * size) }
    })
}

/// Whether two sums of positive terms agree to `tolerance` times what is expected.
pub(crate) fn agree<T: Real>(found: T, expected: f64, tolerance: f64) -> bool {
    (found.to_f64() - expected).abs() <= tolerance * expected.abs()
}
