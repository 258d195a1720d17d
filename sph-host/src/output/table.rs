//! What is written: named columns of numbers, and the grid they may lie on.

use std::collections::BTreeSet;

use thiserror::Error;

/// How many bits the values of a table carry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// The values are `f32` values widened to `f64`; they are written as `f32`.
    F32,
    /// The values are `f64`.
    F64,
}

/// A named column of numbers. NaN stands for "no value": an empty cell in CSV, NaN in binary formats, grey in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name, e.g. `density` or `velocity_x_dy`.
    pub name: String,
    /// One value a point.
    pub values: Vec<f64>,
}

impl Column {
    /// A column from its name and values.
    pub fn new(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), values }
    }
}

/// A regular grid of 1 to 3 axes over a box; its points are the centres of the cells, x runs fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    counts: Vec<usize>,
    lower: Vec<f64>,
    upper: Vec<f64>,
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

/// Names of the axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

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
        Ok(Self { counts: counts.to_vec(), lower: lower.to_vec(), upper: upper.to_vec() })
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

    /// The size of a cell along an axis.
    #[must_use]
    pub fn spacing(&self, axis: usize) -> f64 {
        (self.upper[axis] - self.lower[axis]) / self.counts[axis] as f64
    }

    /// The coordinate along `axis` of the centre of the cells with number `index`: lower + (index + ½) · spacing.
    #[must_use]
    pub fn centre(&self, axis: usize, index: usize) -> f64 {
        self.lower[axis] + (index as f64 + 0.5) * self.spacing(axis)
    }

    /// The coordinates of all cell centres, named x, y, z, in the order of the cells.
    #[must_use]
    pub fn coordinates(&self) -> Vec<Column> {
        let mut stride = 1;
        let mut columns = Vec::with_capacity(self.counts.len());
        for (axis, &count) in self.counts.iter().enumerate() {
            let centres: Vec<f64> = (0..count).map(|index| self.centre(axis, index)).collect();
            let values = (0..self.cells()).map(|cell| centres[cell / stride % count]).collect();
            columns.push(Column::new(AXES[axis], values));
            stride *= count;
        }
        columns
    }
}

/// Points and what was found there.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// 1 to 3 columns x, y, z; always written as `f64`.
    pub coordinates: Vec<Column>,
    /// The values, in the order in which they are written.
    pub columns: Vec<Column>,
    /// The grid whose cell centres the points are, if they are.
    pub grid: Option<Grid>,
    /// The precision of `columns`.
    pub precision: Precision,
    /// One line for people, e.g. kernel and support: the picture's title and the VTK file's.
    pub caption: String,
}

/// Why a table cannot be written.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TableError {
    /// Not 1 to 3 coordinates.
    #[error("a table has 1 to 3 coordinates, got {0}")]
    Coordinates(usize),
    /// Two columns of one name.
    #[error("two columns are named `{0}`")]
    Duplicate(String),
    /// A column of another length.
    #[error("column `{name}` has {length} values, expected {expected}")]
    Length {
        /// The column.
        name: String,
        /// How many values it has.
        length: usize,
        /// How many points, or cells of the grid, there are.
        expected: usize,
    },
}

impl Table {
    /// How many points there are.
    #[must_use]
    pub fn points(&self) -> usize {
        self.coordinates.first().map_or(0, |column| column.values.len())
    }

    /// Coordinates, then values, in the order of writing.
    pub fn all_columns(&self) -> impl Iterator<Item = &Column> {
        self.coordinates.iter().chain(&self.columns)
    }

    /// The points with three coordinates each; those that the table lacks are zero.
    pub fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        (0..self.points()).map(|point| {
            let mut position = [0.0; 3];
            for (axis, column) in self.coordinates.iter().take(3).enumerate() {
                position[axis] = column.values[point];
            }
            position
        })
    }

    /// Whether columns have different names and as many values as there are points.
    ///
    /// # Errors
    ///
    /// [`TableError`] names the column at fault.
    pub fn check(&self) -> Result<(), TableError> {
        if !(1..=3).contains(&self.coordinates.len()) {
            return Err(TableError::Coordinates(self.coordinates.len()));
        }
        let expected = self.grid.as_ref().map_or(self.points(), Grid::cells);
        let mut names = BTreeSet::new();
        for Column { name, values } in self.all_columns() {
            if values.len() != expected {
                return Err(TableError::Length { name: name.clone(), length: values.len(), expected });
            }
            if !names.insert(name) {
                return Err(TableError::Duplicate(name.clone()));
            }
        }
        Ok(())
    }
}
