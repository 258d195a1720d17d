//! Values at the points of a lattice, and their gradients.

/// Values at the points of a lattice, the first axis fastest. A value that is not finite is none.
#[derive(Clone, Copy, Debug)]
pub struct Lattice<'a> {
    /// The coordinates along each axis, ascending.
    pub axes: [&'a [f64]; 3],
    /// One value a point.
    pub values: &'a [f64],
    /// The derivatives along each axis, one a point; none: differences of values at neighbouring points are taken.
    pub gradient: Option<[&'a [f64]; 3]>,
}

impl Lattice<'_> {
    /// Points along each axis.
    pub(super) fn counts(&self) -> [usize; 3] {
        self.axes.map(<[f64]>::len)
    }

    /// How far apart in the list of points neighbours along each axis are.
    pub(super) fn strides(&self) -> [usize; 3] {
        let [nx, ny, _] = self.counts();
        [1, nx, nx * ny]
    }

    /// The number of the point at a place, if the lattice reaches there.
    pub(super) fn number(&self, place: [isize; 3]) -> Option<usize> {
        let (counts, strides) = (self.counts(), self.strides());
        (0..3).try_fold(0, |number, axis| {
            let index = usize::try_from(place[axis]).ok().filter(|&index| index < counts[axis])?;
            Some(number + index * strides[axis])
        })
    }

    /// The value at a point; none where it is not finite.
    pub(super) fn value(&self, number: usize) -> Option<f64> {
        self.values.get(number).copied().filter(|value| value.is_finite())
    }

    /// Where a point is.
    pub(super) fn position(&self, place: [usize; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| self.axes[axis][place[axis]])
    }

    /// The gradient at a point.
    pub(super) fn gradient(&self, place: [usize; 3]) -> [f64; 3] {
        let (strides, counts) = (self.strides(), self.counts());
        let number = (0..3).map(|axis| place[axis] * strides[axis]).sum();
        if let Some(columns) = self.gradient {
            return columns.map(|column| column.get(number).copied().unwrap_or(f64::NAN));
        }
        std::array::from_fn(|axis| {
            let (index, stride) = (place[axis], strides[axis]);
            let own = (index, self.value(number));
            let below = (index > 0).then(|| (index - 1, self.value(number - stride)));
            let above = (index + 1 < counts[axis]).then(|| (index + 1, self.value(number + stride)));
            let has_value = |&(_, value): &(usize, Option<f64>)| value.is_some();
            let (low, high) =
                (below.filter(has_value).unwrap_or(own), above.filter(has_value).unwrap_or(own));
            match (low, high) {
                ((i, Some(low)), (j, Some(high))) if i < j => {
                    (high - low) / (self.axes[axis][j] - self.axes[axis][i])
                }
                _ => 0.0,
            }
        })
    }
}
