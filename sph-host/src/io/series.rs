//! Series in time: ParaView's `.pvd`, which names a file for each moment.

use super::error::{Problem, ReadError, shown};
use super::read::beside;
use super::read::xml_arrays::attribute;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::path::{Path, PathBuf};

/// A file of a series, and its time.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The time; where the series says none, the number in the series.
    pub time: f64,
    /// The file.
    pub path: PathBuf,
}

/// Whether a path has the ending of a series.
pub fn is_series(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pvd"))
}

/// Reads the files that a series names, in its order.
///
/// # Errors
/// The file cannot be read, is no `.pvd`, names nothing, or names a file that is not below its own folder.
pub fn read_series(path: &Path) -> Result<Vec<Moment>, ReadError> {
    let file = path.display().to_string();
    let text = super::read::text(path).and_then(|text| moments(&text));
    let folder = path.parent().unwrap_or(Path::new(""));
    let joined = |moment: Moment| Moment { path: folder.join(moment.path), ..moment };
    match text {
        Ok(moments) => Ok(moments.into_iter().map(joined).collect()),
        Err(problem) => Err(problem.in_file(&file)),
    }
}

fn moments(text: &str) -> Result<Vec<Moment>, Problem> {
    let mut reader = Reader::from_str(text);
    let (mut moments, mut is_collection) = (Vec::new(), false);
    loop {
        let place = format!("byte {}", reader.buffer_position());
        let event = reader.read_event().map_err(|error| Problem::at(&place, format!("not XML: {error}")))?;
        match event {
            Event::Start(tag) | Event::Empty(tag) => match tag.name().as_ref() {
                "Collection" => is_collection = true,
                "DataSet" if is_collection => {
                    moments.push(moment(&tag, moments.len()).map_err(|problem| Problem::at(place, problem))?);
                }
                _ => {}
            },
            Event::Eof => break,
            _ => {}
        }
    }
    let again =
        (1..moments.len()).find(|&at| moments[..at].iter().any(|one: &Moment| one.time == moments[at].time));
    if let Some(at) = again {
        let Moment { time, path } = &moments[at];
        let path = shown(path.as_os_str().as_encoded_bytes());
        return Err(Problem::new(format!(
            "{path} is the second file at the time {time}: parts of one moment are not joined, but a .pvtu names such"
        )));
    }
    match (is_collection, moments.is_empty()) {
        (false, _) => Err(Problem::new("there is no Collection in it, as a .pvd has")),
        (true, true) => Err(Problem::new("the Collection names no file")),
        (true, false) => Ok(moments),
    }
}

fn moment(tag: &BytesStart<'_>, number: usize) -> Result<Moment, String> {
    let name = attribute(tag, "file")?.ok_or("a DataSet names no file")?;
    let path = beside(&name)?;
    let time = match attribute(tag, "timestep")? {
        None => number as f64,
        Some(text) => match text.trim().parse() {
            Ok(time) if f64::is_finite(time) => time,
            _ => return Err(format!("the timestep {} where a number is expected", shown(text.as_bytes()))),
        },
    };
    Ok(Moment { time, path })
}
