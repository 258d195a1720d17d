//! VTK's XML formats: `.vtu` and `.vtp`. The pieces of a file become one table.
//!
//! Source: *VTK File Formats*, docs.vtk.org.

use super::appended::from_base64;
use super::xml_arrays::{Content, DataArray, Layout, Piece, layout};
use super::{from_vtk, parse_text};
use crate::io::error::{Parsed, Problem};
use crate::io::table::{Array, PointTable};
use std::borrow::Cow;

/// Reads unstructured grids and polygonal data.
pub(super) fn read(bytes: &[u8]) -> Parsed<PointTable> {
    let layout = layout(bytes)?;
    let mut points = Vec::new();
    let mut arrays: Option<Vec<Array>> = None;
    for (index, piece) in layout.pieces.iter().enumerate().filter(|(_, piece)| piece.points > 0) {
        let coordinates = piece.coordinates.as_ref();
        let missing = || Problem::at(format!("piece {index}"), "there are no points where some are claimed");
        let coordinates = coordinates.ok_or_else(missing)?;
        if coordinates.components != 3 {
            let problem = format!("{} coordinates a point, where 3 are expected", coordinates.components);
            return Err(Problem::at("Points", problem));
        }
        layout.numbers("Points", coordinates, piece.points, &mut points)?;
        let arrays = arrays.get_or_insert_with(|| piece.arrays.iter().map(empty).collect());
        append(&layout, piece, index, arrays)?;
    }
    if layout.pieces.is_empty() {
        return Err(Problem::new("there is no Piece, or the file is cut short"));
    }
    let declared = || layout.pieces[0].arrays.iter().map(empty).collect();
    from_vtk(&points, arrays.unwrap_or_else(declared))
}

/// An array like `declared`, without numbers yet.
fn empty(declared: &DataArray<'_>) -> Array {
    match declared.stored {
        Some(_) => Array::new(&declared.name, declared.components, Vec::new()),
        None => Array::unusable(&declared.name, "texts where numbers are expected", false),
    }
}

/// Appends what `piece` says of its points.
fn append(layout: &Layout<'_>, piece: &Piece<'_>, index: usize, arrays: &mut [Array]) -> Parsed<()> {
    if piece.arrays.len() != arrays.len() {
        let problem = format!("{} arrays, where the piece before has {}", piece.arrays.len(), arrays.len());
        return Err(Problem::at(format!("piece {index}"), problem));
    }
    for (array, position) in arrays.iter_mut().zip(0..) {
        let name = format!("array `{}`", array.name);
        // Names are in the same order but for odd files; two of one name are found when the table is assembled.
        let same = |other: &&DataArray<'_>| other.name == array.name;
        let found = piece.arrays.get(position).filter(same).or_else(|| piece.arrays.iter().find(same));
        let found = found.filter(|found| found.stored.is_none() || found.components == array.components);
        let Some(found) = found.filter(|found| found.stored.is_some() == array.fault.is_none()) else {
            let problem = format!("piece {index} has no such array, or one of another shape or type");
            return Err(Problem::at(name, problem));
        };
        if array.fault.is_none() {
            layout.numbers(&name, found, piece.points, &mut array.values)?;
        }
    }
    Ok(())
}

impl Layout<'_> {
    /// Appends the numbers of `array` at `points` points to `out`.
    fn numbers(&self, what: &str, array: &DataArray<'_>, points: usize, out: &mut Vec<f64>) -> Parsed<()> {
        let wrong = |problem: String| Problem::at(what, problem);
        let stored = array.stored.ok_or_else(|| wrong("texts where numbers are expected".to_owned()))?;
        let sizes =
            points.checked_mul(array.components).and_then(|count| Some((count, stored.bytes(count)?)));
        let (count, bytes) = sizes.ok_or_else(|| wrong(format!("{points} points are claimed")))?;
        let data = match &array.content {
            Content::Ascii(text) => return ascii(what, text, count, out),
            Content::Base64(text) => from_base64(text.as_bytes()).map(Cow::Owned),
            Content::Appended(offset) => self.appended_at(*offset),
        };
        let data = data.map_err(wrong)?;
        let unpacked = self.packing.unpack(&data, bytes).map_err(wrong)?;
        stored.decode(&unpacked, self.packing.endian, count, out);
        Ok(())
    }

    /// The appended data from `offset` on; base64 ends where the next array starts.
    fn appended_at(&self, offset: usize) -> Result<Cow<'_, [u8]>, String> {
        let (data, is_base64) =
            self.appended.ok_or("there are no appended data, or the file is cut short")?;
        let next = self.offsets.partition_point(|&other| other <= offset);
        let rest =
            data.get(offset..).ok_or_else(|| format!("offset {offset} of {} appended bytes", data.len()))?;
        if !is_base64 {
            return Ok(Cow::Borrowed(rest));
        }
        let length = self.offsets.get(next).map_or(rest.len(), |next| next - offset);
        from_base64(&rest[..length.min(rest.len())]).map(Cow::Owned)
    }
}

/// Appends `count` numbers of `text`, which has no more.
fn ascii(what: &str, text: &str, count: usize, out: &mut Vec<f64>) -> Parsed<()> {
    // As text a number takes a digit and a blank.
    if count / 2 > text.len() {
        let problem = format!("{count} numbers are claimed, but only {} bytes follow", text.len());
        return Err(Problem::at(what, problem));
    }
    out.reserve(count);
    let mut words = text.as_bytes().split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    parse_text(what, &mut words, count, out)?;
    match words.next() {
        Some(_) => Err(Problem::at(what, format!("more than {count} numbers"))),
        None => Ok(()),
    }
}
