//! Archives of NumPy arrays: `.npz`.

use super::budget::{Budget, MOST_PACKED, refuse_many, refuse_wide};
use super::npy::Header;
use super::{open, refuse_special};
use crate::io::error::{Parsed, Problem, counted};
use crate::io::table::{
    Array, DENSITY, MASS, PointTable, Rows, Unusable, fill_empty_names, is_axis, take_coordinates,
};
use std::fs::File;
use std::io::{BufReader, Read, Seek};
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
pub(super) fn read(path: &Path) -> Parsed<PointTable> {
    let (mut archive, budget) = open_archive(path)?;
    let mut members = Vec::new();
    for index in 0..archive.len() {
        members.extend(member(&mut archive, index, &budget)?);
    }
    fill_empty_names(members.iter_mut().map(|member| &mut member.name).collect());
    assemble(members, &budget)
}

/// Opens the archive, which has to be a regular file, with the budget of its size.
pub(super) fn open_archive(path: &Path) -> Parsed<(ZipArchive<BufReader<File>>, Budget)> {
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

/// A table of arrays.
pub(super) fn assemble(mut members: Vec<Member>, budget: &Budget) -> Parsed<PointTable> {
    if members.is_empty() {
        let problem = "there are no arrays in the archive: members that end in .npy are expected";
        return Err(Problem::new(problem));
    }
    let has_x = members.iter().any(|member| member.is("x"));
    // Beside `x`, a `pos` of another shape is an array like any other.
    let pos = members.iter().position(|member| member.is("pos") && !(has_x && member.axes().is_none()));
    let mut coordinates = match pos {
        Some(index) => positions(members.remove(index))?,
        None => Vec::new(),
    };
    let points = coordinates.first().map(Vec::len);
    let points = points.or_else(|| members.iter().find(|member| member.is("x"))?.shape.first().copied());
    let names: Vec<String> = members.iter().map(|member| format!("`{}`", member.name)).collect();
    let mut arrays: Vec<Array> =
        members.into_iter().map(|member| member.array(points.unwrap_or(0), budget)).collect();
    let axes = take_coordinates(&mut arrays)?;
    match (coordinates.is_empty(), axes.is_empty()) {
        (false, false) => return Err(Problem::new("there is both `pos` and `x`: one of them is expected")),
        (true, true) => {
            let problem = format!("no array is called `x` or `pos`; there are {}", names.join(", "));
            return Err(Problem::new(problem));
        }
        (true, false) => coordinates = axes,
        (false, true) => {}
    }
    PointTable::assemble(coordinates, arrays, Rows::Points)
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
    fn is(&self, name: &str) -> bool {
        self.name.eq_ignore_ascii_case(name)
    }

    /// How many coordinates a point has, if the shape is that of positions.
    fn axes(&self) -> Option<usize> {
        match self.shape[..] {
            [_, axes @ 1..=3] => Some(axes),
            _ => None,
        }
    }

    /// The array at `points` points, with a fault if it has not one row for each.
    fn array(self, points: usize, budget: &Budget) -> Array {
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
        if components == 0 || rows != points && !is_axis(&name) {
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

/// The coordinates of `pos`, axis by axis.
fn positions(pos: Member) -> Parsed<Vec<Vec<f64>>> {
    let at = format!("array `{}`", pos.name);
    let axes = pos.axes();
    let values = pos.values.map_err(|unusable| Problem::at(&at, unusable.problem))?;
    let axes = axes.ok_or_else(|| {
        Problem::at(at, format!("shape {:?} where [points, 1 to 3] is expected", pos.shape))
    })?;
    let axis = |axis: usize| values.iter().skip(axis).step_by(axes).copied().collect();
    Ok((0..axes).map(axis).collect())
}
