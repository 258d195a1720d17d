//! Houdini's classic binary geometry: `.bgeo` of version 5, as Partio and programs that use it write particles.
//!
//! All numbers are big-endian. `Bgeo`, `V`, then nine integers: the version, the numbers of points, primitives, groups of
//! points and of primitives, and of attributes of points, vertices, primitives and of the whole. Then the attributes of
//! points: a name behind its length, how many values, their type, and their defaults (of indices: their texts). Then the
//! points: x, y, z, w as `float`, and the values of each attribute. What follows is not of the points and is not looked at.
//!
//! Source: the reader and writer of Partio, github.com/wdas/partio.

use super::budget::{Budget, refuse_many, refuse_wide};
use super::bytes;
use super::fields::{Field, columns};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, counted, shown};
use crate::io::names::fill_empty_names;
use crate::io::numbers::{Endian, Stored};
use crate::io::rows::Rows;
use crate::io::table::{Array, PointTable, Unusable};

/// The only version that is read.
const VERSION: u32 = 5;

/// How an attribute is stored: the numbers that stand for its type.
const FLOAT: u32 = 0;
const INTEGER: u32 = 1;
const INDEX: u32 = 4;
const VECTOR: u32 = 5;

/// Bytes of one value of any type.
const VALUE: usize = 4;

/// Reads the points of a file.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    parse(&bytes(&file.path)?)
}

fn parse(bytes: &[u8]) -> Parsed<PointTable> {
    let mut input = Input { bytes, rest: bytes };
    let (points, attributes) = input.header()?;
    let mut fields: Vec<Field> = ["x", "y", "z"].iter().map(|axis| field(axis, 1, real())).collect();
    fields.push(field("w", 1, Err(Unusable::other("a weight"))));
    for index in 0..attributes {
        let place = format!("attribute {index}, byte {}", input.at());
        fields.push(input.attribute().map_err(|problem| Problem::at(place, problem))?);
        refuse_many(fields.len()).map_err(Problem::new)?;
    }
    let mut length = 0_usize;
    for field in &mut fields {
        field.offset = length;
        length = length.saturating_add(VALUE.saturating_mul(field.components));
    }
    let place = format!("byte {}", input.at());
    let claimed = points.checked_mul(length);
    let records = claimed.and_then(|claimed| input.rest.get(..claimed)).ok_or_else(|| {
        let (each, left) = (counted(length, "byte"), counted(input.rest.len(), "byte"));
        Problem::at(
            place,
            format!("the header claims {} of {each}, but only {left} follow", counted(points, "point")),
        )
    })?;
    table(records, length, fields, &Budget::of_file(bytes.len() as u64))
}

/// A field that has no place yet.
fn field(name: &str, components: usize, form: Result<(Stored, Endian), Unusable>) -> Field {
    Field { name: name.to_owned(), offset: 0, components, form }
}

fn real() -> Result<(Stored, Endian), Unusable> {
    Ok((Stored::F32, Endian::Big))
}

/// The table of the points in `records`: of the first four fields, three are the coordinates.
fn table(records: &[u8], length: usize, fields: Vec<Field>, budget: &Budget) -> Parsed<PointTable> {
    let mut columns = columns(records, length, &fields, budget).into_iter().zip(fields);
    let mut coordinates = Vec::new();
    for (values, _) in columns.by_ref().take(3) {
        coordinates.push(values.map_err(|unusable| Problem::new(unusable.problem))?);
    }
    let array = |(values, field): (Result<Vec<f64>, Unusable>, Field)| match values {
        Ok(values) => Array::new(field.name, field.components, values),
        Err(unusable) => Array::unusable(field.name, unusable),
    };
    let mut arrays: Vec<Array> = columns.skip(1).map(array).collect();
    fill_empty_names(arrays.iter_mut().map(|array| &mut array.name).collect());
    PointTable::assemble(coordinates, arrays, Rows::points())
}

/// What is still to be read of a file.
struct Input<'a> {
    bytes: &'a [u8],
    rest: &'a [u8],
}

impl<'a> Input<'a> {
    /// Where reading stands, in bytes from the start of the file.
    fn at(&self) -> usize {
        self.bytes.len() - self.rest.len()
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (bytes, rest) = self.rest.split_at_checked(count).ok_or("the file ends here")?;
        self.rest = rest;
        Ok(bytes)
    }

    /// An unsigned integer of `width` bytes.
    fn integer(&mut self, width: usize) -> Result<u32, String> {
        Ok(self.take(width)?.iter().fold(0, |all, &byte| all << 8 | u32::from(byte)))
    }

    /// The numbers of points and of their attributes.
    fn header(&mut self) -> Parsed<(usize, usize)> {
        if !self.bytes.starts_with(b"BgeoV") {
            let newer = self.bytes.starts_with(b"\x7fNSJ") || self.bytes.trim_ascii_start().starts_with(b"[");
            let found = if newer {
                "Houdini's newer geometry".to_owned()
            } else {
                shown(&self.bytes[..self.bytes.len().min(5)])
            };
            let problem = format!(
                "{found} where the classic geometry of version {VERSION} is expected, which starts with `BgeoV`"
            );
            return Err(Problem::new(problem));
        }
        let mut numbers = [0_u32; 9];
        self.rest = &self.bytes[5..];
        for number in &mut numbers {
            *number = self.integer(4).map_err(|problem| Problem::at("header", problem))?;
        }
        let [version, points, _, _, _, attributes, ..] = numbers;
        if version != VERSION {
            return Err(Problem::at("header", format!("version {version} where {VERSION} is expected")));
        }
        Ok((points as usize, attributes as usize))
    }

    /// The declaration of an attribute.
    fn attribute(&mut self) -> Result<Field, String> {
        let name = self.text()?;
        let name = std::str::from_utf8(name).map_err(|_| format!("the name {} is not UTF-8", shown(name)))?;
        let components = self.integer(2)? as usize;
        let kind = self.integer(4)?;
        let form = match kind {
            FLOAT | VECTOR => real(),
            INTEGER => Ok((Stored::I32, Endian::Big)),
            INDEX => Err(Unusable::other("texts where numbers are expected")),
            other => {
                let expected = "0 (float), 1 (integer), 4 (index of a text) or 5 (vector)";
                return Err(format!(
                    "{} has the type {other} where {expected} is expected",
                    shown(name.as_bytes())
                ));
            }
        };
        if kind == INDEX {
            for _ in 0..self.integer(4)? {
                self.text()?;
            }
        } else {
            self.take(VALUE * components)?;
        }
        if components == 0 {
            return Err(format!(
                "{} has no numbers a point, where one or more are expected",
                shown(name.as_bytes())
            ));
        }
        refuse_wide(components).map_err(|problem| format!("{} has {problem}", shown(name.as_bytes())))?;
        Ok(field(name, components, form))
    }

    /// A text behind its length.
    fn text(&mut self) -> Result<&'a [u8], String> {
        let length = self.integer(2)? as usize;
        self.take(length)
    }
}
