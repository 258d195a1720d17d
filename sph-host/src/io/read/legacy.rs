//! VTK's legacy format: `.vtk`, ASCII and binary, to version 5.1.
//!
//! Cells are passed over; of the attributes those of the points are kept. Binary numbers have the highest byte first.
//! Source: *VTK File Formats*, docs.vtk.org.

use super::from_vtk;
use super::legacy_text::{Cursor, Kind, decoded};
use crate::io::error::{Parsed, Problem, shown};
use crate::io::numbers::Stored;
use crate::io::table::{Array, PointTable};

/// What has been read so far.
struct Reader<'a> {
    cursor: Cursor<'a>,
    /// Whether cells are lists of offsets, as from version 5 on.
    has_offsets: bool,
    points: Option<Vec<f64>>,
    arrays: Vec<Array>,
    /// How many points or cells the attributes that follow belong to, and whether it is points.
    section: Option<(usize, bool)>,
}

/// Reads a file of VTK's legacy format.
pub(super) fn read(bytes: &[u8]) -> Parsed<PointTable> {
    let mut cursor = Cursor::new(bytes);
    let start = cursor.line().unwrap_or_default();
    let version = start.strip_prefix(b"# vtk DataFile Version ").ok_or_else(|| {
        let problem = format!("{} where `# vtk DataFile Version` is expected", shown(start));
        Problem::at("line 1", problem)
    })?;
    let has_offsets = version.trim_ascii_start().first().is_some_and(|major| (b'5'..=b'9').contains(major));
    cursor.line();
    let coding = cursor.line().unwrap_or_default().to_ascii_uppercase();
    cursor.ascii = match coding.as_slice() {
        b"ASCII" => true,
        b"BINARY" => false,
        other => {
            return Err(Problem::at("line 3", format!("{} where ASCII or BINARY is expected", shown(other))));
        }
    };
    let mut reader = Reader { cursor, has_offsets, points: None, arrays: Vec::new(), section: None };
    loop {
        let place = reader.cursor.place();
        let Some(words) = reader.cursor.words()? else { break };
        reader.block(&words, &place)?;
    }
    let points =
        reader.points.ok_or_else(|| Problem::new("there are no POINTS, or the file is cut short"))?;
    from_vtk(&points, reader.arrays)
}

/// The count in `words[index]`.
fn count(words: &[&str], index: usize, place: &str) -> Parsed<usize> {
    let word = words.get(index).copied().unwrap_or_default();
    word.parse().map_err(|_| {
        let problem = format!("{}: {} where a count is expected", words[0], shown(word.as_bytes()));
        Problem::at(place, problem)
    })
}

/// The type in `words[index]`.
fn kind(words: &[&str], index: usize, place: &str) -> Parsed<Kind> {
    let word = words.get(index).copied().unwrap_or_default();
    Kind::named(word).ok_or_else(|| {
        let problem = format!("{}: {} where a type of numbers is expected", words[0], shown(word.as_bytes()));
        Problem::at(place, problem)
    })
}

impl Reader<'_> {
    /// Reads what the line of keywords `words` starts.
    fn block(&mut self, words: &[&str], place: &str) -> Parsed<()> {
        let keyword = words.first().map(|word| word.to_ascii_uppercase()).unwrap_or_default();
        let components = match keyword.as_str() {
            "DATASET" => return dataset(words, place),
            "DIMENSIONS" => return Ok(()),
            "POINTS" => return self.points(words, place),
            "CELLS" | "VERTICES" | "LINES" | "POLYGONS" | "TRIANGLE_STRIPS" => {
                return self.cells(words, place);
            }
            "CELL_TYPES" => {
                let cells = count(words, 1, place)?;
                return self.cursor.numbers("CELL_TYPES", Stored::I32, cells).map(drop);
            }
            "POINT_DATA" => return self.section(words, true, place),
            "CELL_DATA" => return self.section(words, false, place),
            "FIELD" => return self.field(words, place),
            "LOOKUP_TABLE" => {
                let entries = count(words, 2, place)?.saturating_mul(4);
                return self.cursor.numbers("LOOKUP_TABLE", Stored::U8, entries).map(drop);
            }
            "SCALARS" => words.get(3).map_or(Ok(1), |_| count(words, 3, place))?,
            "COLOR_SCALARS" => return self.colours(words, place),
            "TEXTURE_COORDINATES" => count(words, 2, place)?,
            "VECTORS" | "NORMALS" => 3,
            "TENSORS" => 9,
            "TENSORS6" => 6,
            "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => 1,
            _ => {
                return Err(Problem::at(place, format!("{} is no known keyword", shown(keyword.as_bytes()))));
            }
        };
        let kind = kind(words, if keyword == "TEXTURE_COORDINATES" { 3 } else { 2 }, place)?;
        if keyword == "SCALARS" {
            self.cursor.skip_line(b"LOOKUP_TABLE");
        }
        let Some((tuples, _)) = self.section else {
            return Err(Problem::at(place, format!("{keyword} before POINT_DATA")));
        };
        self.array(words[1], &kind, components, tuples)
    }

    fn points(&mut self, words: &[&str], place: &str) -> Parsed<()> {
        let points = count(words, 1, place)?;
        let Kind::Numbers(stored) = kind(words, 2, place)? else {
            return Err(Problem::at(place, "POINTS are texts, where numbers are expected"));
        };
        if self.points.is_some() {
            return Err(Problem::at(place, "POINTS for the second time"));
        }
        self.cursor.components = 3;
        let values = points.saturating_mul(3);
        self.points = Some(self.cursor.numbers("POINTS", stored, values)?);
        Ok(())
    }

    fn cells(&mut self, words: &[&str], place: &str) -> Parsed<()> {
        let (first, second) = (count(words, 1, place)?, count(words, 2, place)?);
        if !self.has_offsets {
            return self.cursor.numbers(words[0], Stored::I32, second).map(drop);
        }
        for (name, values) in [("OFFSETS", first), ("CONNECTIVITY", second)] {
            let place = self.cursor.place();
            let words = self.cursor.words()?.unwrap_or_default();
            if !words.first().is_some_and(|word| word.eq_ignore_ascii_case(name)) {
                return Err(Problem::at(place, format!("{name} is expected")));
            }
            let Kind::Numbers(stored) = kind(&words, 1, &place)? else {
                return Err(Problem::at(place, format!("{name} are texts, where numbers are expected")));
            };
            self.cursor.numbers(name, stored, values)?;
        }
        Ok(())
    }

    fn section(&mut self, words: &[&str], of_points: bool, place: &str) -> Parsed<()> {
        let tuples = count(words, 1, place)?;
        let points = self.points.as_ref().map_or(0, |points| points.len() / 3);
        if of_points && tuples != points {
            return Err(Problem::at(
                place,
                format!("POINT_DATA for {tuples} points, but there are {points}"),
            ));
        }
        self.section = Some((tuples, of_points));
        Ok(())
    }

    /// Reads `FIELD name n` with its n arrays, each behind a line `name components tuples type`.
    fn field(&mut self, words: &[&str], place: &str) -> Parsed<()> {
        for _ in 0..count(words, 2, place)? {
            let place = self.cursor.place();
            let Some(words) = self.cursor.words()? else {
                return Err(Problem::at(place, "FIELD is cut short: an array is expected"));
            };
            let (components, tuples) = (count(&words, 1, &place)?, count(&words, 2, &place)?);
            let kind = kind(&words, 3, &place)?;
            self.array(words[0], &kind, components, tuples)?;
        }
        Ok(())
    }

    /// Colours: bytes, or numbers from 0 to 1 as text.
    fn colours(&mut self, words: &[&str], place: &str) -> Parsed<()> {
        let components = count(words, 2, place)?;
        let tuples = self.section.map_or(0, |(tuples, _)| tuples);
        self.array(words[1], &Kind::Numbers(Stored::U8), components, tuples)
    }

    /// Reads an array, and keeps it if it belongs to the points.
    fn array(&mut self, name: &str, kind: &Kind, components: usize, tuples: usize) -> Parsed<()> {
        let name = decoded(name);
        let what = format!("array `{name}`");
        self.cursor.components = components;
        let of_points = matches!(self.section, Some((_, true)));
        let values = components.saturating_mul(tuples);
        let array = match kind {
            Kind::Numbers(stored) => {
                Array::new(name, components, self.cursor.numbers(&what, *stored, values)?)
            }
            Kind::Text => {
                self.cursor.skip_texts(&what, values)?;
                Array::unusable(name, "texts where numbers are expected", false)
            }
        };
        if of_points {
            self.arrays.push(array);
        }
        Ok(())
    }
}

fn dataset(words: &[&str], place: &str) -> Parsed<()> {
    let name = words.get(1).map(|name| name.to_ascii_uppercase()).unwrap_or_default();
    match name.as_str() {
        "UNSTRUCTURED_GRID" | "POLYDATA" | "STRUCTURED_GRID" => Ok(()),
        _ => {
            let problem = format!(
                "the data set {} has no list of points: UNSTRUCTURED_GRID or POLYDATA is expected",
                shown(name.as_bytes())
            );
            Err(Problem::at(place, problem))
        }
    }
}
