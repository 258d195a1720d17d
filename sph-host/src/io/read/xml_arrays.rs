//! The elements of a VTK XML file that hold points: pieces and their arrays, not yet unpacked.

use super::appended::Packing;
use super::budget::{Budget, refuse_many, refuse_wide};
use super::packer::Packer;
use crate::io::error::{Parsed, Problem, shown};
use crate::io::names::fill_empty_names;
use crate::io::numbers::{Endian, Stored};
use crate::io::table::Unusable;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::borrow::Cow;

/// The file up to its appended data.
pub(super) struct Layout<'a> {
    pub packing: Packing,
    pub pieces: Vec<Piece<'a>>,
    /// The appended bytes behind the underscore, and whether they are base64.
    pub appended: Option<(&'a [u8], bool)>,
    /// Where arrays start in the appended data, those of cells too, in order.
    pub offsets: Vec<usize>,
    pub budget: Budget,
}

/// One piece: its number of points, their coordinates and arrays.
#[derive(Default)]
pub(super) struct Piece<'a> {
    pub points: usize,
    pub coordinates: Option<DataArray<'a>>,
    pub arrays: Vec<DataArray<'a>>,
}

/// A `DataArray` element.
pub(super) struct DataArray<'a> {
    /// The name; one is made up where there is none.
    pub name: String,
    pub form: Result<Form<'a>, Unusable>,
}

/// How the numbers of an array are stored, and where.
pub(super) struct Form<'a> {
    pub stored: Stored,
    pub components: usize,
    pub content: Content<'a>,
}

/// Where the numbers of an array are.
pub(super) enum Content<'a> {
    Ascii(Cow<'a, str>),
    Base64(Cow<'a, str>),
    Appended(usize),
}

/// The element that the parser is in.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    Other,
    Points,
    PointData,
}

struct Parser<'a> {
    layout: Layout<'a>,
    section: Section,
    /// The array that is open, and how deep within it the parser is.
    open: Option<(DataArray<'a>, usize)>,
}

/// Reads the elements of `bytes`, which is UTF-8 up to the appended data.
pub(super) fn layout(bytes: &[u8]) -> Parsed<Layout<'_>> {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => std::str::from_utf8(&bytes[..error.valid_up_to()]).unwrap_or_default(),
    };
    let mut reader = Reader::from_str(text);
    let packing = Packing { endian: Endian::Little, wide: false, packer: None };
    let budget = Budget::of_file(bytes.len() as u64);
    let layout = Layout { packing, pieces: Vec::new(), appended: None, offsets: Vec::new(), budget };
    let mut parser = Parser { layout, section: Section::Other, open: None };
    let mut is_vtk = false;
    loop {
        let place = format!("byte {}", reader.buffer_position());
        let event = reader.read_event().map_err(|error| Problem::at(&place, format!("not XML: {error}")))?;
        match event {
            Event::Start(tag) if tag.name().as_ref() == "AppendedData" => {
                let end = reader.buffer_position() as usize;
                parser.appended(&tag, &bytes[end..]).map_err(|problem| Problem::at(&place, problem))?;
                break;
            }
            Event::Start(tag) if !is_vtk => {
                parser.root(&tag).map_err(|problem| Problem::at(place, problem))?;
                is_vtk = true;
            }
            Event::Start(tag) => parser.start(&tag).map_err(|problem| Problem::at(place, problem))?,
            Event::Empty(tag) => {
                parser.start(&tag).map_err(|problem| Problem::at(place, problem))?;
                parser.end(tag.name().as_ref());
            }
            Event::End(tag) => {
                parser.end(tag.name().as_ref());
                if tag.name().as_ref() == "VTKFile" {
                    break;
                }
            }
            Event::Text(text) => parser.text(text.into_inner()),
            Event::Eof => return Err(Problem::at(place, "cut short, or not UTF-8 from here on")),
            _ => {}
        }
    }
    parser.layout.offsets.sort_unstable();
    for (index, piece) in parser.layout.pieces.iter_mut().enumerate() {
        let place = || format!("piece {index}");
        refuse_many(piece.arrays.len()).map_err(|problem| Problem::at(place(), problem))?;
        fill_empty_names(piece.arrays.iter_mut().map(|array| &mut array.name).collect());
    }
    Ok(parser.layout)
}

/// The attribute called `name`.
pub(in crate::io) fn attribute<'a>(
    tag: &'a BytesStart<'_>,
    name: &str,
) -> Result<Option<Cow<'a, str>>, String> {
    let attribute = tag.try_get_attribute(name).map_err(|error| format!("attribute {name}: {error}"))?;
    let value = attribute.map(|attribute| attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0));
    value.transpose().map_err(|error| format!("attribute {name}: {error}"))
}

/// The count in the attribute called `name`, `default` without it.
fn count(tag: &BytesStart<'_>, name: &str, default: Option<usize>) -> Result<usize, String> {
    let value = attribute(tag, name)?;
    let count = value.as_ref().map_or(default, |value| value.trim().parse().ok());
    count.ok_or_else(|| {
        let value = value.unwrap_or_default();
        format!("{} where the count {name} is expected", shown(value.as_bytes()))
    })
}

impl<'a> Parser<'a> {
    fn root(&mut self, tag: &BytesStart<'_>) -> Result<(), String> {
        let kind = attribute(tag, "type")?.unwrap_or_default();
        if tag.name().as_ref() != "VTKFile" || !matches!(&*kind, "UnstructuredGrid" | "PolyData") {
            let found =
                format!("{} of type {}", shown(tag.name().as_ref().as_bytes()), shown(kind.as_bytes()));
            return Err(format!("{found}, where `VTKFile` of type UnstructuredGrid or PolyData is expected"));
        }
        let packing = &mut self.layout.packing;
        packing.endian = match attribute(tag, "byte_order")?.as_deref() {
            None | Some("LittleEndian") => Endian::Little,
            Some("BigEndian") => Endian::Big,
            Some(other) => return Err(format!("byte_order {} is unknown", shown(other.as_bytes()))),
        };
        packing.wide = match attribute(tag, "header_type")?.as_deref() {
            None | Some("UInt32") => false,
            Some("UInt64") => true,
            Some(other) => return Err(format!("header_type {} is unknown", shown(other.as_bytes()))),
        };
        packing.packer = match attribute(tag, "compressor")?.as_deref() {
            None | Some("") => None,
            Some(name) => Some(Packer::named(name).ok_or_else(|| {
                format!("compressor {} where {} is expected", shown(name.as_bytes()), Packer::NAMES)
            })?),
        };
        Ok(())
    }

    fn start(&mut self, tag: &BytesStart<'_>) -> Result<(), String> {
        if let Some((_, depth)) = &mut self.open {
            *depth += 1;
            return Ok(());
        }
        match tag.name().as_ref() {
            "Piece" => {
                let points = count(tag, "NumberOfPoints", None)?;
                self.layout.pieces.push(Piece { points, ..Piece::default() });
            }
            "Points" => self.section = Section::Points,
            "PointData" => self.section = Section::PointData,
            "DataArray" | "Array" => {
                let array = data_array(tag)?;
                self.layout.offsets.extend(match array.form {
                    Ok(Form { content: Content::Appended(offset), .. }) => Some(offset),
                    _ => None,
                });
                self.open = Some((array, 0));
            }
            _ => {}
        }
        Ok(())
    }

    fn end(&mut self, name: &str) {
        match self.open.take() {
            Some((array, 0)) => self.keep(array),
            Some((array, depth)) => self.open = Some((array, depth - 1)),
            None if matches!(name, "Points" | "PointData") => self.section = Section::Other,
            None => {}
        }
    }

    fn keep(&mut self, array: DataArray<'a>) {
        let Some(piece) = self.layout.pieces.last_mut() else { return };
        match self.section {
            Section::Points => piece.coordinates = Some(array),
            Section::PointData => piece.arrays.push(array),
            Section::Other => {}
        }
    }

    /// Text of the open array itself, not of elements within it.
    fn text(&mut self, text: Cow<'a, str>) {
        let Some((DataArray { form: Ok(form), .. }, 0)) = &mut self.open else { return };
        if let Content::Ascii(content) | Content::Base64(content) = &mut form.content {
            // Text that is blank is passed over, so what is kept is empty or no blank: neither is looked through again.
            if text.trim_ascii().is_empty() {
                return;
            }
            if content.is_empty() {
                *content = text;
            } else {
                content.to_mut().push_str(&text);
            }
        }
    }

    fn appended(&mut self, tag: &BytesStart<'_>, rest: &'a [u8]) -> Result<(), String> {
        let base64 = match attribute(tag, "encoding")?.as_deref() {
            Some("base64") => true,
            Some("raw") => false,
            other => {
                let other = other.unwrap_or_default();
                return Err(format!("encoding {} where base64 or raw is expected", shown(other.as_bytes())));
            }
        };
        let data =
            rest.trim_ascii_start().strip_prefix(b"_").ok_or("appended data start with an underscore")?;
        let end = if base64 { memchr::memchr(b'<', data).unwrap_or(data.len()) } else { data.len() };
        self.layout.appended = Some((&data[..end], base64));
        Ok(())
    }
}

fn data_array<'a>(tag: &BytesStart<'_>) -> Result<DataArray<'a>, String> {
    let name = attribute(tag, "Name")?.unwrap_or_default().into_owned();
    let form = match &*attribute(tag, "type")?.unwrap_or_default() {
        "String" => Err(Unusable::other("texts where numbers are expected")),
        kind => form(tag, kind).map_err(Unusable::numbers),
    };
    Ok(DataArray { name, form })
}

fn form<'a>(tag: &BytesStart<'_>, kind: &str) -> Result<Form<'a>, String> {
    let stored = match kind {
        "Int8" => Stored::I8,
        "UInt8" => Stored::U8,
        "Int16" => Stored::I16,
        "UInt16" => Stored::U16,
        "Int32" => Stored::I32,
        "UInt32" => Stored::U32,
        "Int64" => Stored::I64,
        "UInt64" => Stored::U64,
        "Float32" => Stored::F32,
        "Float64" => Stored::F64,
        "Bit" => Stored::Bit,
        other => return Err(format!("the type {} is unknown", shown(other.as_bytes()))),
    };
    let content = match attribute(tag, "format")?.as_deref() {
        None | Some("ascii") => Content::Ascii(Cow::Borrowed("")),
        Some("binary") => Content::Base64(Cow::Borrowed("")),
        Some("appended") => Content::Appended(count(tag, "offset", None)?),
        Some(other) => return Err(format!("the format {} is unknown", shown(other.as_bytes()))),
    };
    let components = count(tag, "NumberOfComponents", Some(1))?;
    if components == 0 {
        return Err("no numbers a point, where one or more are expected".to_owned());
    }
    refuse_wide(components)?;
    Ok(Form { stored, components, content })
}
