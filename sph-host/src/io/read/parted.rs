//! VTK's files that name pieces: `.pvtu` and `.pvtp`. The pieces, which are files of their own, become one table.
//!
//! A point that several pieces have is there as often. Source: *VTK File Formats*, docs.vtk.org.

use super::budget::Budget;
use super::join::Joined;
use super::xml::parse;
use super::xml_arrays::attribute;
use super::{beside, bytes, refuse_special};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, shown};
use crate::io::rows::Rows;
use crate::io::table::{Array, PointTable};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Reads the pieces that a file names.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    let sources = sources(&bytes(&file.path)?)?;
    if sources.is_empty() {
        return Err(Problem::new("no Piece is named"));
    }
    let folder = file.path.parent().unwrap_or(Path::new(""));
    let (mut coordinates, mut joined) = (vec![Vec::new(); 3], Joined::default());
    // What is kept of all pieces together; of each piece alone, its own budget sees to it.
    let budget = Budget::of_file(0);
    for (index, source) in sources.iter().enumerate() {
        let place = format!("piece {index}, {}", shown(source.as_os_str().as_encoded_bytes()));
        let table = piece(&folder.join(source)).map_err(|problem| within(&place, problem))?;
        let numbers: usize = table.arrays.iter().map(|array| array.values.len()).sum();
        let grown = budget.grow(numbers.saturating_add(3 * table.len()));
        grown.map_err(|problem| Problem::at(&place, problem))?;
        let points = table.len();
        for (all, axis) in coordinates.iter_mut().zip(table.coordinates) {
            all.extend(axis);
        }
        joined.add(index, points, table.arrays.into_iter().map(|array| placed(&place, array)));
    }
    PointTable::assemble(coordinates, joined.arrays, Rows::points())
}

fn piece(path: &Path) -> Parsed<PointTable> {
    refuse_special(path, false, "a regular file is expected")?;
    parse(&bytes(path)?)
}

/// The problem of the piece at `place`.
fn within(place: &str, problem: Problem) -> Problem {
    match problem {
        Problem::Io(error) => Problem::at(place, error.to_string()),
        Problem::NotAFile { found, expected } => Problem::at(place, format!("this is {found}; {expected}")),
        Problem::SeveralSets { sets } => Problem::at(place, format!("several groups hold particles: {sets}")),
        Problem::Position { at, problem } => {
            Problem::at(place, format!("{}{problem}", at.map(|at| format!("{at}: ")).unwrap_or_default()))
        }
        Problem::Invalid { at: Some(at), problem } => Problem::at(format!("{place}, {at}"), problem),
        Problem::Invalid { at: None, problem } => Problem::at(place, problem),
    }
}

/// The array, whose fault is that of the piece at `place`.
fn placed(place: &str, mut array: Array) -> Array {
    if let Some(fault) = &mut array.fault {
        fault.at = format!("{place}, {}", fault.at);
    }
    array
}

/// The paths of the pieces in the order of the file, no two the same.
fn sources(bytes: &[u8]) -> Parsed<Vec<PathBuf>> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| Problem::at(format!("byte {}", error.valid_up_to()), "not UTF-8"))?;
    let mut reader = Reader::from_str(text);
    let (mut sources, mut seen, mut is_vtk) = (Vec::new(), HashSet::new(), false);
    loop {
        let place = format!("byte {}", reader.buffer_position());
        let event = reader.read_event().map_err(|error| Problem::at(&place, format!("not XML: {error}")))?;
        let taken = match &event {
            Event::Start(tag) if !is_vtk => {
                is_vtk = true;
                root(tag)
            }
            Event::Start(tag) | Event::Empty(tag) if is_vtk && tag.name().as_ref() == "Piece" => source(tag)
                .and_then(|source| {
                    if !seen.insert(source.clone()) {
                        return Err(format!(
                            "the piece {} is named twice",
                            shown(source.as_os_str().as_encoded_bytes())
                        ));
                    }
                    sources.push(source);
                    Ok(())
                }),
            Event::End(tag) if tag.name().as_ref() == "VTKFile" => return Ok(sources),
            Event::Eof => Err("cut short: there is no end of `VTKFile`".to_owned()),
            _ => Ok(()),
        };
        taken.map_err(|problem| Problem::at(place, problem))?;
    }
}

/// That the file is one that names pieces.
fn root(tag: &BytesStart<'_>) -> Result<(), String> {
    let kind = attribute(tag, "type")?.unwrap_or_default();
    if tag.name().as_ref() == "VTKFile" && matches!(&*kind, "PUnstructuredGrid" | "PPolyData") {
        return Ok(());
    }
    let found = format!("{} of type {}", shown(tag.name().as_ref().as_bytes()), shown(kind.as_bytes()));
    Err(format!("{found}, where `VTKFile` of type PUnstructuredGrid or PPolyData is expected"))
}

/// The path of a piece.
fn source(tag: &BytesStart<'_>) -> Result<PathBuf, String> {
    let source = attribute(tag, "Source")?.ok_or("a Piece without Source, the path of its file")?;
    beside(&source).map_err(|problem| format!("the piece {problem}"))
}
