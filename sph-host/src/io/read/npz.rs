//! Archives of NumPy arrays: `.npz`.

use super::npy::Header;
use crate::io::error::{Parsed, Problem};
use crate::io::table::{AXES, Array, PointTable, Rows, take_coordinates};
use std::io::{Read, Seek};
use zip::ZipArchive;

/// Deflate packs at most 1032 bytes into one.
const MOST_PACKED: u64 = 1032;

/// An array of an archive, or why it is none.
pub(super) struct Member {
    pub(super) name: String,
    pub(super) shape: Vec<usize>,
    /// Its numbers, or why there are none to use and whether there are numbers at all.
    pub(super) values: Result<Vec<f64>, (String, bool)>,
}

/// Reads an archive with the arrays `x`, `y`, `z`, or `pos` of N×D.
pub(super) fn read(input: impl Read + Seek) -> Parsed<PointTable> {
    let mut archive =
        ZipArchive::new(input).map_err(|error| Problem::new(format!("not an .npz file: {error}")))?;
    let mut members = Vec::new();
    for index in 0..archive.len() {
        members.extend(member(&mut archive, index)?);
    }
    assemble(members)
}

/// A table of arrays.
pub(super) fn assemble(mut members: Vec<Member>) -> Parsed<PointTable> {
    let pos = members.iter().position(|member| member.name.eq_ignore_ascii_case("pos"));
    let mut coordinates = match pos {
        Some(index) => positions(members.remove(index))?,
        None => Vec::new(),
    };
    let points = coordinates.first().map(Vec::len).or_else(|| {
        members.iter().find(|member| member.name.eq_ignore_ascii_case("x"))?.shape.first().copied()
    });
    let names: Vec<String> = members.iter().map(|member| format!("`{}`", member.name)).collect();
    let mut arrays: Vec<Array> =
        members.into_iter().map(|member| member.array(points.unwrap_or(0))).collect();
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

/// Reads the array with this number, `None` if the member is no array.
fn member<R: Read + Seek>(archive: &mut ZipArchive<R>, index: usize) -> Parsed<Option<Member>> {
    let unreadable = |error: String| Problem::new(format!("member {index} of the archive: {error}"));
    let mut file = archive.by_index(index).map_err(|error| unreadable(error.to_string()))?;
    let name = file.name().map_err(|error| unreadable(error.to_string()))?;
    let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else { return Ok(None) };
    let wrong = |problem: String| Problem::at(format!("array `{name}`"), problem);
    let (size, packed) = (file.size(), file.compressed_size());
    if size / MOST_PACKED > packed {
        return Err(wrong(format!("{packed} packed bytes cannot hold the {size} that the archive claims")));
    }
    let mut bytes = Vec::new();
    (&mut file).take(size).read_to_end(&mut bytes).map_err(|error| wrong(error.to_string()))?;
    let (header, data) = Header::split(&bytes).map_err(&wrong)?;
    let values = match header.stored() {
        Some((stored, endian)) => Ok(header.numbers(stored, endian, data).map_err(wrong)?),
        None => Err((format!("values of type {} where numbers are expected", header.descr), false)),
    };
    Ok(Some(Member { name, shape: header.shape, values }))
}

impl Member {
    /// The array at `points` points, with a fault if it has not one row for each.
    fn array(self, points: usize) -> Array {
        let name = self.name;
        match (self.values, self.shape.split_first()) {
            (Err((problem, has_numbers)), _) => Array::unusable(name, problem, has_numbers),
            // A single number says something of the whole, not of the points.
            (Ok(_), None) => Array::unusable(name, "a single number where one a point is expected", false),
            (Ok(values), Some((&rows, rest))) => {
                let components =
                    rest.iter().try_fold(1usize, |all, &length| all.checked_mul(length)).unwrap_or(0);
                if components == 0 || rows != points && !is_axis(&name) {
                    let shape = &self.shape;
                    return Array::unusable(name, format!("shape {shape:?} for {points} points"), true);
                }
                Array::new(name, components, values)
            }
        }
    }
}

/// Whether the lengths of this array are compared with each other later.
pub(super) fn is_axis(name: &str) -> bool {
    AXES.iter().any(|axis| name.eq_ignore_ascii_case(axis))
}

/// The coordinates of `pos`, axis by axis.
fn positions(pos: Member) -> Parsed<Vec<Vec<f64>>> {
    let at = format!("array `{}`", pos.name);
    let values = pos.values.map_err(|(problem, _)| Problem::at(&at, problem))?;
    match pos.shape[..] {
        [_, axes @ 1..=3] => {
            let axis = |axis: usize| values.iter().skip(axis).step_by(axes).copied().collect();
            Ok((0..axes).map(axis).collect())
        }
        _ => Err(Problem::at(at, format!("shape {:?} where [points, 1 to 3] is expected", pos.shape))),
    }
}
