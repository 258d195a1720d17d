//! Asking a [`PointTable`] for what it holds, by name.

use super::error::{Parsed, Problem, ReadError};
use super::names::{AXES, DENSITY, MASS, OF_SNAPSHOTS, Spelling, is_axis, is_special, without_unit};
use super::table::{Array, PointTable};
use std::borrow::Cow;

/// Numbers at the points of a table: a scalar, a vector, or one component of it.
#[derive(Debug, Clone)]
pub struct Quantity<'a> {
    /// The name that was asked for.
    pub name: String,
    /// The name of each component: the quantity's own for a scalar, `NAME_x` and so on for 2 or 3 components,
    /// `NAME_0` and so on for more.
    pub labels: Vec<String>,
    /// The numbers, point by point, `labels.len()` each.
    pub values: Cow<'a, [f64]>,
    /// What the file calls each component, for messages.
    columns: Vec<String>,
}

impl Quantity<'_> {
    /// How many numbers a point has.
    pub fn components(&self) -> usize {
        self.labels.len()
    }
}

impl PointTable {
    /// The array of exactly this name, with or without the unit behind it; a special name in any case of letters.
    pub fn array(&self, name: &str) -> Option<&Array> {
        let called = |name: &str| self.arrays.iter().find(|array| array.name == name);
        let is_same = |array: &&Array| is_special(name) && array.name.eq_ignore_ascii_case(name);
        called(name).or_else(|| self.arrays.iter().find(is_same)).or_else(|| called(without_unit(name)))
    }

    /// What is evaluated when nothing is asked for: every array with [any number](Array::is_numeric) in it that is no
    /// coordinate, mass or density, in the file's order. Columns of a text table stand one by one.
    pub fn default_quantities(&self) -> Vec<String> {
        let wanted = self.arrays.iter().filter(|array| array.is_numeric() && !is_special(&array.name));
        wanted.map(|array| array.name.clone()).collect()
    }

    /// The quantity called `name`: an array of that name; one component `velocity_x` of an array `velocity`; or the
    /// vector `velocity` of the columns `velocity_x`, `velocity_y`, `velocity_z`, as many as there are, which may also be spelled
    /// `velocity:0`, `velocity.x` and the like. The first of these that is there. `rho` and `density` stand for each other, as do `m` and `mass`.
    ///
    /// # Errors
    /// There is no such quantity, it is a coordinate, or the file holds something else than numbers there.
    pub fn quantity(&self, name: &str) -> Result<Quantity<'_>, ReadError> {
        self.resolve(name).map_err(|problem| problem.in_file(&self.source))
    }

    /// As [`quantity`](Self::quantity), of one number a point.
    ///
    /// # Errors
    /// As [`quantity`](Self::quantity), and when a point has more than one number.
    pub fn scalar(&self, name: &str) -> Result<Quantity<'_>, ReadError> {
        let quantity = self.quantity(name)?;
        if quantity.components() == 1 {
            return Ok(quantity);
        }
        let problem =
            format!("`{name}` has {} numbers a point, where one is expected", quantity.components());
        Err(Problem::new(problem).in_file(&self.source))
    }

    /// One number a point: a coordinate, an array, or a component of one.
    ///
    /// # Errors
    /// As [`scalar`](Self::scalar).
    pub(crate) fn column(&self, name: &str) -> Result<Cow<'_, [f64]>, ReadError> {
        let axis = self.axes.iter().position(|axis| axis.eq_ignore_ascii_case(name)).or_else(|| {
            let axis = AXES.iter().position(|axis| axis.eq_ignore_ascii_case(name))?;
            let own = self.space.iter().position(|&known| known == axis)?;
            self.array(name).is_none().then_some(own)
        });
        match axis {
            Some(axis) => Ok(Cow::Borrowed(&self.coordinates[axis])),
            None => Ok(self.scalar(name)?.values),
        }
    }

    /// The masses: the array `m` or `mass`, `None` if there is neither.
    ///
    /// # Errors
    /// There are both, or the one that is there does not hold one number a point.
    pub fn mass(&self) -> Result<Option<Quantity<'_>>, ReadError> {
        self.either(MASS)
    }

    /// The densities: the array `rho` or `density`, `None` if there is neither.
    ///
    /// # Errors
    /// There are both, or the one that is there does not hold one number a point.
    pub fn density(&self) -> Result<Option<Quantity<'_>>, ReadError> {
        self.either(DENSITY)
    }

    /// That there is at most one of `m` and `mass`, and of `rho` and `density`, whether they are used or not.
    ///
    /// # Errors
    /// Names the pair.
    pub fn require_one_name_each(&self) -> Result<(), ReadError> {
        [MASS, DENSITY].into_iter().try_for_each(|names| self.one_of(names).map(drop))
    }

    fn either(&self, names: [&str; 2]) -> Result<Option<Quantity<'_>>, ReadError> {
        self.one_of(names)?.map(|array| self.scalar(&array.name)).transpose()
    }

    fn one_of(&self, names: [&str; 2]) -> Result<Option<&Array>, ReadError> {
        match names.map(|name| self.array(name)) {
            [Some(first), Some(second)] => {
                let (first, second) = (&first.name, &second.name);
                let problem = format!("both `{first}` and `{second}` are there: one of them is expected");
                Err(self.of_names(problem).in_file(&self.source))
            }
            [array, None] | [None, array] => Ok(array),
        }
    }

    fn resolve(&self, name: &str) -> Parsed<Quantity<'_>> {
        let is_coordinate = self.axes.iter().any(|axis| axis.eq_ignore_ascii_case(name));
        if is_coordinate || is_axis(name) && self.array(name).is_none() {
            return Err(self.of_names(format!("`{name}` is a coordinate, not a quantity")));
        }
        if let Some(array) = self.array(name).or_else(|| self.array(other_name(name)?)) {
            return whole(name, array);
        }
        if let Some((array, component)) = self.component(name) {
            let values = array.usable()?.iter().skip(component).step_by(array.components).copied().collect();
            return Ok(Quantity {
                name: name.to_owned(),
                labels: vec![name.to_owned()],
                values: Cow::Owned(values),
                columns: vec![name.to_owned()],
            });
        }
        self.gathered(name)?.ok_or_else(|| self.unknown(name))
    }

    /// The array and the component of it that `name` is called by.
    fn component(&self, name: &str) -> Option<(&Array, usize)> {
        let (base, _) = name.rsplit_once('_')?;
        let array = self.array(base).filter(|array| array.components > 1)?;
        let component = labels(base, array.components).iter().position(|label| label == name)?;
        Some((array, component))
    }

    /// The vector `name` of the columns of its components, `name_x`, `name_y`, `name_z` or spelled otherwise.
    fn gathered(&self, name: &str) -> Parsed<Option<Quantity<'_>>> {
        let components = |spelling: Spelling| {
            let along =
                |axis| self.array(&spelling.component(name, axis)).filter(|array| array.components == 1);
            let found = [0, 1, 2].map(along);
            let columns: Vec<&Array> = found.into_iter().map_while(|array| array).collect();
            (!columns.is_empty() && columns.len() == found.iter().flatten().count()).then_some(columns)
        };
        let Some(columns) = Spelling::all().find_map(components) else { return Ok(None) };
        let slices = columns.iter().map(|array| array.usable()).collect::<Parsed<Vec<_>>>()?;
        let mut values = Vec::with_capacity(self.len() * slices.len());
        for point in 0..self.len() {
            values.extend(slices.iter().map(|slice| slice[point]));
        }
        let names: Vec<String> = columns.iter().map(|array| array.name.clone()).collect();
        let (labels, columns) = (names.clone(), names);
        Ok(Some(Quantity { name: name.to_owned(), labels, values: Cow::Owned(values), columns }))
    }

    fn unknown(&self, name: &str) -> Problem {
        let known: Vec<String> = self.arrays.iter().map(|array| format!("`{}`", array.name)).collect();
        let known = if known.is_empty() { "nothing but coordinates".to_owned() } else { known.join(", ") };
        self.of_names(format!("there is no quantity `{name}`; the file has {known}"))
    }

    /// A problem of the names: in a text table, of its header.
    fn of_names(&self, problem: String) -> Problem {
        match self.rows.header() {
            Some(line) => Problem::at(format!("line {line}"), problem),
            None => Problem::new(problem),
        }
    }

    /// That every number of `quantity` is finite, and so is the span from the least to the greatest.
    ///
    /// # Errors
    /// Names the first place where it is not so.
    pub fn require_finite(&self, quantity: &Quantity<'_>) -> Result<(), ReadError> {
        self.require(quantity, f64::is_finite, "a finite number")?;
        for (component, column) in quantity.columns.iter().enumerate() {
            let values = quantity.values.iter().skip(component).step_by(quantity.components());
            require_span(values).map_err(|problem| self.spanning(column, problem))?;
        }
        Ok(())
    }

    /// That every number of `quantity` is finite and greater than zero.
    ///
    /// # Errors
    /// Names the first place where it is not so.
    pub fn require_positive(&self, quantity: &Quantity<'_>) -> Result<(), ReadError> {
        self.require(quantity, |value| value.is_finite() && value > 0.0, "a positive finite number")
    }

    fn require(
        &self,
        quantity: &Quantity<'_>,
        holds: impl Fn(f64) -> bool,
        expected: &str,
    ) -> Result<(), ReadError> {
        let Some(index) = quantity.values.iter().position(|&value| !holds(value)) else { return Ok(()) };
        let (row, component) = (index / quantity.components(), index % quantity.components());
        let column = &quantity.columns[component];
        let is_empty = self.array(column).is_some_and(|array| array.first_empty == Some(row));
        let found =
            if is_empty { "the cell is empty".to_owned() } else { quantity.values[index].to_string() };
        let problem = format!("{found} where {expected} is expected");
        let at = self.rows.place(row, column);
        Err(Problem::at(at, problem).in_file(&self.source))
    }

    /// That every coordinate is finite, and so is the extent of each axis.
    ///
    /// # Errors
    /// Names the first place where it is not so.
    pub fn require_finite_coordinates(&self) -> Result<(), ReadError> {
        for (values, axis) in self.coordinates.iter().zip(&self.axes) {
            if let Some(row) = values.iter().position(|value| !value.is_finite()) {
                let problem = format!("{} where a finite number is expected", values[row]);
                return Err(Problem::at(self.rows.place(row, axis), problem).in_file(&self.source));
            }
            require_span(values.iter()).map_err(|problem| self.spanning(axis, problem))?;
        }
        Ok(())
    }

    fn spanning(&self, column: &str, rows: [(usize, f64); 2]) -> ReadError {
        let [(low, least), (high, greatest)] = rows;
        let (low, high) = (self.locate(low), self.locate(high));
        let problem =
            format!("from {least:e} ({low}) to {greatest:e} ({high}) is beyond what a number holds");
        Problem::at(format!("`{column}`"), problem).in_file(&self.source)
    }
}

/// The other name of a mass or density.
fn other_name(name: &str) -> Option<&'static str> {
    let renamed = OF_SNAPSHOTS.iter().find(|(own, _)| name.eq_ignore_ascii_case(own));
    if let Some((_, [_, long])) = renamed.filter(|(own, [_, long])| !own.eq_ignore_ascii_case(long)) {
        return Some(long);
    }
    [MASS, DENSITY].into_iter().find_map(|[short, long]| {
        if name.eq_ignore_ascii_case(short) {
            Some(long)
        } else {
            name.eq_ignore_ascii_case(long).then_some(short)
        }
    })
}

fn whole<'a>(name: &str, array: &'a Array) -> Parsed<Quantity<'a>> {
    let values = Cow::Borrowed(array.usable()?);
    let (labels, columns) = (labels(name, array.components), labels(&array.name, array.components));
    Ok(Quantity { name: name.to_owned(), labels, values, columns })
}

fn labels(name: &str, components: usize) -> Vec<String> {
    match components {
        1 => vec![name.to_owned()],
        2 | 3 => AXES[..components].iter().map(|axis| format!("{name}_{axis}")).collect(),
        _ => (0..components).map(|component| format!("{name}_{component}")).collect(),
    }
}

/// The rows and values of the least and the greatest, if their difference overflows.
fn require_span<'a>(values: impl Iterator<Item = &'a f64>) -> Result<(), [(usize, f64); 2]> {
    let (mut low, mut high) = ((0, f64::INFINITY), (0, f64::NEG_INFINITY));
    for (row, &value) in values.enumerate() {
        if value < low.1 {
            low = (row, value);
        }
        if value > high.1 {
            high = (row, value);
        }
    }
    // Without a value the difference is −∞.
    if high.1 - low.1 == f64::INFINITY { Err([low, high]) } else { Ok(()) }
}
