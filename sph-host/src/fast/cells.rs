//! Cells: bands of the support radius along y and z, and along x slices a quarter as wide, so that what is in reach of a
//! point is a few runs of consecutive particles.

/// Slices along x within one support radius.
const SLICES: f64 = 4.0;

/// Which cell a position is in. Everything is computed in f64, which holds f32 positions exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layout<const D: usize> {
    lower: [f64; D],
    /// Cells per length.
    inverse: [f64; D],
    width: [f64; D],
    counts: [u32; D],
    /// The support radius with a margin for rounding.
    reach: f64,
}

/// Consecutive slices of one row of cells: the cells `first..=last`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) first: usize,
    pub(super) last: usize,
}

/// Rows that a ball can touch, in three dimensions.
pub(super) const MOST_RUNS: usize = 9;

impl<const D: usize> Layout<D> {
    /// Cells over a box; at most some two a particle, so that a box of any size has bounded cells.
    pub(super) fn new(lower: [f64; D], upper: [f64; D], radius: f64, particles: usize) -> Self {
        let size = lower.iter().chain(&upper).fold(0.0_f64, |size, x| size.max(x.abs()));
        let reach = radius * (1.0 + 1e-6) + 16.0 * f64::EPSILON * size;
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

    /// The squared distance of x from the bands that can be in reach along an axis: the one below, its own, the one above;
    /// infinite where there is none.
    #[inline(always)]
    fn band_distances(&self, axis: usize, x: f64) -> (u32, [f64; 3]) {
        let own = self.along(axis, x);
        let below = x - (self.lower[axis] + f64::from(own) * self.width[axis]);
        let above = self.width[axis] - below;
        let square = |distance: f64| distance.max(0.0) * distance.max(0.0);
        let last = self.counts[axis] - 1;
        let (no_lower, no_upper) = (own == 0, own == last);
        (
            own,
            [
                if no_lower { f64::INFINITY } else { square(below) },
                0.0,
                if no_upper { f64::INFINITY } else { square(above) },
            ],
        )
    }

    /// The runs of cells that hold whatever is in reach of x, in the order of the cells; returns how many.
    #[inline(always)]
    pub(super) fn runs(&self, x: &[f64; D], runs: &mut [Run; MOST_RUNS]) -> usize {
        let (y, y_squares) =
            if D > 1 { self.band_distances(1, x[1]) } else { (1, [f64::INFINITY, 0.0, f64::INFINITY]) };
        let (z, z_squares) =
            if D > 2 { self.band_distances(2, x[2]) } else { (1, [f64::INFINITY, 0.0, f64::INFINITY]) };
        let rows = if D > 1 { self.counts[1] as usize } else { 3 };
        let slices = self.counts[0] as usize;
        let mut found = 0;
        for (dz, z_square) in z_squares.into_iter().enumerate() {
            for (dy, y_square) in y_squares.into_iter().enumerate() {
                let rest = self.reach * self.reach - y_square - z_square;
                if rest < 0.0 {
                    continue;
                }
                let half = rest.sqrt();
                let row = if D == 1 {
                    0
                } else if D == 2 {
                    y as usize + dy - 1
                } else {
                    (z as usize + dz - 1) * rows + y as usize + dy - 1
                };
                let row = row * slices;
                runs[found] = Run {
                    first: row + self.along(0, x[0] - half) as usize,
                    last: row + self.along(0, x[0] + half) as usize,
                };
                found += 1;
            }
        }
        found
    }
}
