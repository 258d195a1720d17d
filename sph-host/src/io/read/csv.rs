//! Text tables: `.csv` and `.tsv`.
//!
//! One pass, column by column, whole or some rows at a time; the float parser rounds correctly, so what was printed in
//! full is read to the bit. An empty cell is no value: NaN, named where a number is wanted.
//!
//! Tables of spreadsheets and of numpy.savetxt are taken too: cells with semicolons between and decimal commas, a row of units
//! under the header, a header behind `#`.

use super::budget::Budget;
use super::pieces::Source;
use super::records::Records;
use super::{Buffered, open};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, counted, shown};
use crate::io::names::check_names;
use crate::io::numbers;
use crate::io::rows::Rows;
use crate::io::table::{Array, Fault, PointTable};
use std::io::BufRead;

/// A column while it is read.
struct Column {
    name: String,
    /// One number a row; NaN where there is none.
    values: Vec<f64>,
    /// The first cell that is no number, with its line.
    fault: Option<(usize, String)>,
    /// The row of the first empty cell.
    empty: Option<usize>,
}

/// A text table that is being read.
struct Text<R> {
    records: Records<R>,
    /// The line of the header.
    header: usize,
    names: Vec<String>,
    /// The names of the coordinates, if they were named.
    position: Vec<String>,
    /// The line of a record that has been moved to, but not been read.
    pending: Option<usize>,
}

/// Reads a table of cells with `DELIMITER` between them.
pub(super) fn read<const DELIMITER: u8>(file: &InputFile) -> Parsed<PointTable> {
    Text::open(open(&file.path, b"")?, DELIMITER, file)?.piece(usize::MAX)
}

/// Opens such a table to be read some rows at a time.
pub(super) fn pieces<const DELIMITER: u8>(file: &InputFile) -> Parsed<Box<dyn Source>> {
    Ok(Box::new(Text::<Buffered>::open(open(&file.path, b"")?, DELIMITER, file)?))
}

impl<R: BufRead> Text<R> {
    /// Reads the header, and passes over a row of units under it.
    fn open(input: R, delimiter: u8, file: &InputFile) -> Parsed<Self> {
        let mut records = Records::new(input, delimiter);
        records.skip_lines(file.skip_lines)?;
        let Some(first) = records.advance()? else {
            return Err(Problem::new("there is no header, nothing but blank lines and comments"));
        };
        let (position, pending) = (file.position.clone(), Some(first));
        if let Some((header, names)) = commented_names(&records)? {
            return Ok(Self { records, header, names, position, pending });
        }
        let names = names(first, &records)?;
        let next = records.advance()?;
        let pending = next.filter(|_| !are_units(&records, names.len()));
        Ok(Self { records, header: first, names, position, pending })
    }

    fn next_record(&mut self) -> Parsed<Option<usize>> {
        match self.pending.take() {
            Some(line) => Ok(Some(line)),
            None => self.records.advance(),
        }
    }
}

/// Whether the current record has as many cells as there are names, some with text, and no number in any.
fn are_units<R: BufRead>(records: &Records<R>, names: usize) -> bool {
    let is_number = |cell: &[u8]| numbers::parse_with_comma(cell.trim_ascii()).is_some();
    records.len() == names && records.cells().any(|cell| !cell.is_empty()) && !records.cells().any(is_number)
}

/// The names in a comment before a first record of numbers, with the comment's line, if it has one for each.
fn commented_names<R: BufRead>(records: &Records<R>) -> Parsed<Option<(usize, Vec<String>)>> {
    let parse = if records.has_decimal_commas() { numbers::parse_with_comma } else { numbers::parse };
    let mut are_numbers =
        records.cells().enumerate().map(|(at, cell)| !records.is_quoted(at) && parse(cell).is_some());
    if !are_numbers.all(|is_number| is_number) {
        return Ok(None);
    }
    let Some((line, mut comment)) = records.comment() else { return Ok(None) };
    comment.advance()?;
    if comment.len() != records.len() {
        return Ok(None);
    }
    names(line, &comment).map(|names| Some((line, names)))
}

impl<R: BufRead> Source for Text<R> {
    fn piece(&mut self, most: usize) -> Parsed<PointTable> {
        let header = self.header;
        let mut columns: Vec<Column> = self.names.iter().map(|name| Column::new(name)).collect();
        let mut rows = Rows::lines(header);
        let has_commas = self.records.has_decimal_commas();
        // A text table claims nothing: what it costs is what is kept.
        let budget = Budget::of_file(0);
        let mut row = 0;
        while row < most
            && let Some(line) = self.next_record()?
        {
            if self.records.len() != columns.len() {
                let (have, want) = (counted(self.records.len(), "cell"), columns.len());
                let problem = format!("the row has {have} where the header has {want}");
                return Err(Problem::at(format!("line {line}"), problem));
            }
            rows.push(row, line);
            for (column, cell) in columns.iter_mut().zip(self.records.cells()) {
                budget
                    .push(&mut column.values)
                    .map_err(|problem| Problem::at(format!("line {line}"), problem))?;
                column.push(row, line, cell, has_commas);
            }
            row += 1;
        }
        let arrays: Vec<Array> = columns.into_iter().map(Column::finish).collect();
        PointTable::of_arrays(arrays, rows, &self.position)
    }
}

/// The names of the columns in the header on line `header`.
fn names<R: BufRead>(header: usize, records: &Records<R>) -> Parsed<Vec<String>> {
    let at = format!("line {header}");
    let mut names = Vec::new();
    for (index, cell) in records.cells().enumerate() {
        let place = || format!("{at}, column {}", index + 1);
        let name = std::str::from_utf8(cell)
            .map_err(|_| Problem::at(place(), format!("the name {} is not UTF-8", shown(cell))))?;
        if name.is_empty() {
            return Err(Problem::at(place(), "the name is missing"));
        }
        if !records.is_quoted(index) && numbers::parse(cell).is_some_and(f64::is_finite) {
            let problem = format!("{} is a number, where the header's name is expected", shown(cell));
            return Err(Problem::at(place(), problem));
        }
        names.push(name.to_owned());
    }
    check_names(names.iter().map(String::as_str))
        .map_err(|problem| Problem::at(at, format!("two columns have one name: {problem}")))?;
    Ok(names)
}

impl Column {
    fn new(name: &str) -> Self {
        Self { name: name.to_owned(), values: Vec::new(), fault: None, empty: None }
    }

    #[inline]
    fn push(&mut self, row: usize, line: usize, cell: &[u8], has_commas: bool) {
        let parse = if has_commas { numbers::parse_with_comma } else { numbers::parse };
        let value = match parse(cell) {
            Some(value) => value,
            None => self.odd(row, line, cell, parse),
        };
        self.values.push(value);
    }

    /// The value for a cell that is not a plain number.
    #[cold]
    fn odd(&mut self, row: usize, line: usize, cell: &[u8], parse: fn(&[u8]) -> Option<f64>) -> f64 {
        let trimmed = cell.trim_ascii();
        if trimmed.is_empty() {
            self.empty = self.empty.or(Some(row));
        } else if let Some(value) = parse(trimmed) {
            return value;
        } else if self.fault.is_none() {
            self.fault = Some((line, shown(cell)));
        }
        f64::NAN
    }

    fn finish(self) -> Array {
        let fault = self.fault.map(|(line, text)| (line, format!("{text} where a number is expected")));
        if let Some((line, problem)) = fault {
            let at = format!("line {line}, column `{}`", self.name);
            let has_numbers = self.values.iter().any(|value| !value.is_nan());
            return Array::faulty(self.name, Fault { at, problem }, has_numbers);
        }
        Array { first_empty: self.empty, ..Array::new(self.name, 1, self.values) }
    }
}
