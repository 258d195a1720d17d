//! Regular grids of points.

use thiserror::Error;

use super::Column;
use super::table::AXES;
use crate::part::Part;

/// A regular grid of 1 to 3 axes over a box; its points are the centres of the cells, the first axis runs fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    counts: Vec<usize>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The axes in space that the grid's axes are.
    axes: Vec<usize>,
    /// Where the grid lies along the other axes in space.
    beside: [f64; 3],
    /// Where the grid is some layers of a whole one, along the last axis: the first of these, and how many the whole has.
    layers: Option<Layers>,
}

/// Some layers of a whole grid.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Layers {
    first: usize,
    whole: usize,
    /// Whether neighbouring parts share a layer.
    are_shared: bool,
}

/// Why a grid cannot be: the axis (0 is x) and what is wrong with it.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum GridError {
    /// Not 1 to 3 axes, or the lists differ in length.
    #[error(
        "a grid has 1 to 3 axes with a count, a lower and an upper bound each, got {counts}, {lower} and {upper}"
    )]
    Axes {
        /// How many counts were given.
        counts: usize,
        /// How many lower bounds were given.
        lower: usize,
        /// How many upper bounds were given.
        upper: usize,
    },
    /// A count of zero.
    #[error("a grid needs at least one cell along {}", AXES[*.axis])]
    NoCells {
        /// The axis.
        axis: usize,
    },
    /// Bounds that are not finite or not in order; equal bounds are taken for a single cell only.
    #[error("a grid's bounds along {} must be finite with lower < upper, got {lower} and {upper}", AXES[*.axis])]
    Bounds {
        /// The axis.
        axis: usize,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// More cells than can be counted.
    #[error("a grid of {counts:?} has more cells than can be counted")]
    TooMany {
        /// The counts.
        counts: Vec<usize>,
    },
}

impl Grid {
    /// A grid of `counts` cells over the box from `lower` to `upper`.
    ///
    /// # Errors
    ///
    /// [`GridError`] names the axis at fault.
    pub fn new(counts: &[usize], lower: &[f64], upper: &[f64]) -> Result<Self, GridError> {
        if !(1..=3).contains(&counts.len()) || lower.len() != counts.len() || upper.len() != counts.len() {
            return Err(GridError::Axes { counts: counts.len(), lower: lower.len(), upper: upper.len() });
        }
        for (axis, &count) in counts.iter().enumerate() {
            let (low, high) = (lower[axis], upper[axis]);
            if count == 0 {
                return Err(GridError::NoCells { axis });
            }
            if !(high - low).is_finite() || low > high || (low == high && count > 1) {
                return Err(GridError::Bounds { axis, lower: low, upper: high });
            }
        }
        if counts.iter().try_fold(1_usize, |product, &count| product.checked_mul(count)).is_none() {
            return Err(GridError::TooMany { counts: counts.to_vec() });
        }
        let axes = (0..counts.len()).collect();
        let (counts, lower, upper) = (counts.to_vec(), lower.to_vec(), upper.to_vec());
        Ok(Self { counts, lower, upper, axes, beside: [0.0; 3], layers: None })
    }

    /// The same grid along other axes in space, `[0, 2]` for a plane of x and z, and where it lies along the rest: of `beside` only
    /// those count. Anything but as many axes as the grid has, ascending and below 3, changes nothing.
    #[must_use]
    pub fn along(self, axes: &[usize], beside: [f64; 3]) -> Self {
        let can_be = axes.len() == self.axes.len() && axes.is_sorted() && axes.iter().all(|&axis| axis < 3);
        if can_be { Self { axes: axes.to_vec(), beside, ..self } } else { self }
    }

    /// The axes in space that the grid's axes are: 0 is x.
    #[must_use]
    pub fn axes(&self) -> &[usize] {
        &self.axes
    }

    /// Where the grid lies along axes in space that it lacks; of use along those alone.
    #[must_use]
    pub fn beside(&self) -> [f64; 3] {
        self.beside
    }

    /// The name of one of the grid's axes.
    #[must_use]
    pub fn axis_name(&self, axis: usize) -> &'static str {
        AXES[self.axes[axis]]
    }

    /// Cells along each axis.
    #[must_use]
    pub fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// The lower corner of the box.
    #[must_use]
    pub fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// The upper corner of the box.
    #[must_use]
    pub fn upper(&self) -> &[f64] {
        &self.upper
    }

    /// How many cells there are.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.counts.iter().product()
    }

    /// Part of the grid: some of its layers along the last axis, with the bits of the whole; parts that share layers have the first of
    /// the next one too. None where the part would have no layer of its own.
    #[must_use]
    pub fn part(&self, part: Part, are_shared: bool) -> Option<Self> {
        let last = self.counts.len() - 1;
        let whole = self.counts[last];
        let layers = part.layers(whole, are_shared);
        if part.of() > whole || layers.is_empty() {
            return None;
        }
        let mut counts = self.counts.clone();
        counts[last] = layers.len();
        let layers = Some(Layers { first: layers.start, whole, are_shared });
        Some(Self { counts, layers, ..self.clone() })
    }

    /// The first and the last point along x, y and z, among those of the whole grid.
    pub(super) fn extent(&self) -> [(usize, usize); 3] {
        let mut extent = self.whole_extent();
        let last = self.counts.len() - 1;
        if let Some(Layers { first, .. }) = self.layers {
            extent[self.axes[last]] = (first, first + self.counts[last] - 1);
        }
        extent
    }

    /// The first and the last point of the whole grid along x, y and z.
    pub(super) fn whole_extent(&self) -> [(usize, usize); 3] {
        let mut extent = [(0, 0); 3];
        for (axis, &place) in self.axes.iter().enumerate() {
            extent[place].1 = self.whole_count(axis) - 1;
        }
        extent
    }

    /// The extent of another part of the same whole.
    pub(super) fn piece_extent(&self, part: Part) -> [(usize, usize); 3] {
        let mut extent = self.whole_extent();
        let last = self.counts.len() - 1;
        if let Some(Layers { whole, are_shared, .. }) = self.layers {
            let layers = part.layers(whole, are_shared);
            extent[self.axes[last]] = (layers.start, layers.end - 1);
        }
        extent
    }

    fn whole_count(&self, axis: usize) -> usize {
        match self.layers {
            Some(Layers { whole, .. }) if axis + 1 == self.counts.len() => whole,
            _ => self.counts[axis],
        }
    }

    /// The size of a cell along an axis.
    #[must_use]
    pub fn spacing(&self, axis: usize) -> f64 {
        (self.upper[axis] - self.lower[axis]) / self.whole_count(axis) as f64
    }

    /// The coordinate along `axis` of the centre of the cells with number `index`: lower + (index + ½) · spacing.
    #[must_use]
    pub fn centre(&self, axis: usize, index: usize) -> f64 {
        let first = match self.layers {
            Some(Layers { first, .. }) if axis + 1 == self.counts.len() => first,
            _ => 0,
        };
        self.whole_centre(axis, first + index)
    }

    /// As [`centre`](Self::centre), of the whole grid.
    pub(super) fn whole_centre(&self, axis: usize, index: usize) -> f64 {
        self.lower[axis] + (index as f64 + 0.5) * self.spacing(axis)
    }

    /// The coordinates of all cell centres, in the order of the cells.
    #[must_use]
    pub fn coordinates(&self) -> Vec<Column> {
        let mut stride = 1;
        let mut columns = Vec::with_capacity(self.counts.len());
        for (axis, &count) in self.counts.iter().enumerate() {
            let centres: Vec<f64> = (0..count).map(|index| self.centre(axis, index)).collect();
            let values = (0..self.cells()).map(|cell| centres[cell / stride % count]).collect();
            columns.push(Column::coordinate(self.axes[axis], values));
            stride *= count;
        }
        columns
    }
}
