//! Particles in HDF5: `.h5`, `.hdf5`, as PySPH, Gadget, SWIFT and AREPO write them.
//!
//! A *set* is a group with coordinates among its datasets:
//!
//! | program | group | coordinates | mass |
//! |---|---|---|---|
//! | PySPH | `particles/NAME/arrays` | `x`, `y`, `z` | `m` |
//! | Gadget, SWIFT, AREPO | `PartTypeK` | `Coordinates`, N×3 | `Masses`, or number K of `MassTable` in `Header` |
//! | others | any, also the root | either | `m` or `mass` |
//!
//! Arrays are called as in the file, except that `Masses` is `mass`, and `Density` and `Densities` are `density`.

use super::budget::{Budget, refuse_many};
use super::hdf5_arrays::{Stored, array, open_arrays, plain_components};
use super::hdf5_sets::{self as sets, Set};
use super::hdf5_units as units;
use super::npz::place;
use super::{open, refuse_special};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem};
use crate::io::names::{MASS, OF_SNAPSHOTS};
use crate::io::position::{Coordinates, Place};
use crate::io::rows::Rows;
use crate::io::steady::Steady;
use crate::io::table::{Array, PointTable, Unusable};
use hdf5_pure::{Error, File, FormatError, ReadSeekSource, Source};
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

/// The first bytes of a file.
const MAGIC: &[u8] = b"\x89HDF\r\n\x1a\n";

/// How often the bytes of a file may be read: headers and indexes more than once, and indexes may lead to one place by many ways.
const MOST_READ: u64 = 16;

/// Bytes more for files that are small.
const SPARE: u64 = 1 << 24;

/// The stack of the reader, which follows types in types, of which 64 kB of a header name 8190: 128 MB without optimisation.
/// Of it, only what is used is taken.
const STACK: usize = 1 << 28;

/// Reads a set of particles: the one that is called so, or else `PartType0`, or else the only one. On a thread of its own, so
/// that neither a small stack nor a panic of the reader ends the process; none is known.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    let (path, set, named) = (&file.path, file.group.as_deref(), &file.position[..]);
    thread::scope(|scope| {
        let reader = thread::Builder::new().stack_size(STACK);
        let reader = reader.spawn_scoped(scope, || read_file(path, set, named))?;
        let panicked =
            |_| Err(Problem::new("the file is damaged, in a way that the reader of HDF5 has no words for"));
        reader.join().unwrap_or_else(panicked)
    })
}

fn read_file(path: &Path, set: Option<&str>, named: &[String]) -> Parsed<PointTable> {
    let expected = "a regular file is expected, because HDF5 is not read from its start to its end";
    refuse_special(path, false, expected)?;
    let bytes = path.metadata()?.len();
    let whole =
        ReadSeekSource::new(open(path, MAGIC)?.into_inner()).map_err(|error| unreadable(error.into()))?;
    let left = AtomicU64::new(bytes.saturating_mul(MOST_READ).saturating_add(SPARE));
    let file = File::from_source(Limited { whole, left }).map_err(unreadable)?;
    let set = sets::choose(&file, set, named)?;
    let at = format!("group `{}`", set.path);
    let mut source = Opened { file, bytes: fs::File::open(path)?, budget: Budget::of_file(bytes) };
    assemble(&mut source, &set, named).map_err(|problem| problem.or_at(&at))
}

/// A file as HDF5 and as bytes, and what it may cost.
struct Opened {
    file: File,
    bytes: fs::File,
    budget: Budget,
}

/// A file of which so many bytes more are read.
struct Limited {
    whole: ReadSeekSource<Steady<fs::File>>,
    left: AtomicU64,
}

impl Source for Limited {
    fn len(&self) -> u64 {
        self.whole.len()
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), FormatError> {
        let spend = |left: u64| left.checked_sub(buffer.len() as u64);
        if self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, spend).is_err() {
            let problem = "its indexes lead to the same places too often";
            return Err(FormatError::Source(problem.to_owned()));
        }
        self.whole.read_at(offset, buffer)
    }
}

/// Why the file cannot be opened.
fn unreadable(error: Error) -> Problem {
    Problem::new(match error {
        Error::FileMarkedInUse(_) => {
            "the file is marked as open for writing: the program that writes it still runs, or ended without closing it"
                .to_owned()
        }
        other => format!("not an HDF5 file, damaged or cut short: {}", words(&other)),
    })
}

/// What is wrong, without the name of the format before it.
pub(super) fn words(error: &Error) -> String {
    match error {
        Error::Format(error) => error.to_string(),
        other => other.to_string(),
    }
}

/// The table of a set.
fn assemble(source: &mut Opened, set: &Set, named: &[String]) -> Parsed<PointTable> {
    let Opened { file, bytes, budget } = source;
    let mut datasets = open_arrays(&set.group)?;
    refuse_many(datasets.len()).map_err(Problem::new)?;
    let notes = units::notes(file, &datasets);
    rename(&mut datasets)?;
    let shapes = datasets.iter().map(|dataset| (dataset.name.as_str(), &dataset.shape[..]));
    let place = place(shapes, named)?;
    let first = place.as_ref().and_then(|place| place.arrays().first());
    let points = first.and_then(|&at| datasets[at].shape.first().copied()).unwrap_or(0);
    // the coordinates first: what is wrong with others must not take what may be read from them
    let coordinates = place.as_ref().map_or(&[][..], Place::arrays);
    let mut order: Vec<usize> = (0..datasets.len()).collect();
    order.sort_by_key(|at| !coordinates.contains(at));
    let vectors = match &place {
        Some(Place::Vector(at)) => plain_components(&datasets[*at], points, bytes, budget)
            .map_err(|unusable| Problem::at(format!("array `{}`", datasets[*at].name), unusable.problem))?
            .map(|values| Coordinates::of_vector(&datasets[*at].name, values)),
        _ => None,
    };
    if vectors.is_some() {
        order.retain(|at| !coordinates.contains(at));
    }
    let mut arrays: Vec<Array> =
        order.iter().map(|&at| array(&datasets[at], points, bytes, budget)).collect();
    let has_mass = arrays.iter().any(|array| MASS.iter().any(|mass| array.name.eq_ignore_ascii_case(mass)));
    if !has_mass {
        arrays.extend(set.mass(file).map(|mass| mass_of_all(mass, points, budget)));
    }
    let table = match vectors {
        Some(vectors) => PointTable::beside(vectors, arrays, Rows::points())?,
        None => PointTable::of_arrays(arrays, Rows::points(), named)?,
    };
    Ok(PointTable { notes, ..table })
}

/// Gives mass and density their special names.
fn rename(datasets: &mut [Stored]) -> Parsed<()> {
    for (name, special) in OF_SNAPSHOTS {
        let Some(at) = datasets.iter().position(|dataset| dataset.name == name) else { continue };
        let is_special =
            |other: &&Stored| special.iter().any(|special| other.is(special)) && other.name != name;
        if let Some(other) = datasets.iter().find(is_special) {
            let problem = format!("both `{name}` and `{}` are there: one of them is expected", other.name);
            return Err(Problem::new(problem));
        }
        special[1].clone_into(&mut datasets[at].name);
    }
    Ok(())
}

/// The mass of the header for every point.
fn mass_of_all(mass: Result<f64, String>, points: usize, budget: &Budget) -> Array {
    let all = mass.and_then(|mass| {
        let mut all = budget.numbers(points)?;
        all.resize(points, mass);
        Ok(all)
    });
    match all {
        Ok(all) => Array::new(MASS[1], 1, all),
        Err(problem) => Array::unusable(MASS[1], Unusable::numbers(problem)),
    }
}
