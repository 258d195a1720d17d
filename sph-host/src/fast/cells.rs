//! Cells: bands of the support radius along y and z, and along x slices a quarter as wide, so that what is in reach of a
//! point is a few runs of consecutive particles.

use super::simd::Real;

/// Slices along x within one support radius.
const SLICES: f64 = 4.0;

/// Which cell a position is in. Everything is computed in f64, which holds f32 positions exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BandLayout<const D: usize> {
    lower: [f64; D],
    /// Cells per length.
    inverse: [f64; D],
    width: [f64; D],
    counts: [u32; D],
    /// The support radius with a margin for rounding.
    reach: f64,
    inverse_reach: f64,
}

/// Consecutive slices of one row of cells: `first..end`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) first: u32,
    pub(super) end: u32,
}

/// More than there are rows that a ball can touch, which are nine in three dimensions.
const ROWS: usize = 16;

impl<const D: usize> BandLayout<D> {
    /// Cells over a box; at most some two a particle, so that a box of any size has bounded cells.
    pub(super) fn new(lower: [f64; D], upper: [f64; D], radius: f64, particles: usize) -> Self {
        let size = lower.iter().chain(&upper).fold(0.0_f64, |size, x| size.max(x.abs()));
        let reach = radius * (1.0 + 1e-5) + 16.0 * f64::EPSILON * size;
        let most = (2.0 * particles as f64 + 64.0).min(f64::from(u32::MAX / 2));
        let extent: [f64; D] = std::array::from_fn(|axis| upper[axis] - lower[axis]);
        let mut counts: [f64; D] = std::array::from_fn(|axis| {
            let slices = if axis == 0 { SLICES } else { 1.0 };
            (extent[axis] / reach * slices).floor().max(1.0)
        });
        while counts.iter().product::<f64>() > most {
            let most_of_all = (0..D).fold(0, |a, b| if counts[b] > counts[a] { b } else { a });
            counts[most_of_all] = (counts[most_of_all] / 2.0).floor().min(most);
        }
        let width = std::array::from_fn(|axis| match extent[axis] {
            extent if extent > 0.0 => extent / counts[axis],
            _ => reach,
        });
        Self {
            lower,
            inverse: width.map(|width| 1.0 / width),
            width,
            counts: counts.map(|count| count as u32),
            reach,
            inverse_reach: 1.0 / reach,
        }
    }

    /// How many cells there are.
    pub(super) fn cells(&self) -> usize {
        self.counts.iter().map(|&count| count as usize).product()
    }

    /// The number of the slice or band along an axis, held at the ends.
    #[inline(always)]
    fn along(&self, axis: usize, x: f64) -> u32 {
        // a cast saturates: below the box is 0
        (((x - self.lower[axis]) * self.inverse[axis]) as u32).min(self.counts[axis] - 1)
    }

    /// The cell of a position: x runs fastest.
    #[inline(always)]
    pub(super) fn cell(&self, x: &[f64; D]) -> u32 {
        let mut cell = 0;
        for axis in (0..D).rev() {
            cell = cell * self.counts[axis] + self.along(axis, x[axis]);
        }
        cell
    }

    /// The row of cells that a position is in.
    #[inline(always)]
    pub(super) fn row<T: Real>(&self, x: &[T; D]) -> u32 {
        let mut row = 0;
        for axis in (1..D).rev() {
            row = row * self.counts[axis] + self.along(axis, x[axis].to_f64());
        }
        row
    }

    /// Whole rows: those from `first` to `last` and what is in reach of them and comes later, as two runs that do not overlap.
    pub(super) fn later_rows(&self, first: u32, last: u32) -> [Run; 2] {
        let layer = if D > 2 { self.counts[1] } else { 0 };
        let cell = |row: u32| (u64::from(row) * u64::from(self.counts[0])).min(self.cells() as u64) as u32;
        let own = Run { first: cell(first), end: cell(last + 2) };
        let next = (first + layer).saturating_sub(1).max(last + 2);
        [own, Run { first: cell(next), end: cell((last + layer + 2).max(next)) }]
    }

    /// Where something between `lower` and `upper` lies along an axis of bands: the band, and the squared distances, in units of
    /// the reach, from the band below, its own and the one above; infinite where there is none.
    #[inline(always)]
    fn bands(&self, axis: usize, lower: &[f64; D], upper: &[f64; D]) -> (u32, [f32; 3]) {
        if axis >= D {
            return (0, [f32::INFINITY, 0.0, f32::INFINITY]);
        }
        let own = self.along(axis, lower[axis]);
        let edge = self.lower[axis] + f64::from(own) * self.width[axis];
        let square = |distance: f64| {
            let distance = (distance.max(0.0) * self.inverse_reach) as f32;
            distance * distance
        };
        let below = if own == 0 { f32::INFINITY } else { square(lower[axis] - edge) };
        let last = own == self.counts[axis] - 1;
        let above = if last { f32::INFINITY } else { square(edge + self.width[axis] - upper[axis]) };
        (own, [below, 0.0, above])
    }

    /// The slice of x, and where in it, in slices, held near it.
    #[inline(always)]
    fn slice(&self, x: f64) -> (i32, f32) {
        let own = self.along(0, x);
        let within = (x - self.lower[0]) * self.inverse[0] - f64::from(own);
        (own as i32, within.clamp(-2.0 * SLICES, 2.0 * SLICES) as f32)
    }

    /// The runs of cells that hold whatever is in reach of a box that lies in one row, in the order of the cells; some are
    /// empty. All rows are calculated at once in vectors, without a branch: which are in reach cannot be foreseen.
    #[inline(always)]
    pub(super) fn runs(&self, lower: &[f64; D], upper: &[f64; D]) -> [Run; ROWS] {
        let (y, y_squares) = self.bands(1, lower, upper);
        let (z, z_squares) = self.bands(2, lower, upper);
        let rows = if D > 1 { self.counts[1] } else { 1 };
        let (mut rests, mut starts) = ([-1.0_f32; ROWS], [0_u32; ROWS]);
        for dz in Self::LAYERS {
            for dy in 0..3_u32 {
                let k = (3 * (dz - Self::LAYERS.start) + dy) as usize;
                rests[k] = 1.0 - y_squares[dy as usize] - z_squares[dz as usize];
                let row = (z + dz).wrapping_sub(1).wrapping_mul(rows).wrapping_add(y + dy).wrapping_sub(1);
                starts[k] = row.wrapping_mul(self.counts[0]);
            }
        }
        /// What all roundings below amount to at most, and more, in slices.
        const ROUNDING: f32 = 1e-5;
        let ((left, from), (right, to)) = (self.slice(lower[0]), self.slice(upper[0]));
        let reach = (self.reach * self.inverse[0]) as f32;
        let last = self.counts[0] as i32 - 1;
        let mut runs = [Run::default(); ROWS];
        for k in 0..Self::LANES {
            let half = rests[k].max(0.0).sqrt() * reach + ROUNDING;
            let first = nearest(from - half - 0.5).wrapping_add(left);
            let end = nearest(to + half + 0.5).wrapping_add(right);
            let run = Run {
                first: starts[k].wrapping_add(first.clamp(0, last) as u32),
                end: starts[k].wrapping_add(end.clamp(1, last + 1) as u32),
            };
            runs[k] = if rests[k] >= 0.0 { run } else { Run::default() };
        }
        runs
    }

    /// The layers of cells from the one below on: in fewer than three dimensions there is one.
    const LAYERS: std::ops::Range<u32> = if D < 3 { 1..2 } else { 0..3 };

    /// How many runs can have anything in them.
    pub(super) const RUNS: usize = if D < 3 { 3 } else { 9 };

    /// Rows that are calculated together: a power of two.
    const LANES: usize = Self::RUNS.next_power_of_two();
}

/// The nearest whole number to a small one: a cast that compilers make a vector of, as they do not of `as i32`.
#[inline(always)]
fn nearest(x: f32) -> i32 {
    // beyond this, floats are whole numbers one apart
    const WHOLE: f32 = 12_582_912.0;
    (x + WHOLE).to_bits().wrapping_sub(WHOLE.to_bits()) as i32
}
