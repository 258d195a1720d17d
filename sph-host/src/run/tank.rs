//! A tank with its lower corner at the origin, and walls of particles around it.

use crate::engine::walls;

/// Layers of wall particles: as many as the support radius of every case is spacings long, rounded up.
const LAYERS: i64 = 3;

/// A tank of so many cells along each axis.
pub(super) struct Tank<const D: usize> {
    /// Cells along each axis.
    pub(super) counts: [i64; D],
    /// The length of each axis, m.
    pub(super) size: [f64; D],
    /// The side of a cell, m.
    pub(super) spacing: f64,
    /// Whether there is a wall at the lower and at the upper end of each axis.
    pub(super) ends: [(bool, bool); D],
}

impl<const D: usize> Tank<D> {
    /// A tank with walls on all sides.
    pub(super) fn closed(counts: [i64; D], size: [f64; D], spacing: f64) -> Self {
        Self { counts, size, spacing, ends: [(true, true); D] }
    }

    /// The wall particles.
    pub(super) fn walls(&self) -> Vec<[f64; D]> {
        walls(self.counts, LAYERS, self.ends, self.spacing)
    }

    /// The lower corner of the tank with its walls.
    pub(super) fn lower(&self) -> [f64; D] {
        [-self.margin(); D]
    }

    /// The upper corner of the tank with its walls.
    pub(super) fn upper(&self) -> [f64; D] {
        self.size.map(|length| length + self.margin())
    }

    /// The box that no particle may leave.
    pub(super) fn inside(&self) -> [(f64, f64); D] {
        self.size.map(|length| (0.0, length))
    }

    fn margin(&self) -> f64 {
        LAYERS as f64 * self.spacing
    }
}
