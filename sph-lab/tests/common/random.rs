//! Numbers that look random, the same on every machine.

/// A linear congruential generator (D. E. Knuth's MMIX).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// The next, from 0 to 1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The next, from −1 to 1.
    #[allow(dead_code)]
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
}
