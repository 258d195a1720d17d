//! Archives of NumPy arrays: `.npz`.

use super::budget::{Budget, MOST_PACKED, refuse_many, refuse_wide};
use super::npy::Header;
use super::{Buffered, open, refuse_special};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, counted};
use crate::io::names::{DENSITY, MASS, fill_empty_names, without_unit};
use crate::io::position::{self, Place};
use crate::io::rows::Rows;
use crate::io::table::{Array, PointTable, Unusable};
use std::io::{Read, Seek};
use std::path::Path;
use zip::ZipArchive;

/// The first bytes of every ZIP file that is not empty.
const MAGIC: &[u8] = b"PK";

/// An array of an archive.
pub(super) struct Member {
    pub(super) name: String,
    pub(super) shape: Vec<usize>,
    pub(super) values: Result<Vec<f64>, Unusable>,
}

/// Reads an archive with the arrays `x`, `y`, `z`, or `pos` of N×D.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    let (mut archive, budget) = open_archive(&file.path)?;
    let mut members = Vec::new();
    for index in 0..archive.len() {
        members.extend(member(&mut archive, index, &budget)?);
    }
    fill_empty_names(members.iter_mut().map(|member| &mut member.name).collect());
    assemble(members, &file.position, &budget)
}

/// Opens the archive, which has to be a regular file, with the budget of its size.
pub(super) fn open_archive(path: &Path) -> Parsed<(ZipArchive<Buffered>, Budget)> {
    refuse_special(
        path,
        false,
        "a regular file is expected, because an archive is not read from its start to its end",
    )?;
    let budget = Budget::of_file(path.metadata()?.len());
    let archive = ZipArchive::new(open(path, MAGIC)?);
    let archive =
        archive.map_err(|error| Problem::new(format!("not an .npz file, or cut short: {error}")))?;
    refuse_many(archive.len()).map_err(Problem::new)?;
    Ok((archive, budget))
}

/// A table of arrays, of which some are the coordinates: those that `named` names, or those of usual names.
pub(super) fn assemble(members: Vec<Member>, named: &[String], budget: &Budget) -> Parsed<PointTable> {
    if members.is_empty() {
        let problem = "there are no arrays in the archive: members that end in .npy are expected";
        return Err(Problem::new(problem));
    }
    let shapes = members.iter().map(|member| (member.name.as_str(), &member.shape[..]));
    let place = place(shapes, named)?;
    let coordinates = place.as_ref().map_or(&[][..], Place::arrays);
    let points = coordinates.first().and_then(|&at| members[at].shape.first().copied()).unwrap_or(0);
    let arrays = members.into_iter().enumerate();
    let arrays = arrays.map(|(at, member)| member.array(points, coordinates.contains(&at), budget)).collect();
    PointTable::of_arrays(arrays, Rows::points(), named)
}

/// Where the coordinates are among arrays of these names and shapes. One row of numbers is no array of positions unless it is named:
/// it may hold all coordinates of each point on end.
pub(super) fn place<'a>(
    shapes: impl Iterator<Item = (&'a str, &'a [usize])> + Clone,
    named: &[String],
) -> Parsed<Option<Place>> {
    let numbers = |(name, shape): (&'a str, &[usize])| {
        let numbers = match shape {
            [] => 0,
            [_, rest @ ..] => rest.iter().fold(1_usize, |all, &length| all.saturating_mul(length)),
        };
        (without_unit(name), numbers)
    };
    let arrays: Vec<(&str, usize)> = shapes.clone().map(numbers).collect();
    let place = position::find(&arrays, named)?;
    if let (Some(Place::Vector(at)), []) = (&place, named)
        && let Some((name, shape @ [_])) = shapes.clone().nth(*at)
    {
        let problem = format!("`{name}` has the shape {shape:?} where [points, 1 to 3] is expected");
        return Err(Problem::position(problem));
    }
    Ok(place)
}

/// The name of an array in an archive, `None` if the member is none.
pub(super) fn array_name(member: &str) -> Option<String> {
    member.strip_suffix(".npy").map(str::to_owned)
}

/// Reads the array with this number, `None` if the member is no array.
fn member<R: Read + Seek>(
    archive: &mut ZipArchive<R>,
    index: usize,
    budget: &Budget,
) -> Parsed<Option<Member>> {
    let unreadable = |error: String| Problem::new(format!("member {index} of the archive: {error}"));
    let mut file = archive.by_index(index).map_err(|error| unreadable(error.to_string()))?;
    let name = file.name().map_err(|error| unreadable(error.to_string()))?;
    let Some(name) = array_name(&name) else { return Ok(None) };
    let (size, packed) = (file.size(), file.compressed_size());
    let (shape, values) = match array(&mut file, size, packed, budget) {
        Ok((shape, values)) => (shape, values),
        Err(problem) => (Vec::new(), Err(Unusable::numbers(problem))),
    };
    Ok(Some(Member { name, shape, values }))
}

type Content = (Vec<usize>, Result<Vec<f64>, Unusable>);

/// Shape and numbers of a member whose `size` bytes take `packed` bytes in the archive.
fn array(file: &mut impl Read, size: u64, packed: u64, budget: &Budget) -> Result<Content, String> {
    if size / MOST_PACKED > packed {
        return Err(format!("{packed} packed bytes cannot hold the {size} that the archive claims"));
    }
    budget.unpack(usize::try_from(size).unwrap_or(usize::MAX))?;
    let mut bytes = Vec::new();
    // The checksum is compared where the reader meets the end, so one byte more than there should be is asked for.
    file.take(size.saturating_add(1)).read_to_end(&mut bytes).map_err(|error| damaged(&error))?;
    if bytes.len() as u64 != size {
        return Err(format!("{} bytes or more, where the archive claims {size}", bytes.len()));
    }
    let (header, data) = Header::split(&bytes)?;
    let values = match header.stored() {
        Some((stored, endian)) => Ok(header.numbers((stored, endian), data, budget)?),
        None => Err(Unusable::other(header.refusal())),
    };
    Ok((header.shape, values))
}

/// What a failure to unpack says of a member.
pub(super) fn damaged(error: &std::io::Error) -> String {
    format!("the array is damaged or cut short: {}", error.to_string().to_lowercase())
}

impl Member {
    /// The array at `points` points, with a fault if it has not one row for each and is no coordinate.
    fn array(self, points: usize, is_coordinate: bool, budget: &Budget) -> Array {
        let Self { name, shape, values } = self;
        let values = match values {
            Ok(values) => values,
            Err(unusable) => return Array::unusable(name, unusable),
        };
        if is_single(&name, &shape, points) {
            return match budget.numbers(points) {
                Ok(mut all) => {
                    all.resize(points, values[0]);
                    Array::new(name, 1, all)
                }
                Err(problem) => Array::unusable(name, Unusable::numbers(problem)),
            };
        }
        let Some((&rows, rest)) = shape.split_first() else {
            return Array::unusable(name, Unusable::other(unfit(&shape, points)));
        };
        let components = rest.iter().try_fold(1usize, |all, &length| all.checked_mul(length)).unwrap_or(0);
        if components == 0 || rows != points && !is_coordinate {
            return Array::unusable(name, Unusable::other(unfit(&shape, points)));
        }
        if let Err(problem) = refuse_wide(components) {
            return Array::unusable(name, Unusable::numbers(problem));
        }
        Array::new(name, components, values)
    }
}

/// Whether an array is a single mass or density, which is that of all points.
pub(super) fn is_single(name: &str, shape: &[usize], points: usize) -> bool {
    let is_special = MASS.iter().chain(&DENSITY).any(|special| name.eq_ignore_ascii_case(special));
    is_special && shape.first() != Some(&points) && shape.iter().all(|&length| length == 1)
}

/// Says that an array of this shape has not one row a point.
pub(super) fn unfit(shape: &[usize], count: usize) -> String {
    let points = counted(count, "point");
    match shape {
        [] => format!("a single number, where one for each of {points} is expected"),
        _ => format!("shape {shape:?}, where [{count}] or [{count}, n] for {points} is expected"),
    }
}
