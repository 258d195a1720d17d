//! Samples to test with: lattices, jittered ones, and points at random, the same on every run.

use sph_core::{CellGrid, CellLayout, Error};

/// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [low, high)^D.
    pub(crate) fn point<const D: usize>(&mut self, low: f64, high: f64) -> [f64; D] {
        core::array::from_fn(|_| low + (high - low) * self.unit())
    }

    /// A direction in D dimensions, length 1.
    pub(crate) fn direction<const D: usize>(&mut self) -> [f64; D] {
        loop {
            let x = self.point::<D>(-1.0, 1.0);
            let norm = x.iter().map(|c| c * c).sum::<f64>().sqrt();
            if (0.1..1.0).contains(&norm) {
                return x.map(|c| c / norm);
            }
        }
    }
}

/// `count`^D samples at the centres of the cells of [0, 1]^D, each moved by up to `jitter` cell widths along every axis.
pub(crate) fn jittered<const D: usize>(count: usize, jitter: f64, seed: u64) -> Vec<[f64; D]> {
    let mut random = Random(seed);
    let spacing = 1.0 / count as f64;
    let mut samples = Vec::with_capacity(count.pow(D as u32));
    for number in 0..count.pow(D as u32) {
        samples.push(core::array::from_fn(|axis| {
            let cell = number / count.pow(axis as u32) % count;
            spacing * (cell as f64 + 0.5 + jitter * (2.0 * random.unit() - 1.0))
        }));
    }
    samples
}

/// Storage of a grid over samples in [0, 1]^D.
pub(crate) struct Grid<const D: usize> {
    pub(crate) positions: Vec<[f64; D]>,
    starts: Vec<u32>,
    entries: Vec<u32>,
    cells: u32,
    periodic: bool,
}

impl<const D: usize> Grid<D> {
    /// Samples in [0, 1]^D, with cells about as wide as `reach`; `periodic` along every axis, or along none.
    pub(crate) fn new(positions: Vec<[f64; D]>, reach: f64, periodic: bool) -> Self {
        let cells = (1.0 / reach).floor().clamp(1.0, 64.0) as u32;
        let starts = vec![0; cells.pow(D as u32) as usize + 1];
        let entries = vec![0; positions.len()];
        Self { positions, starts, entries, cells, periodic }
    }

    /// The search.
    pub(crate) fn search(&mut self) -> Result<CellGrid<'_, f64, u32, D>, Error> {
        let mut layout = CellLayout::bounded(&[0.0; D], &[1.0; D], [self.cells; D])?;
        if self.periodic {
            for axis in 0..D {
                layout = layout.periodic(axis, 0.0, 1.0)?;
            }
        }
        CellGrid::build(layout, &self.positions, &mut self.starts, &mut self.entries)
    }
}
