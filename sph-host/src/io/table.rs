//! The table that every reader fills.

use super::error::{Parsed, Problem, ReadError, counted, shown};
use super::names::{AXES, check_names, drop_units};
use super::position::{self, Coordinates};
use super::rows::Rows;

/// Points in 1 to 3 dimensions with named arrays, as a file gave them.
#[derive(Debug, Clone)]
pub struct PointTable {
    /// The file's name as given, for messages.
    pub source: String,
    /// The coordinates: one vector an axis, all of the same length, not yet checked to be finite.
    pub coordinates: Vec<Vec<f64>>,
    /// The axis in space of each coordinate, ascending: `[0, 2]` where the file has x and z alone.
    pub space: Vec<usize>,
    /// All other arrays of the points, in the file's order.
    pub arrays: Vec<Array>,
    /// What a person should know of the file, a line each: the units that it names, which are not applied.
    pub notes: Vec<String>,
    /// What the file calls the coordinate along each axis.
    pub(super) axes: Vec<String>,
    pub(super) rows: Rows,
    /// Whether the coordinates were found among the arrays.
    pub(super) is_placed: bool,
}

/// One array of a [`PointTable`].
#[derive(Debug, Clone)]
pub struct Array {
    /// The name as the file spells it.
    pub name: String,
    /// How many numbers a point has.
    pub components: usize,
    /// The numbers, point by point; NaN for an empty cell of a text table. Where there is a fault, not to be used.
    pub values: Vec<f64>,
    /// Why the array cannot be used, if it cannot.
    pub fault: Option<Fault>,
    /// Whether there is any number, be they all usable or not.
    pub(super) has_numbers: bool,
    /// The first point whose cell in a text table is empty.
    pub(super) first_empty: Option<usize>,
}

/// Why an array cannot be used: the first thing in it that is not a number, its wrong shape, or damage.
#[derive(Debug, Clone)]
pub struct Fault {
    /// Where in the file.
    pub at: String,
    /// What is there.
    pub problem: String,
}

/// Why an array has no usable numbers, before its name is known.
#[derive(Debug, Clone)]
pub(super) struct Unusable {
    pub problem: String,
    /// Whether the array has numbers all the same, so that it stands among the default quantities and is an error there.
    pub has_numbers: bool,
}

impl Unusable {
    /// An array of numbers that cannot be used.
    pub(super) fn numbers(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), has_numbers: true }
    }

    /// An array that is none of numbers, or none of the points.
    pub(super) fn other(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), has_numbers: false }
    }
}

impl Array {
    /// An array without fault.
    pub fn new(name: impl Into<String>, components: usize, values: Vec<f64>) -> Self {
        let has_numbers = values.is_empty() || values.iter().any(|value| !value.is_nan());
        Self { name: name.into(), components, values, fault: None, has_numbers, first_empty: None }
    }

    /// An array that has no usable numbers, and why.
    pub(super) fn unusable(name: impl Into<String>, Unusable { problem, has_numbers }: Unusable) -> Self {
        let name = name.into();
        let at = format!("array `{name}`");
        Self::faulty(name, Fault { at, problem }, has_numbers)
    }

    /// An array with a fault, and whether it has numbers all the same.
    pub(super) fn faulty(name: impl Into<String>, fault: Fault, has_numbers: bool) -> Self {
        let (name, values, fault) = (name.into(), Vec::new(), Some(fault));
        Self { name, components: 1, values, fault, has_numbers, first_empty: None }
    }

    /// Appends numbers of further points.
    pub(super) fn extend(&mut self, values: Vec<f64>) {
        self.has_numbers |= values.iter().any(|value| !value.is_nan());
        self.values.extend(values);
    }

    /// The numbers of some of the points.
    fn select(self, chosen: &[usize]) -> Self {
        if self.fault.is_some() {
            return self;
        }
        let of_point = |&row: &usize| &self.values[row * self.components..][..self.components];
        let values = chosen.iter().flat_map(of_point).copied().collect();
        let first_empty = self.first_empty.and_then(|row| chosen.binary_search(&row).ok());
        Self { values, first_empty, ..self }
    }

    /// Whether the array has any number, be they all usable or not. One that has none (text, empty cells, NaN) is not
    /// among the default quantities.
    pub fn is_numeric(&self) -> bool {
        self.has_numbers
    }

    /// The numbers, or the fault as a problem.
    pub(super) fn usable(&self) -> Parsed<&[f64]> {
        match &self.fault {
            None => Ok(&self.values),
            Some(fault) => Err(Problem::at(&fault.at, &fault.problem)),
        }
    }
}

impl PointTable {
    /// A table of `coordinates`, one vector an axis, and `arrays`; `source` names it in messages.
    ///
    /// # Errors
    /// Not 1 to 3 axes, axes of different lengths, an array whose length is not its components times the points, or
    /// two arrays of one name.
    pub fn new(
        source: impl Into<String>,
        coordinates: Vec<Vec<f64>>,
        arrays: Vec<Array>,
    ) -> Result<Self, ReadError> {
        let source = source.into();
        Self::assemble(coordinates, arrays, Rows::points())
            .map(|table| Self { source: source.clone(), ..table })
            .map_err(|problem| problem.in_file(&source))
    }

    /// As [`new`](Self::new), before the source is known, and without the units behind names.
    pub(super) fn assemble(coordinates: Vec<Vec<f64>>, arrays: Vec<Array>, rows: Rows) -> Parsed<Self> {
        let names = AXES.iter().take(coordinates.len()).map(|&axis| axis.to_owned()).collect();
        Self::without_coordinates(arrays, rows).at(Coordinates {
            space: (0..coordinates.len()).collect(),
            names,
            values: coordinates,
        })
    }

    /// A table of arrays of which some are the coordinates: those that `named` names, or those of usual names.
    pub(super) fn of_arrays(arrays: Vec<Array>, rows: Rows, named: &[String]) -> Parsed<Self> {
        Self::without_coordinates(arrays, rows).placed(named)
    }

    /// A table of arrays beside coordinates that were an array of the same file.
    pub(super) fn beside(coordinates: Coordinates, arrays: Vec<Array>, rows: Rows) -> Parsed<Self> {
        let table = Self { is_placed: true, ..Self::without_coordinates(arrays, rows) };
        table.at(coordinates)
    }

    /// A table that is not whole yet: the units behind names are dropped.
    fn without_coordinates(mut arrays: Vec<Array>, rows: Rows) -> Self {
        drop_units(&mut arrays);
        let (source, coordinates, space) = (String::new(), Vec::new(), Vec::new());
        let (notes, axes) = (Vec::new(), Vec::new());
        Self { source, coordinates, space, arrays, notes, axes, rows, is_placed: false }
    }

    /// The table with the coordinates that are among its arrays, in place of those that it has.
    pub(super) fn placed(mut self, named: &[String]) -> Parsed<Self> {
        let names: Vec<(&str, usize)> =
            self.arrays.iter().map(|array| (array.name.as_str(), array.components)).collect();
        let place = position::find(&names, named).and_then(|place| {
            place.ok_or_else(|| {
                let expected = if self.rows.header().is_some() {
                    "column is called `x`"
                } else {
                    "array is called `x` or `pos`"
                };
                let names: Vec<String> = names.iter().map(|(name, _)| shown(name.as_bytes())).collect();
                Problem::position(format!("no {expected}; there are {}", names.join(", ")))
            })
        });
        let header = self.rows.header().map(|line| format!("line {line}"));
        let located = |problem: Problem| match &header {
            Some(line) => problem.or_at(line),
            None => problem,
        };
        let place = place.map_err(located)?;
        let coordinates = position::take(&mut self.arrays, &place, &self.rows).map_err(located)?;
        self.is_placed = true;
        self.notes.extend(coordinates.gap().filter(|_| named.is_empty()));
        self.at(coordinates)
    }

    /// The table with these coordinates, if all is as it must be.
    fn at(self, Coordinates { names, space, values }: Coordinates) -> Parsed<Self> {
        if !(1..=3).contains(&values.len()) {
            return Err(Problem::new(format!("1 to 3 dimensions expected, not {}", values.len())));
        }
        let table = Self { coordinates: values, space, axes: names, ..self };
        let points = table.len();
        if let Some(axis) = table.coordinates.iter().position(|axis| axis.len() != points) {
            let (first, name, length) = (&table.axes[0], &table.axes[axis], table.coordinates[axis].len());
            let points = counted(points, "value");
            return Err(Problem::new(format!("`{first}` has {points}, but `{name}` has {length}")));
        }
        check_names(table.arrays.iter().map(|array| array.name.as_str())).map_err(Problem::new)?;
        for array in table.arrays.iter().filter(|array| array.fault.is_none()) {
            if array.components == 0 || points.checked_mul(array.components) != Some(array.values.len()) {
                let (have, components) = (array.values.len(), array.components);
                let problem = format!("{} for {points} points of {components} each", counted(have, "value"));
                return Err(Problem::at(format!("array `{}`", array.name), problem));
            }
        }
        Ok(table)
    }

    /// The table of some of the points, by their numbers in ascending order.
    pub(crate) fn select(self, chosen: &[usize]) -> Self {
        if chosen.len() == self.len() {
            return self;
        }
        let coordinates = self.coordinates.iter().map(|axis| chosen.iter().map(|&row| axis[row]).collect());
        let (coordinates, rows) = (coordinates.collect(), self.rows.select(chosen));
        let arrays = self.arrays.into_iter().map(|array| array.select(chosen)).collect();
        Self { coordinates, rows, arrays, ..self }
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.coordinates.first().map_or(0, Vec::len)
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many coordinates a point has: 1 to 3.
    pub fn dimensions(&self) -> usize {
        self.coordinates.len()
    }

    /// Where the file has point `row`: `line 17` of a text table, whose first line is 1; else `point 12`, from 0.
    pub fn locate(&self, row: usize) -> String {
        self.rows.locate(row)
    }
}
