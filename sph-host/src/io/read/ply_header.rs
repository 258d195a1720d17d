//! The header of a PLY file: its coding and elements with their properties.

use super::budget::refuse_many;
use super::text_columns::{Lines, words};
use crate::io::error::{Parsed, shown};
use crate::io::numbers::{Endian, Stored};

/// What the header says.
pub(super) struct Header {
    pub coding: Coding,
    pub elements: Vec<Element>,
}

/// How the data are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Coding {
    Text,
    Binary(Endian),
}

/// A kind of things, of which there are `count` with the same properties.
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    /// The line that declares it.
    pub line: usize,
    pub properties: Vec<Property>,
}

pub(super) struct Property {
    pub name: String,
    pub form: Form,
}

/// How one property of one thing is stored.
#[derive(Debug, Clone, Copy)]
pub(super) enum Form {
    Number(Stored),
    /// A count, and so many items.
    List(Stored, Stored),
}

impl Header {
    /// Reads the header; `lines` then stand at the data.
    pub(super) fn read(lines: &mut Lines<'_>) -> Parsed<Self> {
        let first = lines.advance().unwrap_or_default();
        if first != b"ply" {
            return Err(lines.problem(format!("{} where `ply` is expected", shown(first))));
        }
        let (mut coding, mut elements) = (None, Vec::new());
        loop {
            let Some(line) = lines.advance() else {
                return Err(lines.problem("the header ends without `end_header`"));
            };
            match read_line(line, lines.number(), &mut coding, &mut elements) {
                Ok(Place::Within) => {}
                Ok(Place::End) => break,
                Err(problem) => return Err(lines.problem(problem)),
            }
        }
        let coding = coding.ok_or_else(|| lines.problem("the header has no line `format`"))?;
        Ok(Self { coding, elements })
    }
}

/// Where in the header a line is.
enum Place {
    Within,
    End,
}

/// Reads one line of the header, which is the line `number` of the file.
fn read_line(
    line: &[u8],
    number: usize,
    coding: &mut Option<Coding>,
    elements: &mut Vec<Element>,
) -> Result<Place, String> {
    let wrong = |expected: &str| Err(format!("{} where {expected} is expected", shown(line)));
    // Only names of comments may be no UTF-8.
    let texts: Vec<&str> = words(line).map_while(|word| std::str::from_utf8(word).ok()).take(6).collect();
    match texts[..] {
        ["end_header"] => return Ok(Place::End),
        ["comment" | "obj_info", ..] => {}
        ["format", name, "1.0"] => match format(name) {
            Some(found) if coding.is_none() => *coding = Some(found),
            Some(_) => return Err("a second line `format`".to_owned()),
            None => return wrong("`format` with ascii, binary_little_endian or binary_big_endian"),
        },
        ["element", name, count] => {
            let Ok(count) = count.parse() else { return wrong("`element`, a name and a count") };
            elements.push(Element { name: name.to_owned(), count, line: number, properties: Vec::new() });
            refuse_many(elements.len())?;
        }
        ["property", ref declaration @ ..] => {
            let Some(element) = elements.last_mut() else {
                return Err("a property before the first element".to_owned());
            };
            let Some(property) = property(declaration) else {
                return wrong("`property`, a type of numbers and a name");
            };
            element.properties.push(property);
            refuse_many(element.properties.len())?;
        }
        _ => return wrong("a line of a PLY header (`format` of version 1.0, `element`, `property`)"),
    }
    Ok(Place::Within)
}

fn format(name: &str) -> Option<Coding> {
    match name {
        "ascii" => Some(Coding::Text),
        "binary_little_endian" => Some(Coding::Binary(Endian::Little)),
        "binary_big_endian" => Some(Coding::Binary(Endian::Big)),
        _ => None,
    }
}

/// The property that the words behind `property` declare.
fn property(declaration: &[&str]) -> Option<Property> {
    let (form, name) = match *declaration {
        ["list", count, item, name] => {
            let count = stored(count).filter(|count| !matches!(count, Stored::F32 | Stored::F64))?;
            (Form::List(count, stored(item)?), name)
        }
        [number, name] => (Form::Number(stored(number)?), name),
        _ => return None,
    };
    Some(Property { name: name.to_owned(), form })
}

/// The type of numbers by either of its names.
fn stored(name: &str) -> Option<Stored> {
    Some(match name {
        "char" | "int8" => Stored::I8,
        "uchar" | "uint8" => Stored::U8,
        "short" | "int16" => Stored::I16,
        "ushort" | "uint16" => Stored::U16,
        "int" | "int32" => Stored::I32,
        "uint" | "uint32" => Stored::U32,
        "float" | "float32" => Stored::F32,
        "double" | "float64" => Stored::F64,
        _ => return None,
    })
}

impl Element {
    /// The bytes of one thing, `None` where lists make them differ.
    pub(super) fn length(&self) -> Option<usize> {
        self.properties.iter().try_fold(0_usize, |length, property| match property.form {
            Form::Number(stored) => length.checked_add(stored.bytes(1)?),
            Form::List(..) => None,
        })
    }
}
