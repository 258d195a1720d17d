//! The table that every reader fills.

use super::error::{Parsed, Problem, ReadError, counted};
use std::collections::{HashMap, HashSet};

/// The names of the coordinates, axis by axis.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The two names of the mass.
pub(super) const MASS: [&str; 2] = ["m", "mass"];

/// The two names of the density.
pub(super) const DENSITY: [&str; 2] = ["rho", "density"];

/// Whether `name` is that of a coordinate, in any case of letters.
pub(super) fn is_axis(name: &str) -> bool {
    AXES.iter().any(|axis| name.eq_ignore_ascii_case(axis))
}

/// Whether `name` is that of a coordinate, the mass or the density, in any case of letters.
pub(super) fn is_special(name: &str) -> bool {
    AXES.iter().chain(&MASS).chain(&DENSITY).any(|special| name.eq_ignore_ascii_case(special))
}

/// Points in 1 to 3 dimensions with named arrays, as a file gave them.
#[derive(Debug, Clone)]
pub struct PointTable {
    /// The file's name as given, for messages.
    pub source: String,
    /// The coordinates: one vector an axis, all of the same length, not yet checked to be finite.
    pub coordinates: Vec<Vec<f64>>,
    /// All other arrays of the points, in the file's order.
    pub arrays: Vec<Array>,
    /// What a person should know of the file, a line each: the units that it names, which are not applied.
    pub notes: Vec<String>,
    pub(super) rows: Rows,
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

/// How a row is named in messages.
#[derive(Debug, Clone)]
pub(super) enum Rows {
    /// By line: the header's, and pairs of the first row and its line, from where on rows and lines go in step.
    Lines(usize, Vec<(usize, usize)>),
    /// By number, from 0.
    Points,
}

impl Rows {
    /// Notes the line of the next row.
    pub(super) fn push(&mut self, row: usize, line: usize) {
        if let Self::Lines(_, steps) = self
            && steps.last().is_none_or(|&(first, start)| start + (row - first) != line)
        {
            steps.push((row, line));
        }
    }

    fn locate(&self, row: usize) -> String {
        match self {
            Self::Points => format!("point {row}"),
            Self::Lines(_, steps) => {
                let after = steps.partition_point(|&(first, _)| first <= row);
                let (first, start) = after.checked_sub(1).map_or((0, 2), |step| steps[step]);
                format!("line {}", start + (row - first))
            }
        }
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
        Self::assemble(coordinates, arrays, Rows::Points)
            .map(|table| Self { source: source.clone(), ..table })
            .map_err(|problem| problem.in_file(&source))
    }

    /// As [`new`](Self::new), before the source is known.
    pub(super) fn assemble(coordinates: Vec<Vec<f64>>, arrays: Vec<Array>, rows: Rows) -> Parsed<Self> {
        if !(1..=3).contains(&coordinates.len()) {
            return Err(Problem::new(format!("1 to 3 dimensions expected, not {}", coordinates.len())));
        }
        let table = Self { source: String::new(), coordinates, arrays, notes: Vec::new(), rows };
        let points = table.len();
        if let Some(axis) = table.coordinates.iter().position(|axis| axis.len() != points) {
            let (name, length) = (AXES[axis], table.coordinates[axis].len());
            let points = counted(points, "value");
            return Err(Problem::new(format!("`x` has {points}, but `{name}` has {length}")));
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

    /// The line of the header of a text table.
    pub(super) fn header(&self) -> Option<usize> {
        match self.rows {
            Rows::Lines(header, _) => Some(header),
            Rows::Points => None,
        }
    }

    /// Where the file has the value of `array` at point `row`.
    pub(super) fn place(&self, row: usize, array: &str) -> String {
        match self.rows {
            Rows::Lines(..) => format!("{}, column `{array}`", self.locate(row)),
            Rows::Points => format!("{} of array `{array}`", self.locate(row)),
        }
    }
}

/// Takes `x`, `y` and `z` out of `arrays`.
pub(super) fn take_coordinates(arrays: &mut Vec<Array>) -> Parsed<Vec<Vec<f64>>> {
    let mut coordinates = Vec::new();
    let mut missing = None;
    for axis in AXES {
        let Some(index) = arrays.iter().position(|array| array.name.eq_ignore_ascii_case(axis)) else {
            missing = missing.or(Some(axis));
            continue;
        };
        if let Some(missing) = missing {
            return Err(Problem::new(format!("there is a `{axis}` but no `{missing}`")));
        }
        let array = arrays.remove(index);
        array.usable()?;
        if array.components != 1 {
            let problem = format!("{} numbers a point, where one is expected", array.components);
            return Err(Problem::at(format!("array `{}`", array.name), problem));
        }
        coordinates.push(array.values);
    }
    Ok(coordinates)
}

/// That no two of `names` are the same; special names are the same in any case of letters.
pub(super) fn check_names<'a>(names: impl Iterator<Item = &'a str>) -> Result<(), String> {
    let mut seen = HashMap::new();
    for (index, name) in names.enumerate() {
        let key = if is_special(name) { name.to_ascii_lowercase() } else { name.to_owned() };
        if let Some((first, spelling)) = seen.insert(key, (index + 1, name)) {
            let second = index + 1;
            return Err(format!(
                "the name `{name}` of number {second} is taken: number {first} is `{spelling}`"
            ));
        }
    }
    Ok(())
}

/// Gives each empty name of a file's arrays one: `array_` and its position from 0, with underscores behind it where that
/// name is taken.
pub(crate) fn fill_empty_names(mut names: Vec<&mut String>) {
    let mut taken: HashSet<String> =
        names.iter().filter(|name| name.starts_with("array_")).map(|name| (*name).clone()).collect();
    for (index, name) in names.iter_mut().enumerate().filter(|(_, name)| name.is_empty()) {
        let mut free = format!("array_{index}");
        while taken.contains(&free) {
            free.push('_');
        }
        taken.insert(free.clone());
        **name = free;
    }
}
