//! Text tables: `.csv` and `.tsv`.
//!
//! One pass, column by column, whole or some rows at a time; the float parser rounds correctly, so what was printed in
//! full is read to the bit. An empty cell is no value: NaN, named where a number is wanted.

use super::budget::Budget;
use super::open;
use super::pieces::Source;
use super::records::Records;
use crate::io::error::{Parsed, Problem, counted, shown};
use crate::io::numbers;
use crate::io::table::{Array, Fault, PointTable, Rows, check_names, is_axis, take_coordinates};
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// A column while it is read.
struct Column {
    name: String,
    /// One number a row; NaN where there is none.
    values: Vec<f64>,
    /// The first cell that is no number, with its line.
    fault: Option<(usize, String)>,
    /// The first empty cell's row and line.
    empty: Option<(usize, usize)>,
}

/// A text table that is being read.
struct Text<R> {
    records: Records<R>,
    /// The line of the header.
    header: usize,
    names: Vec<String>,
}

/// Reads a table of cells with `DELIMITER` between them.
pub(super) fn read<const DELIMITER: u8>(path: &Path) -> Parsed<PointTable> {
    Text::open(open(path, b"")?, DELIMITER)?.piece(usize::MAX)
}

/// Opens such a table to be read some rows at a time.
pub(super) fn pieces<const DELIMITER: u8>(path: &Path) -> Parsed<Box<dyn Source>> {
    Ok(Box::new(Text::<BufReader<File>>::open(open(path, b"")?, DELIMITER)?))
}

impl<R: BufRead> Text<R> {
    /// Reads the header.
    fn open(input: R, delimiter: u8) -> Parsed<Self> {
        let mut records = Records::new(input, delimiter);
        let Some(header) = records.advance()? else {
            return Err(Problem::new("there is no header, nothing but blank lines and comments"));
        };
        let names = names(header, &records)?;
        Ok(Self { records, header, names })
    }
}

impl<R: BufRead> Source for Text<R> {
    fn piece(&mut self, most: usize) -> Parsed<PointTable> {
        let header = self.header;
        let mut columns: Vec<Column> = self.names.iter().map(|name| Column::new(name)).collect();
        let mut rows = Rows::Lines(header, Vec::new());
        // A text table claims nothing: what it costs is what is kept.
        let budget = Budget::of_file(0);
        let mut row = 0;
        while row < most
            && let Some(line) = self.records.advance()?
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
                column.push(row, line, cell);
            }
            row += 1;
        }
        let mut arrays: Vec<Array> = columns.into_iter().map(Column::finish).collect();
        let coordinates =
            take_coordinates(&mut arrays).map_err(|problem| problem.or_at(&format!("line {header}")))?;
        if coordinates.is_empty() {
            let names: Vec<String> = self.names.iter().map(|name| shown(name.as_bytes())).collect();
            let problem = format!("no column is called `x`; there are {}", names.join(", "));
            return Err(Problem::at(format!("line {header}"), problem));
        }
        PointTable::assemble(coordinates, arrays, rows)
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
    fn push(&mut self, row: usize, line: usize, cell: &[u8]) {
        let value = match numbers::parse(cell) {
            Some(value) => value,
            None => self.odd(row, line, cell),
        };
        self.values.push(value);
    }

    /// The value for a cell that is not a plain number.
    #[cold]
    fn odd(&mut self, row: usize, line: usize, cell: &[u8]) -> f64 {
        let trimmed = cell.trim_ascii();
        if trimmed.is_empty() {
            self.empty = self.empty.or(Some((row, line)));
        } else if let Some(value) = numbers::parse(trimmed) {
            return value;
        } else if self.fault.is_none() {
            self.fault = Some((line, shown(cell)));
        }
        f64::NAN
    }

    fn finish(self) -> Array {
        let fault = match (self.fault, self.empty) {
            (Some((line, text)), _) => Some((line, format!("{text} where a number is expected"))),
            (None, Some((_, line))) if is_axis(&self.name) => {
                Some((line, "the cell is empty where a number is expected".to_owned()))
            }
            _ => None,
        };
        if let Some((line, problem)) = fault {
            let at = format!("line {line}, column `{}`", self.name);
            let has_numbers = self.values.iter().any(|value| !value.is_nan());
            return Array::faulty(self.name, Fault { at, problem }, has_numbers);
        }
        Array { first_empty: self.empty.map(|(row, _)| row), ..Array::new(self.name, 1, self.values) }
    }
}
