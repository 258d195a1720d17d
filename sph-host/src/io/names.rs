//! What names of arrays mean: coordinates, masses, densities, components, units behind them.

use super::table::Array;
use std::collections::{HashMap, HashSet};

/// The names of the coordinates, axis by axis.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// The two names of the mass.
pub(super) const MASS: [&str; 2] = ["m", "mass"];

/// The two names of the density.
pub(super) const DENSITY: [&str; 2] = ["rho", "density"];

/// What snapshots of Gadget, SWIFT and AREPO call masses and densities, and the special names of these.
pub(super) const OF_SNAPSHOTS: [(&str, [&str; 2]); 3] =
    [("Masses", MASS), ("Density", DENSITY), ("Densities", DENSITY)];

/// What stands between the name of a vector and that of its component: `pos_x`, `Points:0`, `Pos.x`.
pub(super) const SEPARATORS: [char; 3] = ['_', ':', '.'];

/// Whether `name` is that of a coordinate, in any case of letters.
pub(super) fn is_axis(name: &str) -> bool {
    AXES.iter().any(|axis| name.eq_ignore_ascii_case(axis))
}

/// Whether `name` is that of a coordinate, the mass or the density, in any case of letters.
pub(super) fn is_special(name: &str) -> bool {
    AXES.iter().chain(&MASS).chain(&DENSITY).any(|special| name.eq_ignore_ascii_case(special))
}

/// How components are told apart: what stands before the axis, and whether axes are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Spelling {
    pub separator: char,
    pub is_counted: bool,
}

impl Spelling {
    /// All of them, `velocity_x` first.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        [false, true].into_iter().flat_map(|is_counted| {
            SEPARATORS.into_iter().map(move |separator| Self { separator, is_counted })
        })
    }

    /// The name of the component of a vector along an axis.
    pub(super) fn component(self, vector: &str, axis: usize) -> String {
        let Self { separator, is_counted } = self;
        if is_counted {
            format!("{vector}{separator}{axis}")
        } else {
            format!("{vector}{separator}{}", AXES[axis])
        }
    }
}

/// The vector, the spelling and the axis of the name of a component, such as `Points`, counted behind a colon, and 0 of `Points:0`.
pub(super) fn component(name: &str) -> Option<(&str, Spelling, usize)> {
    let last = name.chars().next_back()?;
    let before = &name[..name.len() - last.len_utf8()];
    let separator = before.chars().next_back().filter(|mark| SEPARATORS.contains(mark))?;
    let vector = &before[..before.len() - 1];
    let lettered = AXES.iter().position(|axis| last.to_ascii_lowercase().to_string() == *axis);
    let counted = last.to_digit(3).map(|digit| digit as usize);
    let axis = lettered.or(counted)?;
    Some((vector, Spelling { separator, is_counted: lettered.is_none() }, axis))
}

/// A name without the unit behind it, which stands in brackets, or in parentheses after a blank: `Vel.x [m/s]`, `x (m)`.
pub(super) fn without_unit(name: &str) -> &str {
    let whole = name.trim_end();
    let start = match whole.as_bytes().last() {
        Some(b']') => whole.rfind('['),
        Some(b')') => whole.rfind(" ("),
        _ => None,
    };
    let short = start.map_or("", |start| whole[..start].trim_end());
    if short.is_empty() { name } else { short }
}

/// Drops the units behind the names of arrays, but those that tell two arrays apart.
pub(super) fn drop_units(arrays: &mut [Array]) {
    let mut uses: HashMap<String, usize> = HashMap::new();
    for array in arrays.iter() {
        *uses.entry(without_unit(&array.name).to_ascii_lowercase()).or_default() += 1;
    }
    for array in arrays {
        let short = without_unit(&array.name);
        if short.len() < array.name.len() && uses.get(&short.to_ascii_lowercase()) == Some(&1) {
            array.name = short.to_owned();
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_behind_a_name() {
        for (name, short) in [
            ("Pos.x [m]", "Pos.x"),
            ("Rhop[kg/m^3]", "Rhop"),
            ("x (m)", "x"),
            ("sin(x)", "sin(x)"),
            ("[m]", "[m]"),
            (" (m)", " (m)"),
            ("a [b] c", "a [b] c"),
        ] {
            assert_eq!(without_unit(name), short);
        }
    }

    #[test]
    fn units_that_tell_arrays_apart_stay() {
        let mut arrays: Vec<Array> = ["p [Pa]", "T [K]", "t [s]", "T [C]"]
            .into_iter()
            .map(|name| Array::new(name, 1, Vec::new()))
            .collect();
        drop_units(&mut arrays);
        let names: Vec<&str> = arrays.iter().map(|array| array.name.as_str()).collect();
        assert_eq!(names, ["p", "T [K]", "t [s]", "T [C]"]);
    }

    #[test]
    fn components_are_spelled_in_six_ways() {
        let all: Vec<Spelling> = Spelling::all().collect();
        assert_eq!(all.len(), 6);
        for spelling in all {
            for axis in 0..3 {
                assert_eq!(component(&spelling.component("v", axis)), Some(("v", spelling, axis)));
            }
        }
        assert_eq!(component("Pos.X").map(|(vector, _, axis)| (vector, axis)), Some(("Pos", 0)));
        for none in ["", "x", "max", "v_3", "v-x", "é"] {
            assert_eq!(component(none), None, "{none}");
        }
    }
}
