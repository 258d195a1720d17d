//! What is written: named columns of numbers, and what each holds.

use std::collections::BTreeSet;

use thiserror::Error;

use super::{Content, Grid};

/// How many bits the values of a table carry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// The values are `f32` values widened to `f64`; they are written as `f32`.
    F32,
    /// The values are `f64`.
    F64,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Coordinates along an axis: 0 is x.
    Coordinate(usize),
    /// Densities.
    Density,
    /// The field of this number among those that were evaluated together; 0 for a column that stands for itself.
    Field(usize),
    /// The derivative of another column.
    Gradient {
        /// The place of that column in [`Table::columns`].
        of: usize,
        /// The axis along which it is derived: 0 is x.
        axis: usize,
    },
}

/// A named column of numbers. NaN stands for "no value": an empty cell in CSV, NaN in binary formats, grey in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// The name, e.g. `density` or `velocity_x_dy`.
    pub name: String,
    /// What it holds: pictures go by this, never by the name.
    pub role: Role,
    /// One value a point.
    pub values: Vec<f64>,
}

impl Column {
    /// A column of a field from its name and values.
    pub fn new(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), role: Role::Field(0), values }
    }

    /// The coordinates along one of the axes x, y, z.
    ///
    /// # Panics
    /// Where there is no such axis.
    pub fn coordinate(axis: usize, values: Vec<f64>) -> Self {
        Self { name: AXES[axis].to_owned(), role: Role::Coordinate(axis), values }
    }

    /// The same column in another role.
    #[must_use]
    pub fn in_role(self, role: Role) -> Self {
        Self { role, ..self }
    }
}

/// Names of the axes.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

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

    /// Whether the points are a grid.
    #[must_use]
    pub fn content(&self) -> Content {
        if self.grid.is_some() { Content::Grid } else { Content::Points }
    }

    /// Coordinates, then values, in the order of writing.
    pub fn all_columns(&self) -> impl Iterator<Item = &Column> {
        self.coordinates.iter().chain(&self.columns)
    }

    /// The points with three coordinates each; those that the table lacks are where its grid lies, or zero.
    pub fn positions(&self) -> impl Iterator<Item = [f64; 3]> {
        (0..self.points()).map(|point| {
            let mut position = self.grid.as_ref().map_or([0.0; 3], Grid::beside);
            for (place, column) in self.coordinates.iter().take(3).enumerate() {
                let axis = if let Role::Coordinate(axis) = column.role { axis.min(2) } else { place };
                position[axis] = column.values[point];
            }
            position
        })
    }

    /// The gradient of the column at a place among `columns`: its derivatives along the grid's axes, if all are there.
    #[must_use]
    pub fn gradient(&self, grid: &Grid, of: usize) -> Option<Vec<&Column>> {
        let find =
            |&axis: &usize| self.columns.iter().find(|column| column.role == Role::Gradient { of, axis });
        grid.axes().iter().map(find).collect()
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
        for Column { name, values, .. } in self.all_columns() {
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
