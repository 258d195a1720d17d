//! A single array of NumPy: `.npy`, of records with named fields or of positions.
//!
//! `descr` of records is a list of fields, one after the other: a name, or a title and a name; a type, or the list of a record
//! within the record; and the shape, if the field has one. Fields without a name are padding. Source: NumPy's NEP 1.

use super::budget::{Budget, refuse_many};
use super::fields::{Field, columns};
use super::literal::Literal;
use super::npy::{Header, stored};
use super::npz::{Member, assemble};
use super::open;
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, counted};
use crate::io::names::{AXES, check_names};
use crate::io::table::{PointTable, Unusable};
use std::io::Read;

/// The first bytes of every array.
const MAGIC: &[u8] = b"\x93NUMPY";

/// Reads records with the fields `x`, `y`, `z`, or `pos`, or positions alone.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    let mut bytes = Vec::new();
    open(&file.path, MAGIC)?.read_to_end(&mut bytes)?;
    let (header, data) = Header::split(&bytes).map_err(Problem::new)?;
    let budget = Budget::of_file(bytes.len() as u64);
    let members = match &header.fields {
        Some(fields) => records(&header, fields, data, &budget),
        None => positions(header, data, &budget),
    };
    assemble(members.map_err(Problem::new)?, &file.position, &budget)
}

/// The positions of an array without fields.
fn positions(header: Header, data: &[u8], budget: &Budget) -> Result<Vec<Member>, String> {
    let form = header.stored().ok_or_else(|| header.refusal())?;
    let &[count, axes @ 1..=3] = &header.shape[..] else {
        return Err(format!(
            "shape {:?}, where positions of shape [points, 1 to 3], or records with fields, are expected",
            header.shape
        ));
    };
    let (size, length) = (form.0.bytes(1).unwrap_or(0), form.0.bytes(axes).unwrap_or(0));
    if header.fortran_order || count.checked_mul(length) != Some(data.len()) {
        let values = header.numbers(form, data, budget)?;
        return Ok(vec![Member { name: "pos".to_owned(), shape: header.shape, values: Ok(values) }]);
    }
    // Positions point by point are records of their axes.
    let axis = |(axis, name): (usize, &&str)| Field {
        name: (*name).to_owned(),
        offset: axis * size,
        components: 1,
        form: Ok(form),
    };
    let fields: Vec<Field> = AXES[..axes].iter().enumerate().map(axis).collect();
    let columns = columns(data, length, &fields, budget);
    let member = |(field, values): (Field, _)| Member { name: field.name, shape: vec![count], values };
    Ok(fields.into_iter().zip(columns).map(member).collect())
}

/// The fields of records as arrays.
fn records(header: &Header, fields: &Literal, data: &[u8], budget: &Budget) -> Result<Vec<Member>, String> {
    let &[count] = &header.shape[..] else {
        return Err(format!("records of shape {:?}, where [points] is expected", header.shape));
    };
    let record = Record::of(fields).ok_or("the header has fields that are not those of NumPy")?;
    if record.fields.is_empty() {
        return Err("the records have no fields with a name".to_owned());
    }
    if record.length == 0 || count.checked_mul(record.length) != Some(data.len()) {
        let (bytes, each) = (counted(data.len(), "byte"), counted(record.length, "byte"));
        return Err(format!("{bytes} for {} of {each}", counted(count, "record")));
    }
    refuse_many(record.fields.len())?;
    check_names(record.fields.iter().map(|field| &*field.name))?;
    let columns = columns(data, record.length, &record.fields, budget);
    let members = record.fields.into_iter().zip(record.shapes).zip(columns);
    Ok(members
        .map(|((field, shape), values)| Member {
            name: field.name,
            shape: [&[count], &shape[..]].concat(),
            values,
        })
        .collect())
}

/// What one record holds.
#[derive(Default)]
struct Record {
    fields: Vec<Field>,
    /// The shape of each field.
    shapes: Vec<Vec<usize>>,
    /// Bytes, padding among them.
    length: usize,
}

impl Record {
    /// The record of these fields; `None` if they are not of NumPy, or too long.
    fn of(fields: &Literal) -> Option<Self> {
        let Literal::Sequence(fields) = fields else { return None };
        let mut record = Self::default();
        for field in fields {
            record.push(field)?;
        }
        Some(record)
    }

    fn push(&mut self, field: &Literal) -> Option<()> {
        let Literal::Sequence(parts) = field else { return None };
        let (name, kind, shape) = match &parts[..] {
            [name, kind] => (name, kind, Vec::new()),
            [name, kind, shape] => (name, kind, shape.numbers()?),
            _ => return None,
        };
        let name = match name {
            Literal::Text(name) => name,
            Literal::Sequence(names) => match &names[..] {
                [_title, Literal::Text(name)] => name,
                _ => return None,
            },
            _ => return None,
        };
        let (size, form) = match kind {
            Literal::Text(kind) => {
                let refused = || Unusable::other(format!("values of type {kind} where numbers are expected"));
                (size(kind)?, stored(kind).ok_or_else(refused))
            }
            within => (Self::of(within)?.length, Err(Unusable::other("records where numbers are expected"))),
        };
        let components = shape.iter().try_fold(1_usize, |all, &length| all.checked_mul(length))?;
        let offset = self.length;
        self.length = offset.checked_add(size.checked_mul(components)?)?;
        if !name.is_empty() {
            self.fields.push(Field { name: name.clone(), offset, components, form });
            self.shapes.push(shape);
        }
        Some(())
    }
}

/// The bytes of one value of this type.
fn size(kind: &str) -> Option<usize> {
    let kind = kind.strip_prefix(['<', '>', '|', '=']).unwrap_or(kind);
    // Times have their unit behind: M8[ns].
    let (kind, _) = kind.split_once('[').unwrap_or((kind, ""));
    let letter = kind.chars().next()?;
    let size = kind.get(letter.len_utf8()..)?.parse::<usize>().ok()?;
    match letter {
        'b' | 'i' | 'u' | 'f' | 'c' | 'm' | 'M' | 'S' | 'a' | 'V' => Some(size),
        'U' => size.checked_mul(4),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_types() {
        for (kind, bytes) in
            [("<f8", 8), ("|b1", 1), (">U3", 12), ("|S0", 0), ("<M8[ns]", 8), ("|V7", 7), ("<c16", 16)]
        {
            assert_eq!(size(kind), Some(bytes), "{kind}");
        }
        for kind in ["", "<", "<f", "|O", "<é8", "<U9223372036854775807", "<f-8"] {
            assert_eq!(size(kind), None, "{kind}");
        }
    }
}
