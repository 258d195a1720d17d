//! VTK's legacy format: `.vtk`, ASCII and binary, to version 5.1.
//!
//! Words are read wherever lines break; binary numbers begin behind the line of the last word before them, with the
//! highest byte first. Cells are passed over; of the attributes those of the points are kept.
//! Source: *VTK File Formats*, docs.vtk.org.

use super::budget::refuse_wide;
use super::legacy_text::{Cursor, Kind, Place, decoded, is_keyword};
use super::text_numbers::required;
use super::{bytes, from_vtk};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, counted, shown};
use crate::io::numbers::Stored;
use crate::io::table::{Array, PointTable, Unusable};

/// What has been read so far.
struct Reader<'a> {
    cursor: Cursor<'a>,
    /// Whether cells are lists of offsets, as from version 5 on.
    has_offsets: bool,
    points: Option<Vec<f64>>,
    image: Option<Image>,
    arrays: Vec<Array>,
    /// How many points or cells the attributes that follow belong to, and whether it is points.
    section: Option<(usize, bool)>,
}

/// The points of `STRUCTURED_POINTS`: a regular grid, x runs fastest.
struct Image {
    counts: [usize; 3],
    origin: [f64; 3],
    spacing: [f64; 3],
}

/// Reads a file of VTK's legacy format.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    let bytes = bytes(&file.path)?;
    let mut reader = Reader::begin(&bytes)?;
    loop {
        let place = reader.cursor.place();
        let Some(word) = reader.cursor.word_behind_metadata() else { break };
        reader.block(word, place)?;
    }
    reader.finish()
}

impl<'a> Reader<'a> {
    /// Reads the two lines at the start and the word behind them.
    fn begin(bytes: &'a [u8]) -> Parsed<Self> {
        let mut cursor = Cursor::new(bytes);
        let start = cursor.line().unwrap_or_default();
        let version = start.strip_prefix(b"# vtk DataFile Version ").ok_or_else(|| {
            let problem = format!("{} where `# vtk DataFile Version` is expected", shown(start));
            Problem::at("line 1", problem)
        })?;
        let has_offsets =
            version.trim_ascii_start().first().is_some_and(|major| (b'5'..=b'9').contains(major));
        cursor.line();
        let coding = cursor.word().unwrap_or_default();
        cursor.ascii = match coding.to_ascii_uppercase().as_slice() {
            b"ASCII" => true,
            b"BINARY" => false,
            _ => {
                let problem = format!("{} where ASCII or BINARY is expected", shown(coding));
                return Err(Problem::at("line 3", problem));
            }
        };
        Ok(Self { cursor, has_offsets, points: None, image: None, arrays: Vec::new(), section: None })
    }

    /// Reads what the keyword `word` at `place` starts.
    fn block(&mut self, word: &[u8], place: Place) -> Parsed<()> {
        if !is_keyword(word) {
            let problem = format!(
                "{} where a keyword such as POINT_DATA is expected, or the numbers before it are more than claimed",
                shown(word)
            );
            return Err(self.cursor.problem(place, problem));
        }
        let keyword = String::from_utf8_lossy(word).to_ascii_uppercase();
        match keyword.as_str() {
            "DATASET" => self.dataset(),
            "DIMENSIONS" => self.image_axes("a count of points", |image| &mut image.counts),
            "ORIGIN" => self.image_axes("a coordinate", |image| &mut image.origin),
            "SPACING" | "ASPECT_RATIO" => self.image_axes("a spacing", |image| &mut image.spacing),
            "POINTS" => self.points(place),
            "CELL_TYPES" => {
                let cells = self.cursor.number("a count of cells")?;
                self.cursor.skip_numbers("CELL_TYPES", Stored::I32, cells)
            }
            "CELLS" | "VERTICES" | "LINES" | "POLYGONS" | "TRIANGLE_STRIPS" => self.cells(&keyword),
            "POINT_DATA" => self.section(true, place),
            "CELL_DATA" => self.section(false, place),
            "FIELD" => self.field(),
            "LOOKUP_TABLE" => {
                self.cursor.text("a name")?;
                let entries = self.cursor.number::<usize>("a count of entries")?.saturating_mul(4);
                self.cursor.skip_numbers("LOOKUP_TABLE", Stored::U8, entries)
            }
            _ => self.attribute(&keyword, place),
        }
    }

    fn dataset(&mut self) -> Parsed<()> {
        let place = self.cursor.place();
        let name = self.cursor.text("a kind of data set")?;
        match name.to_ascii_uppercase().as_str() {
            "UNSTRUCTURED_GRID" | "POLYDATA" | "STRUCTURED_GRID" => {}
            "STRUCTURED_POINTS" => {
                self.image = Some(Image { counts: [0; 3], origin: [0.0; 3], spacing: [1.0; 3] });
            }
            _ => {
                let problem = format!(
                    "the data set {} where UNSTRUCTURED_GRID, POLYDATA, STRUCTURED_GRID or STRUCTURED_POINTS is expected",
                    shown(name.as_bytes())
                );
                return Err(self.cursor.problem(place, problem));
            }
        }
        Ok(())
    }

    /// Reads three numbers, one an axis; those of other data sets than images are passed over.
    fn image_axes<N: std::str::FromStr>(
        &mut self,
        what: &str,
        axes: impl Fn(&mut Image) -> &mut [N; 3],
    ) -> Parsed<()> {
        for axis in 0..3 {
            let value = self.cursor.number(what)?;
            if let Some(image) = &mut self.image {
                axes(image)[axis] = value;
            }
        }
        Ok(())
    }

    fn points(&mut self, place: Place) -> Parsed<()> {
        let points = self.cursor.number("a count of points")?;
        let Kind::Numbers(stored) = self.cursor.kind("POINTS")? else {
            return Err(self.cursor.problem(place, "POINTS are texts, where numbers are expected"));
        };
        if self.points.is_some() {
            return Err(self.cursor.problem(place, "POINTS for the second time"));
        }
        self.cursor.components = 3;
        self.points = Some(required(self.cursor.array("POINTS".to_owned(), stored, 3, points))?);
        Ok(())
    }

    fn cells(&mut self, keyword: &str) -> Parsed<()> {
        let (first, second) =
            (self.cursor.number("a count of cells")?, self.cursor.number("a count of numbers")?);
        if !self.has_offsets {
            return self.cursor.skip_numbers(keyword, Stored::I32, second);
        }
        for (name, values) in [("OFFSETS", first), ("CONNECTIVITY", second)] {
            let place = self.cursor.place();
            if !self.cursor.skip_keyword(name) {
                return Err(self.cursor.problem(place, format!("{name} of {keyword} is expected")));
            }
            let Kind::Numbers(stored) = self.cursor.kind(name)? else {
                return Err(self
                    .cursor
                    .problem(place, format!("{name} are texts, where numbers are expected")));
            };
            self.cursor.skip_numbers(name, stored, values)?;
        }
        Ok(())
    }

    fn section(&mut self, of_points: bool, place: Place) -> Parsed<()> {
        let tuples = self.cursor.number("a count of points or cells")?;
        let points = self.point_count();
        if of_points && tuples != points {
            let problem = format!("POINT_DATA for {tuples}, but there are {}", counted(points, "point"));
            return Err(self.cursor.problem(place, problem));
        }
        self.section = Some((tuples, of_points));
        Ok(())
    }

    fn point_count(&self) -> usize {
        let listed = self.points.as_ref().map_or(0, |points| points.len() / 3);
        let product =
            |image: &Image| image.counts.iter().fold(1usize, |all, &count| all.saturating_mul(count));
        self.image.as_ref().map_or(listed, product)
    }

    /// Reads `FIELD name n` with its n arrays, each behind `name components tuples type`.
    fn field(&mut self) -> Parsed<()> {
        self.cursor.text("a name")?;
        for _ in 0..self.cursor.number::<usize>("a count of arrays")? {
            let place = self.cursor.place();
            let name = self.cursor.word_behind_metadata();
            let name = name.and_then(|name| std::str::from_utf8(name).ok());
            let name = name.ok_or_else(|| {
                self.cursor.problem(place, "FIELD is cut short: the name of an array is expected")
            })?;
            let (components, tuples) =
                (self.cursor.number("a count of components")?, self.cursor.number("a count of tuples")?);
            let kind = self.cursor.kind(name)?;
            self.array(name, &kind, components, tuples)?;
        }
        Ok(())
    }

    /// Reads an attribute, whose keyword says how many components it has.
    fn attribute(&mut self, keyword: &str, place: Place) -> Parsed<()> {
        let name = self.cursor.text("a name")?;
        let (kind, components) = match keyword {
            // Bytes, or numbers from 0 to 1 as text.
            "COLOR_SCALARS" => (Kind::Numbers(Stored::U8), self.cursor.number("a count of components")?),
            "TEXTURE_COORDINATES" => {
                let components = self.cursor.number("a count of components")?;
                (self.cursor.kind(keyword)?, components)
            }
            "SCALARS" => (self.cursor.kind(keyword)?, self.cursor.scalars()?),
            "VECTORS" | "NORMALS" => (self.cursor.kind(keyword)?, 3),
            "TENSORS" => (self.cursor.kind(keyword)?, 9),
            "TENSORS6" => (self.cursor.kind(keyword)?, 6),
            _ => (self.cursor.kind(keyword)?, 1),
        };
        let Some((tuples, _)) = self.section else {
            return Err(self.cursor.problem(place, format!("{keyword} before POINT_DATA")));
        };
        self.array(name, &kind, components, tuples)
    }

    /// Reads an array, and keeps it if it belongs to the points.
    fn array(&mut self, name: &str, kind: &Kind, components: usize, tuples: usize) -> Parsed<()> {
        let name = decoded(name);
        self.cursor.components = components;
        let mut array = match kind {
            Kind::Numbers(stored) => self.cursor.array(name, *stored, components, tuples),
            Kind::Text => {
                let what = format!("array `{name}`");
                self.cursor.skip_texts(&what, components.saturating_mul(tuples))?;
                Array::unusable(name, Unusable::other("texts where numbers are expected"))
            }
        };
        let points = self.point_count();
        if tuples != points || components == 0 {
            let problem =
                format!("{} of {components} for {}", counted(tuples, "tuple"), counted(points, "point"));
            array = Array::unusable(array.name, Unusable::other(problem));
        }
        if let Err(problem) = refuse_wide(components) {
            array = Array::unusable(array.name, Unusable::other(problem));
        }
        if matches!(self.section, Some((_, true))) {
            self.arrays.push(array);
        }
        Ok(())
    }

    fn finish(self) -> Parsed<PointTable> {
        let count = self.point_count();
        match (self.points, self.image) {
            (Some(points), None) => from_vtk(&points, self.arrays),
            // The counts are claims; an array with one number a point makes them good.
            (None, Some(image)) if self.arrays.iter().any(|array| array.values.len() >= count) => {
                // Coordinates point by point, then axis by axis.
                self.cursor.budget.grow(count.saturating_mul(6)).map_err(Problem::new)?;
                from_vtk(&image.points(count), self.arrays)
            }
            (None, Some(_)) => {
                // An array at fault says what is wrong.
                self.arrays.iter().try_for_each(|array| array.usable().map(drop))?;
                Err(Problem::new("there are no numbers at the points of the grid, or the file is cut short"))
            }
            (Some(_), Some(_)) => Err(Problem::new("there are POINTS in a data set of STRUCTURED_POINTS")),
            (None, None) => Err(Problem::new("there are no POINTS, or the file is cut short")),
        }
    }
}

impl Image {
    /// The coordinates of all `count` points, point by point.
    fn points(&self, count: usize) -> Vec<f64> {
        let [nx, ny, _] = self.counts;
        let point = |index: usize| [index % nx, index / nx % ny, index / nx / ny];
        let along =
            |index: usize, axis: usize| self.origin[axis] + point(index)[axis] as f64 * self.spacing[axis];
        (0..count).flat_map(|index| [along(index, 0), along(index, 1), along(index, 2)]).collect()
    }
}
