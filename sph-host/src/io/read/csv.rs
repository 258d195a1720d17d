//! Text tables: `.csv` and `.tsv`.
//!
//! One pass, column by column, whole or some rows at a time; the float parser rounds correctly, so what was printed in full is read to the bit.

use super::records::Records;
use crate::io::error::{Parsed, Problem, shown};
use crate::io::numbers;
use crate::io::table::{Array, Fault, PointTable, Rows, check_names, take_coordinates};
use std::io::BufRead;

/// A column while it is read.
struct Column {
    name: String,
    /// One number a row; NaN where there is none.
    values: Vec<f64>,
    has_numbers: bool,
    /// The first cell that is no number, with its line.
    fault: Option<(usize, String)>,
}

/// A text table on its way in.
pub(super) struct Text<R> {
    records: Records<R>,
    /// The line of the header.
    header: usize,
    names: Vec<String>,
}

/// Reads a table of cells with `delimiter` between them.
pub(super) fn read(input: impl BufRead, delimiter: u8) -> Parsed<PointTable> {
    Text::open(input, delimiter)?.piece(usize::MAX)
}

impl<R: BufRead> Text<R> {
    /// Reads the header.
    pub(super) fn open(input: R, delimiter: u8) -> Parsed<Self> {
        let mut records = Records::new(input, delimiter);
        let Some(header) = records.advance()? else {
            return Err(Problem::new("there is no header, nothing but blank lines and comments"));
        };
        let names = names(header, &records)?;
        Ok(Self { records, header, names })
    }

    /// The next rows, at most so many.
    pub(super) fn piece(&mut self, most: usize) -> Parsed<PointTable> {
        let header = self.header;
        let mut columns: Vec<Column> = self.names.iter().map(|name| Column::new(name)).collect();
        let mut rows = Rows::Lines(header, Vec::new());
        let mut row = 0;
        while row < most
            && let Some(line) = self.records.advance()?
        {
            if self.records.len() != columns.len() {
                let (have, want) = (self.records.len(), columns.len());
                let problem = format!("the row has {have} cells where the header has {want}");
                return Err(Problem::at(format!("line {line}"), problem));
            }
            rows.push(row, line);
            for (column, cell) in columns.iter_mut().zip(self.records.cells()) {
                column.push(line, cell);
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
        if numbers::parse(cell).is_some_and(f64::is_finite) {
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
        Self { name: name.to_owned(), values: Vec::new(), has_numbers: false, fault: None }
    }

    #[inline]
    fn push(&mut self, line: usize, cell: &[u8]) {
        match numbers::parse(cell) {
            Some(value) => {
                self.has_numbers = true;
                self.values.push(value);
            }
            None => self.push_fault(line, cell),
        }
    }

    #[cold]
    fn push_fault(&mut self, line: usize, cell: &[u8]) {
        if self.fault.is_none() {
            self.fault = Some((line, shown(cell)));
        }
        self.values.push(f64::NAN);
    }

    fn finish(self) -> Array {
        let has_numbers = self.has_numbers;
        let fault = self.fault.map(|(line, text)| Fault {
            at: format!("line {line}, column `{}`", self.name),
            problem: if text == "``" {
                "the cell is empty where a number is expected".to_owned()
            } else {
                format!("{text} where a number is expected")
            },
            has_numbers,
        });
        let values = if fault.is_some() { Vec::new() } else { self.values };
        Array { name: self.name, components: 1, values, fault }
    }
}
