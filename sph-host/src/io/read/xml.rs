//! VTK's XML formats: `.vtu` and `.vtp`. The pieces of a file become one table.
//!
//! Source: *VTK File Formats*, docs.vtk.org.

use super::appended::from_base64;
use super::budget::Budget;
use super::join::Joined;
use super::text_numbers::{TextNumbers, required};
use super::xml_arrays::{Content, DataArray, Form, Layout, layout};
use super::{bytes, from_vtk};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, counted};
use crate::io::table::{Array, PointTable, Unusable};
use std::borrow::Cow;

/// Reads unstructured grids and polygonal data.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    parse(&bytes(&file.path)?)
}

/// The table of a file of these bytes.
pub(super) fn parse(bytes: &[u8]) -> Parsed<PointTable> {
    let layout = layout(bytes)?;
    if layout.pieces.is_empty() {
        return Err(Problem::new("there is no Piece, or the file is cut short"));
    }
    let mut points = Vec::new();
    for (index, piece) in layout.pieces.iter().enumerate().filter(|(_, piece)| piece.points > 0) {
        let missing = || Problem::at(format!("piece {index}"), "there are no points where some are claimed");
        let coordinates = piece.coordinates.as_ref().ok_or_else(missing)?;
        let read = required(layout.array("Points", coordinates, piece.points, points.len() / 3))?;
        if read.len() != 3 * piece.points {
            let found = counted(read.len() / piece.points, "coordinate");
            return Err(Problem::at("Points", format!("{found} a point, where 3 are expected")));
        }
        points.extend(read);
    }
    from_vtk(&points, layout.arrays())
}

impl Layout<'_> {
    /// The arrays of all pieces one after the other.
    fn arrays(&self) -> Vec<Array> {
        let mut joined = Joined::default();
        for (index, piece) in self.pieces.iter().enumerate() {
            let first = joined.points();
            let read = |declared: &DataArray<'_>| self.array(&declared.name, declared, piece.points, first);
            joined.add(index, piece.points, piece.arrays.iter().map(read));
        }
        joined.arrays
    }

    /// What `declared` holds at `points` points, of which the first has the number `first`.
    fn array(&self, name: &str, declared: &DataArray<'_>, points: usize, first: usize) -> Array {
        let read = match &declared.form {
            Ok(form) => self.numbers(form, name, points, first),
            Err(unusable) => Err(unusable.clone()),
        };
        read.unwrap_or_else(|unusable| Array::unusable(name, unusable))
    }

    fn numbers(&self, form: &Form<'_>, name: &str, points: usize, first: usize) -> Result<Array, Unusable> {
        let &Form { stored, components, .. } = form;
        if points == 0 {
            return Ok(Array::new(name, components, Vec::new()));
        }
        let sizes = points.checked_mul(components).and_then(|count| Some((count, stored.bytes(count)?)));
        let claim = || Unusable::numbers(format!("{points} points of {components} numbers are claimed"));
        let (count, bytes) = sizes.ok_or_else(claim)?;
        let decoded = |text: &[u8]| {
            self.budget.decode(text.len())?;
            from_base64(text).map(Cow::Owned)
        };
        let data = match &form.content {
            Content::Ascii(text) => {
                return ascii(text.as_bytes(), count, &self.budget)
                    .map(|numbers| numbers.into_array(name.to_owned(), components, first));
            }
            Content::Base64(text) => decoded(text.as_bytes()),
            Content::Appended(offset) => self.appended_at(*offset),
        };
        let data = data.map_err(Unusable::numbers)?;
        self.budget.unpack(bytes).map_err(Unusable::numbers)?;
        let unpacked = self.packing.unpack(&data, bytes).map_err(Unusable::numbers)?;
        let mut values = self.budget.numbers(count).map_err(Unusable::numbers)?;
        stored.decode(&unpacked, self.packing.endian, count, &mut values);
        Ok(Array::new(name, components, values))
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
        let text = &rest[..length.min(rest.len())];
        self.budget.decode(text.len())?;
        from_base64(text).map(Cow::Owned)
    }
}

/// `count` numbers of `text`, which has no more.
fn ascii(text: &[u8], count: usize, budget: &Budget) -> Result<TextNumbers, Unusable> {
    let mut numbers = TextNumbers::new(count);
    for word in text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
        if numbers.is_full() {
            return Err(Unusable::numbers(format!("there are more than {}", counted(count, "number"))));
        }
        numbers.push(word, budget);
    }
    Ok(numbers)
}
