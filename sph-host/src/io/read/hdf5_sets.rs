//! The sets of particles in an HDF5 file, and the one that is meant.

use super::hdf5::words;
use super::hdf5_units::attribute_numbers;
use crate::io::error::{Parsed, Problem};
use crate::io::position::may_begin;
use hdf5_pure::{File, Group};

/// The set that is read where none is asked for: the gas of Gadget, SWIFT and AREPO.
const USUAL: &str = "PartType0";

/// How such sets begin.
const KIND: &str = "PartType";

/// The group of each of PySPH's sets, the group in it that has the arrays, and what stands before both.
const PYSPH: (&str, &str) = ("particles", "arrays");

/// Groups in groups that are looked into.
const MOST_DEPTH: usize = 5;

/// Groups that are looked into in all.
const MOST_GROUPS: usize = 4096;

/// Names that an error lists.
const MOST_NAMED: usize = 20;

/// A group with coordinates.
pub(super) struct Set {
    /// Its place in the file, without a slash before it; `/` for the root.
    pub path: String,
    pub group: Group,
}

/// The set that is called `wanted`; without that, `PartType0`, or the only set.
pub(super) fn choose(file: &File, wanted: Option<&str>, position: &[String]) -> Parsed<Set> {
    if let Some(name) = wanted {
        return named(file, name, position);
    }
    if let Some(usual) = at(file, USUAL, position)? {
        return Ok(usual);
    }
    let mut sets = all(file, position)?;
    match sets.len() {
        0 => Err(Problem::position(format!("no group holds {WANTED}"))),
        1 => Ok(sets.remove(0)),
        _ => Err(Problem::SeveralSets { sets: names(&sets) }),
    }
}

/// What makes a group a set.
const WANTED: &str = "particles: a dataset `Coordinates`, `pos` or `x` is expected";

/// The set that is called `name`, by PySPH's name or by its place.
fn named(file: &File, name: &str, position: &[String]) -> Parsed<Set> {
    let (particles, arrays) = PYSPH;
    let path = name.trim_matches('/');
    let within = |inner: String| if path.is_empty() { arrays.to_owned() } else { inner };
    let places = [
        path.to_owned(),
        within(format!("{path}/{arrays}")),
        within(format!("{particles}/{path}/{arrays}")),
        within(format!("{particles}/{path}")),
    ];
    for place in &places {
        if let Some(set) = at(file, place, position)? {
            return Ok(set);
        }
    }
    let problem = match places.iter().find_map(|place| group(file, place)) {
        Some(_) => format!("the group `{name}` does not hold {WANTED}"),
        None => format!("there is no group `{name}`"),
    };
    let sets = names(&all(file, position)?);
    let others = if sets.is_empty() { "no other does".to_owned() } else { format!("there are {sets}") };
    Err(Problem::new(format!("{problem}; of the groups with particles {others}")))
}

/// The set at a place, if there is one.
fn at(file: &File, path: &str, position: &[String]) -> Parsed<Option<Set>> {
    let Some(group) = group(file, path) else { return Ok(None) };
    let path = if path.is_empty() { "/" } else { path }.to_owned();
    Ok(is_set(&group, &path, position)?.then_some(Set { path, group }))
}

/// The group at a place, if there is one.
fn group(file: &File, path: &str) -> Option<Group> {
    if path.is_empty() { Some(file.root()) } else { file.group(path).ok() }
}

/// Whether there are coordinates among a group's datasets.
fn is_set(group: &Group, path: &str, position: &[String]) -> Parsed<bool> {
    let datasets = group.datasets().map_err(|error| damaged(path, &error))?;
    Ok(datasets.iter().any(|name| may_begin(name, position)))
}

/// Every set of the file; those of Gadget's kinds alone where there are such, since SWIFT gives them second names.
fn all(file: &File, position: &[String]) -> Parsed<Vec<Set>> {
    let mut sets = Vec::new();
    let mut waiting = vec![(String::from("/"), file.root(), 0)];
    let mut seen = 0;
    while let Some((path, group, depth)) = waiting.pop() {
        seen += 1;
        if seen > MOST_GROUPS {
            return Err(Problem::new(format!(
                "more than {MOST_GROUPS} groups, where at most so many are read"
            )));
        }
        if depth < MOST_DEPTH {
            let inner = group.iter_groups().map_err(|error| damaged(&path, &error))?;
            let place = |name: String| if depth == 0 { name } else { format!("{path}/{name}") };
            let mut inner: Vec<_> = inner.map(|(name, group)| (place(name), group, depth + 1)).collect();
            inner.reverse();
            waiting.append(&mut inner);
        }
        if is_set(&group, &path, position)? {
            sets.push(Set { path, group });
        }
    }
    if sets.iter().any(|set| set.path.starts_with(KIND)) {
        sets.retain(|set| set.path.starts_with(KIND));
    }
    Ok(sets)
}

fn damaged(path: &str, error: &hdf5_pure::Error) -> Problem {
    Problem::at(
        format!("group `{path}`"),
        format!("damaged, cut short, or with links, which are not read: {}", words(error)),
    )
}

/// The names of sets, for a message.
fn names(sets: &[Set]) -> String {
    let named: Vec<String> = sets.iter().take(MOST_NAMED).map(|set| format!("`{}`", set.name())).collect();
    let more = if sets.len() > MOST_NAMED { ", …" } else { "" };
    format!("{}{more}", named.join(", "))
}

impl Set {
    /// What the set is called: PySPH's name, else its place.
    fn name(&self) -> &str {
        let (particles, arrays) = PYSPH;
        let parts: Vec<&str> = self.path.split('/').collect();
        match parts[..] {
            [first, name, last] if first == particles && last == arrays => name,
            _ => &self.path,
        }
    }

    /// The mass that the file's header has for all particles of one of Gadget's kinds, where it is not 0, or why that cannot be read.
    pub(super) fn mass(&self, file: &File) -> Option<Result<f64, String>> {
        let kind: usize = self.path.strip_prefix(KIND)?.parse().ok()?;
        let header = file.group("Header").ok()?;
        match header.attrs() {
            Ok(attributes) => {
                let masses = attribute_numbers(attributes.get("MassTable")?)?;
                masses.get(kind).copied().filter(|&mass| mass != 0.0).map(|mass| checked(mass, kind))
            }
            Err(error) => {
                Some(Err(format!("the attributes of the group `Header` are damaged: {}", words(&error))))
            }
        }
    }
}

/// A number of the header's `MassTable`.
fn checked(mass: f64, kind: usize) -> Result<f64, String> {
    if mass > 0.0 && mass.is_finite() {
        return Ok(mass);
    }
    Err(format!(
        "number {kind} of `MassTable` in the group `Header` is {mass}, where a finite number above 0 is expected"
    ))
}
