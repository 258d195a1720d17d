//! Where among a file's arrays the coordinates are.
//!
//! They are known by the names that programs give them: `x`, `y`, `z`; an array of vectors called `pos`, `positions`,
//! `coordinates` or the like; or its components, spelled as in `Points:0`, `Points_0`, `pos_x`, `Pos.x`. Where a file has more
//! than one such set, the user says which is meant.

use super::error::{Parsed, Problem};
use super::names::{AXES, Spelling, component, without_unit};
use super::rows::Rows;
use super::table::Array;

/// The names of arrays of coordinates, in small letters.
const VECTORS: [&str; 6] = ["pos", "position", "positions", "coordinates", "coords", "points"];

fn is_vector(name: &str) -> bool {
    VECTORS.iter().any(|vector| name.eq_ignore_ascii_case(vector))
}

/// Where coordinates are, by the numbers of arrays.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Place {
    /// In one array of 1 to 3 numbers a point.
    Vector(usize),
    /// In an array of one number a point for each axis.
    Columns(Vec<usize>),
}

impl Place {
    /// The numbers of the arrays.
    pub(super) fn arrays(&self) -> &[usize] {
        match self {
            Self::Vector(array) => std::slice::from_ref(array),
            Self::Columns(arrays) => arrays,
        }
    }
}

/// Coordinates with the name that messages call each axis by.
pub(super) struct Coordinates {
    pub(super) names: Vec<String>,
    /// The axis in space of each.
    pub(super) space: Vec<usize>,
    pub(super) values: Vec<Vec<f64>>,
}

impl Coordinates {
    /// Those of an array of vectors, by its name and its 1 to 3 components.
    pub(super) fn of_vector(name: &str, values: Vec<Vec<f64>>) -> Self {
        let names = match values.len() {
            1 => vec![name.to_owned()],
            components => AXES[..components].iter().map(|axis| format!("{name}_{axis}")).collect(),
        };
        Self { names, space: (0..values.len()).collect(), values }
    }

    /// What a person should know where an axis before another is missing, for it may have been called something else.
    pub(super) fn gap(&self) -> Option<String> {
        let last = self.space.last()?;
        let missing: Vec<&str> =
            (0..*last).filter(|axis| !self.space.contains(axis)).map(|axis| AXES[axis]).collect();
        let names: Vec<String> = self.names.iter().map(|name| format!("`{name}`")).collect();
        (!missing.is_empty()).then(|| {
            format!("the coordinates are {} alone, without {}", names.join(" and "), missing.join(" and "))
        })
    }
}

/// Finds the coordinates among arrays, each a name and how many numbers a point has: by the names that `named` has, or by the
/// usual ones. `None` where there is none of these.
pub(super) fn find(arrays: &[(&str, usize)], named: &[String]) -> Parsed<Option<Place>> {
    match named {
        [] => usual(arrays),
        [one] => vector(arrays, one).map(Some),
        several => {
            let columns = several.iter().map(|name| column(arrays, name)).collect::<Parsed<Vec<_>>>()?;
            let is_twice = |&&at: &&usize| columns.iter().filter(|&&other| other == at).count() > 1;
            match columns.iter().find(is_twice) {
                Some(&at) => Err(Problem::position(format!("`{}` is named for two axes", arrays[at].0))),
                None => Ok(Some(Place::Columns(columns))),
            }
        }
    }
}

/// Whether an array of this name may be the first of the coordinates.
pub(super) fn may_begin(name: &str, named: &[String]) -> bool {
    let name = without_unit(name);
    let vector = component(name).map(|(vector, _, axis)| (vector, axis));
    if let Some(first) = named.first() {
        let is_it = |name: &str| name.eq_ignore_ascii_case(without_unit(first));
        return is_it(name) || vector.is_some_and(|(vector, _)| is_it(vector));
    }
    name.eq_ignore_ascii_case(AXES[0])
        || is_vector(name)
        || vector.is_some_and(|(vector, axis)| axis == 0 && is_vector(vector))
}

/// The array of exactly this name, or of this name but for letters and the unit.
fn index(arrays: &[(&str, usize)], name: &str) -> Option<usize> {
    let exact = arrays.iter().position(|(known, _)| *known == name);
    exact.or_else(|| arrays.iter().position(|(known, _)| known.eq_ignore_ascii_case(without_unit(name))))
}

fn unknown(arrays: &[(&str, usize)], name: &str) -> Problem {
    let known: Vec<String> = arrays.iter().map(|(name, _)| format!("`{name}`")).collect();
    Problem::position(format!("there is no `{name}` to be the coordinates; there are {}", known.join(", ")))
}

fn column(arrays: &[(&str, usize)], name: &str) -> Parsed<usize> {
    let at = index(arrays, name).ok_or_else(|| unknown(arrays, name))?;
    match arrays[at] {
        (_, 1) => Ok(at),
        (name, numbers) => {
            Err(Problem::position(format!("`{name}` has {numbers} numbers a point, where one is expected")))
        }
    }
}

/// The array of vectors with this name, or the columns of its components.
fn vector(arrays: &[(&str, usize)], name: &str) -> Parsed<Place> {
    if let Some(at) = index(arrays, name) {
        return match arrays[at] {
            (_, 1..=3) => Ok(Place::Vector(at)),
            (name, numbers) => Err(Problem::position(format!(
                "`{name}` has {numbers} numbers a point, where 1 to 3 are expected"
            ))),
        };
    }
    let components = Spelling::all().map(|spelling| {
        let along = |axis| index(arrays, &spelling.component(name, axis)).filter(|&at| arrays[at].1 == 1);
        (0..3).map_while(along).collect::<Vec<_>>()
    });
    let found = components.into_iter().find(|columns| !columns.is_empty());
    found.map(Place::Columns).ok_or_else(|| unknown(arrays, name))
}

/// The coordinates by usual names.
fn usual(arrays: &[(&str, usize)]) -> Parsed<Option<Place>> {
    let mut places = vec![plain(arrays)];
    places.extend(VECTORS.iter().flat_map(|vector| {
        let whole = arrays
            .iter()
            .position(|(name, numbers)| (2..=3).contains(numbers) && name.eq_ignore_ascii_case(vector));
        let columns = Spelling::all().map(|spelling| components(arrays, vector, spelling));
        columns.into_iter().chain([whole.map(Place::Vector)]).collect::<Vec<_>>()
    }));
    let mut places = places.into_iter().flatten();
    match (places.next(), places.next()) {
        (Some(first), Some(second)) => {
            let [first, second] = [first, second].map(|place| spelled(arrays, &place));
            Err(Problem::position(format!(
                "coordinates are in {first} and in {second}: one of them is expected"
            )))
        }
        (Some(place), None) => Ok(Some(place)),
        (None, _) => alone(arrays),
    }
}

/// The columns `x`, `y`, `z`, as many as there are without a gap. A plane may have two others where they stand first: of what stands before
/// or between, one could be the third by another name.
fn plain(arrays: &[(&str, usize)]) -> Option<Place> {
    let found = AXES.map(|axis| arrays.iter().position(|(name, _)| name.eq_ignore_ascii_case(axis)));
    let all: Vec<usize> = found.into_iter().flatten().collect();
    if all == [0, 1] { Some(Place::Columns(all)) } else { without_gap(found) }
}

/// The axis in space of each column: what the names say, where these are of axes in order; else the first ones.
fn space(names: &[String]) -> Vec<usize> {
    let axis = |name: &String| {
        let plain = AXES.iter().position(|axis| name.eq_ignore_ascii_case(axis));
        plain.or_else(|| component(name).map(|(_, _, axis)| axis))
    };
    let said: Option<Vec<usize>> = names.iter().map(axis).collect();
    said.filter(|axes| axes.is_sorted_by(|a, b| a < b)).unwrap_or_else(|| (0..names.len()).collect())
}

/// The columns of the components of a vector, in one spelling, as many as there are without a gap.
fn components(arrays: &[(&str, usize)], vector: &str, spelling: Spelling) -> Option<Place> {
    let mut found = [None; 3];
    for (at, (name, numbers)) in arrays.iter().enumerate() {
        let Some((of, how, axis)) = component(name) else { continue };
        if *numbers == 1 && how == spelling && of.eq_ignore_ascii_case(vector) {
            found[axis] = found[axis].or(Some(at));
        }
    }
    without_gap(found)
}

fn without_gap(found: [Option<usize>; 3]) -> Option<Place> {
    let axes: Vec<usize> = found.into_iter().map_while(|at| at).collect();
    (!axes.is_empty() && axes.len() == found.iter().flatten().count()).then_some(Place::Columns(axes))
}

/// What is left where no set is whole: an array of one number a point by the name of a vector, or an error for an axis that is missing.
fn alone(arrays: &[(&str, usize)]) -> Parsed<Option<Place>> {
    let has = |axis: &&&str| arrays.iter().any(|(name, _)| name.eq_ignore_ascii_case(axis));
    if let Some(axis) = AXES.iter().rfind(has) {
        let missing = AXES.iter().find(|axis| !has(axis)).unwrap_or(axis);
        return Err(Problem::position(format!("there is a `{axis}` but no `{missing}`")));
    }
    match arrays.iter().position(|(name, _)| is_vector(name)) {
        Some(at) if arrays[at].1 > 3 => {
            let (name, numbers) = arrays[at];
            Err(Problem::position(format!(
                "`{name}` has {numbers} numbers a point, where 1 to 3 are expected"
            )))
        }
        found => Ok(found.map(Place::Vector)),
    }
}

fn spelled(arrays: &[(&str, usize)], place: &Place) -> String {
    let names: Vec<String> = place.arrays().iter().map(|&at| format!("`{}`", arrays[at].0)).collect();
    names.join(", ")
}

/// Takes the coordinates out of the arrays.
pub(super) fn take(arrays: &mut Vec<Array>, place: &Place, rows: &Rows) -> Parsed<Coordinates> {
    for &at in place.arrays() {
        let array = &arrays[at];
        array.usable()?;
        if matches!(place, Place::Columns(_)) && array.components != 1 {
            let problem = format!("{} numbers a point, where one is expected", array.components);
            return Err(Problem::at(format!("array `{}`", array.name), problem));
        }
        if let Some(row) = array.first_empty {
            let problem = "the cell is empty where a number is expected";
            return Err(Problem::at(rows.place(row, &array.name), problem));
        }
    }
    let coordinates = match place {
        Place::Vector(at) => {
            let Array { name, components, values, .. } = &arrays[*at];
            let axis = |axis: usize| values.iter().skip(axis).step_by(*components).copied().collect();
            Coordinates::of_vector(name, (0..*components).map(axis).collect())
        }
        Place::Columns(columns) => {
            let (names, values): (Vec<String>, _) = columns
                .iter()
                .map(|&at| (arrays[at].name.clone(), std::mem::take(&mut arrays[at].values)))
                .unzip();
            Coordinates { space: space(&names), names, values }
        }
    };
    let mut number = 0;
    arrays.retain(|_| {
        number += 1;
        !place.arrays().contains(&(number - 1))
    });
    Ok(coordinates)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(names: &[(&str, usize)], named: &[&str]) -> Result<Option<Vec<usize>>, String> {
        let named: Vec<String> = named.iter().map(|&name| name.to_owned()).collect();
        match find(names, &named) {
            Ok(place) => Ok(place.map(|place| place.arrays().to_vec())),
            Err(problem) => Err(problem.in_file("f").to_string()),
        }
    }

    #[test]
    fn programs_spell_coordinates_in_many_ways() {
        for names in [
            ["m", "x", "y"],
            ["m", "X", "Y"],
            ["m", "Points:0", "Points:1"],
            ["m", "Points_0", "Points_1"],
            ["m", "pos_x", "pos_y"],
            ["m", "Pos.x", "Pos.y"],
            ["m", "position_x", "position_y"],
        ] {
            assert_eq!(found(&names.map(|name| (name, 1)), &[]), Ok(Some(vec![1, 2])), "{names:?}");
        }
        for name in ["positions", "Coordinates", "coords", "POS"] {
            assert_eq!(found(&[("m", 1), (name, 2)], &[]), Ok(Some(vec![1])));
        }
        assert_eq!(found(&[("m", 1), ("velocity_x", 1)], &[]), Ok(None));
        assert_eq!(found(&[("x", 1), ("pos", 9), ("pos_y", 1), ("Points_1", 1)], &[]), Ok(Some(vec![0])));
        assert_eq!(found(&[("x", 1), ("z", 1), ("m", 1)], &[]), Ok(Some(vec![0, 1])));
        for between in [[("x", 1), ("b", 1), ("z", 1)], [("b", 1), ("x", 1), ("z", 1)]] {
            assert!(found(&between, &[]).unwrap_err().contains("`z` but no `y`"));
        }
        assert!(found(&[("z", 1), ("m", 1)], &[]).unwrap_err().contains("`z` but no `x`"));
    }

    #[test]
    fn two_sets_are_an_error_that_names_both_unless_one_is_named() {
        let names = [("x", 1), ("y", 1), ("pos_x", 1), ("pos_y", 1), ("Points", 3)];
        let error = found(&names, &[]).unwrap_err();
        assert!(error.contains("`x`, `y`") && error.contains("`pos_x`, `pos_y`"), "{error}");
        assert_eq!(found(&names, &["pos"]), Ok(Some(vec![2, 3])));
        assert_eq!(found(&names, &["Points"]), Ok(Some(vec![4])));
        assert_eq!(found(&names, &["y", "pos_x"]), Ok(Some(vec![1, 2])));
        assert_eq!(found(&names, &["X [m]", "y"]), Ok(Some(vec![0, 1])));
        for (named, part) in [(&["w"][..], "`w`"), (&["x", "x"], "two axes"), (&["x", "Points"], "3 numbers")]
        {
            let error = found(&names, named).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
    }
}
