//! Records of RFC 4180 with the lines that they stand on.
//!
//! Lines without a quotation mark, which is nearly all of a particle file, are cut at the delimiter where they stand.

use crate::io::error::{Parsed, Problem};
use std::io::BufRead;

/// The records of a text table. Blank lines and lines that start with `#` are passed over.
pub(super) struct Records<R> {
    input: R,
    delimiter: u8,
    /// The last comment before the first record, with its line.
    comment: Option<(usize, Vec<u8>)>,
    /// Whether no record has been read.
    is_new: bool,
    /// How many lines have been read.
    lines: usize,
    line: Vec<u8>,
    unquoted: Vec<u8>,
    /// Whether a carriage return stood before the line's line feed.
    has_return: bool,
    /// The cells of the current record, in `unquoted` if it has quotation marks, else in `line`.
    cells: Vec<Cell>,
    has_marks: bool,
}

/// Where a cell is, and whether it stood between quotation marks.
#[derive(Clone, Copy)]
struct Cell {
    start: usize,
    end: usize,
    is_quoted: bool,
}

/// Where in a cell the splitting of a line with quotation marks is.
#[derive(Clone, Copy, PartialEq)]
enum State {
    /// Blanks at the start of a cell.
    Start,
    /// A cell without quotation marks.
    Plain,
    /// Between quotation marks.
    Quoted,
    /// Behind a quotation mark that closes the cell, or is the first of a pair.
    Closing,
    /// Blanks behind a closed cell.
    Closed,
}

impl<R: BufRead> Records<R> {
    pub(super) fn new(input: R, delimiter: u8) -> Self {
        let (line, unquoted, cells) = (Vec::new(), Vec::new(), Vec::new());
        let (comment, is_new, has_return, has_marks) = (None, true, false, false);
        Self { input, delimiter, comment, is_new, lines: 0, line, unquoted, has_return, cells, has_marks }
    }

    /// Passes over so many lines, or all there are.
    pub(super) fn skip_lines(&mut self, count: usize) -> Parsed<()> {
        for _ in 0..count {
            if !self.next_line()? {
                break;
            }
        }
        Ok(())
    }

    /// Moves to the next record and returns the line that it starts on, from 1.
    pub(super) fn advance(&mut self) -> Parsed<Option<usize>> {
        loop {
            if !self.next_line()? {
                return Ok(None);
            }
            match self.line.iter().find(|&&byte| !self.is_blank(byte)) {
                None => {}
                Some(b'#') if self.is_new => self.comment = Some((self.lines, self.line.clone())),
                Some(b'#') => {}
                Some(_) => break,
            }
        }
        if std::mem::take(&mut self.is_new) && self.delimiter == b',' {
            self.find_delimiter();
        }
        let start = self.lines;
        self.cells.clear();
        self.has_marks = memchr::memchr(b'"', &self.line).is_some();
        if self.has_marks {
            self.cut_quoted(start)?
        } else {
            self.cut()
        }
        Ok(Some(start))
    }

    /// Semicolons are between the cells where the first record, or else the comment before it, has some and no comma.
    fn find_delimiter(&mut self) {
        let comment = self.comment.as_ref().map(|(_, comment)| comment);
        if has_semicolons(&self.line) || comment.is_some_and(|comment| has_semicolons(comment)) {
            self.delimiter = b';';
        }
    }

    /// Whether commas are in numbers, as they are where semicolons are between them.
    pub(super) fn has_decimal_commas(&self) -> bool {
        self.delimiter == b';'
    }

    /// The last comment before the first record, without its marks, as records of their own, and its line.
    pub(super) fn comment(&self) -> Option<(usize, Records<&[u8]>)> {
        let (line, comment) = self.comment.as_ref()?;
        let start = comment.iter().position(|byte| !b"# \t".contains(byte))?;
        Some((*line, Records { is_new: false, ..Records::new(&comment[start..], self.delimiter) }))
    }

    /// How many cells the current record has.
    pub(super) fn len(&self) -> usize {
        self.cells.len()
    }

    /// The cells of the current record: as they are where they stand between quotation marks, else without blanks around.
    pub(super) fn cells(&self) -> impl Iterator<Item = &[u8]> {
        let text = if self.has_marks { &self.unquoted } else { &self.line };
        self.cells.iter().map(|cell| {
            let content = &text[cell.start..cell.end];
            if cell.is_quoted { content } else { self.trimmed(content) }
        })
    }

    /// Whether the cell with this number stands between quotation marks.
    pub(super) fn is_quoted(&self, index: usize) -> bool {
        self.cells.get(index).is_some_and(|cell| cell.is_quoted)
    }

    fn is_blank(&self, byte: u8) -> bool {
        byte == b' ' || byte == b'\t' && self.delimiter != b'\t'
    }

    fn trimmed<'a>(&self, mut cell: &'a [u8]) -> &'a [u8] {
        while let Some((&first, rest)) = cell.split_first()
            && self.is_blank(first)
        {
            cell = rest;
        }
        while let Some((&last, rest)) = cell.split_last()
            && self.is_blank(last)
        {
            cell = rest;
        }
        cell
    }

    /// Reads a line without its end, which is a line feed with or without a carriage return before it.
    fn next_line(&mut self) -> Parsed<bool> {
        self.line.clear();
        if self.input.read_until(b'\n', &mut self.line)? == 0 {
            return Ok(false);
        }
        self.lines += 1;
        if self.lines == 1 && self.line.starts_with(b"\xef\xbb\xbf") {
            self.line.drain(..3);
        }
        if self.line.ends_with(b"\n") {
            self.line.pop();
        }
        self.has_return = self.line.ends_with(b"\r");
        if self.has_return {
            self.line.pop();
        }
        Ok(true)
    }

    fn cut(&mut self) {
        let mut start = 0;
        for end in memchr::memchr_iter(self.delimiter, &self.line) {
            self.cells.push(Cell { start, end, is_quoted: false });
            start = end + 1;
        }
        self.cells.push(Cell { start, end: self.line.len(), is_quoted: false });
    }

    /// Cuts a record with quotation marks, which may go over several lines.
    fn cut_quoted(&mut self, start: usize) -> Parsed<()> {
        self.unquoted.clear();
        let (mut state, mut begin) = (State::Start, 0);
        loop {
            for index in 0..self.line.len() {
                let byte = self.line[index];
                state = self.step(state, byte, &mut begin)?;
            }
            if state != State::Quoted {
                self.end_cell(state, begin);
                return Ok(());
            }
            self.unquoted.extend_from_slice(if self.has_return { b"\r\n" } else { b"\n" });
            if !self.next_line()? {
                return Err(Problem::at(format!("line {start}"), "a quotation mark is never closed"));
            }
        }
    }

    fn end_cell(&mut self, state: State, start: usize) {
        let is_quoted = matches!(state, State::Closing | State::Closed);
        self.cells.push(Cell { start, end: self.unquoted.len(), is_quoted });
    }

    fn step(&mut self, state: State, byte: u8, begin: &mut usize) -> Parsed<State> {
        let next = match (state, byte) {
            (State::Quoted, b'"') => return Ok(State::Closing),
            (State::Quoted, _) => State::Quoted,
            (State::Closing, b'"') => State::Quoted,
            (_, byte) if byte == self.delimiter => {
                self.end_cell(state, *begin);
                *begin = self.unquoted.len();
                return Ok(State::Start);
            }
            (State::Start, b'"') => return Ok(State::Quoted),
            (State::Start | State::Closing | State::Closed, byte) if self.is_blank(byte) => {
                return Ok(if state == State::Start { State::Start } else { State::Closed });
            }
            (State::Start | State::Plain, _) => State::Plain,
            (State::Closing | State::Closed, _) => {
                let at = format!("line {}, cell {}", self.lines, self.cells.len() + 1);
                return Err(Problem::at(at, "text behind a closing quotation mark"));
            }
        };
        self.unquoted.push(byte);
        Ok(next)
    }
}

/// Whether a line has semicolons outside quotation marks, and no comma there.
fn has_semicolons(line: &[u8]) -> bool {
    let mut is_quoted = false;
    let mut outside = line.iter().filter(|&&byte| {
        is_quoted ^= byte == b'"';
        !is_quoted
    });
    let (mut semicolons, mut commas) = (0, 0);
    outside.by_ref().for_each(|&byte| match byte {
        b';' => semicolons += 1,
        b',' => commas += 1,
        _ => {}
    });
    semicolons > 0 && commas == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn records(text: &[u8], delimiter: u8) -> Vec<(usize, Vec<String>)> {
        let mut records = Records::new(text, delimiter);
        let mut out = Vec::new();
        while let Some(line) = records.advance().unwrap() {
            let cells: Vec<String> =
                records.cells().map(|cell| String::from_utf8(cell.to_vec()).unwrap()).collect();
            assert_eq!(cells.len(), records.len());
            out.push((line, cells));
        }
        out
    }

    fn row(line: usize, cells: &[&str]) -> (usize, Vec<String>) {
        (line, cells.iter().map(|cell| (*cell).to_owned()).collect())
    }

    #[test]
    fn lines_are_those_of_the_file() {
        let text = b"\xef\xbb\xbf# note, \"unclosed\r\n\r\na , \"b \"\"c\"\"\"\r\n  \n\"two\r\nlines\" ,\"d,e\"\n # f\n1,2";
        let want = [row(3, &["a", "b \"c\""]), row(5, &["two\r\nlines", "d,e"]), row(8, &["1", "2"])];
        assert_eq!(records(text, b','), want);
    }

    #[test]
    fn a_tab_is_blank_only_where_it_does_not_delimit() {
        assert_eq!(records(b"a\t,\tb\n\t\n", b','), [row(1, &["a", "b"])]);
        assert_eq!(records(b" a \t\t b\n\t\n \n", b'\t'), [row(1, &["a", "", "b"]), row(2, &["", ""])]);
    }

    #[test]
    fn a_mark_inside_a_plain_cell_is_text() {
        assert_eq!(records(b"5\",6\n1,2", b','), [row(1, &["5\"", "6"]), row(2, &["1", "2"])]);
        assert_eq!(records(b"\"\",\"#\"", b','), [row(1, &["", "#"])]);
        assert_eq!(records(b" \" a \" , b ", b','), [row(1, &[" a ", "b"])]);
    }

    #[test]
    fn broken_quotation_is_refused_with_its_line() {
        for (text, at) in [("a\n\"b\nc\n", "line 2"), ("a,b\n1,\"x\"y\n", "line 2, cell 2")] {
            let mut records = Records::new(text.as_bytes(), b',');
            records.advance().unwrap();
            let Err(Problem::Invalid { at: Some(found), .. }) = records.advance() else { panic!("{text}") };
            assert_eq!(found, at);
        }
    }

    proptest! {
        /// What the crate `csv` writes is read back as it was given.
        #[test]
        fn reads_what_csv_writes(
            rows in prop::collection::vec(prop::collection::vec("[a\",\n\r;#é]{0,5}b", 3), 1..8),
            delimiter in prop::sample::select(vec![b',', b'\t']),
        ) {
            let mut writer = csv::WriterBuilder::new().delimiter(delimiter).from_writer(Vec::new());
            for row in &rows {
                // A bare carriage return before a line feed is a line's end here, so none is written.
                writer.write_record(row.iter().map(|cell| cell.replace('\r', "")).map(|c| format!(".{c}"))).unwrap();
            }
            let read = records(&writer.into_inner().unwrap(), delimiter);
            let want: Vec<Vec<String>> = rows.iter()
                .map(|row| row.iter().map(|cell| format!(".{}", cell.replace('\r', ""))).collect()).collect();
            prop_assert_eq!(read.into_iter().map(|(_, cells)| cells).collect::<Vec<_>>(), want);
        }
    }
}
