//! Columns of numbers in lines of words with blanks between; what is no number is a fault of its column.

use super::budget::Budget;
use crate::io::error::{Parsed, Problem, shown};
use crate::io::numbers;
use crate::io::table::{Array, Fault};

/// The lines of a text.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    /// How many lines have been read.
    number: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text, number: 0 }
    }

    /// The number of the line that was read last, from 1.
    pub(super) fn number(&self) -> usize {
        self.number
    }

    /// What is behind the line that was read last.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next line, without its end and blanks around it.
    pub(super) fn advance(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = memchr::memchr(b'\n', self.rest).unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest.get(1..).unwrap_or_default();
        self.number += 1;
        Some(line.trim_ascii())
    }

    /// The next line that is not blank.
    pub(super) fn advance_to_words(&mut self) -> Option<&'a [u8]> {
        loop {
            let line = self.advance()?;
            if !line.is_empty() {
                return Some(line);
            }
        }
    }

    /// A problem of the line that was read last.
    pub(super) fn problem(&self, problem: impl Into<String>) -> Problem {
        Problem::at(format!("line {}", self.number), problem)
    }
}

/// The words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// What the words of a column are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Number,
    /// `T` or `F`, which are 1 and 0.
    Truth,
    /// Text, which is no number whatever it looks like.
    Text,
}

/// A column while it is read.
pub(super) struct Column {
    pub(super) name: String,
    /// How many words a line has for it.
    pub(super) components: usize,
    pub(super) kind: Kind,
    values: Vec<f64>,
    /// The first word that is no number, with its line.
    fault: Option<(usize, String)>,
}

impl Column {
    pub(super) fn new(name: impl Into<String>, components: usize, kind: Kind) -> Self {
        Self { name: name.into(), components, kind, values: Vec::new(), fault: None }
    }

    /// Takes a word of line `line`.
    #[inline]
    pub(super) fn push(&mut self, word: &[u8], line: usize, budget: &Budget) -> Parsed<()> {
        let value = match self.kind {
            Kind::Number => numbers::parse(word),
            Kind::Truth => truth(word),
            Kind::Text => None,
        };
        if value.is_none() && self.fault.is_none() {
            self.fault = Some((line, shown(word)));
        }
        if self.kind != Kind::Text {
            budget.push(&mut self.values).map_err(|problem| Problem::at(format!("line {line}"), problem))?;
            self.values.push(value.unwrap_or(f64::NAN));
        }
        Ok(())
    }

    /// The array of all words.
    pub(super) fn finish(self) -> Array {
        let Some((line, word)) = self.fault else {
            return Array::new(self.name, self.components, self.values);
        };
        let at = format!("line {line}, column `{}`", self.name);
        let problem = format!("{word} where a number is expected");
        let has_numbers = self.values.iter().any(|value| !value.is_nan());
        Array::faulty(self.name, Fault { at, problem }, has_numbers)
    }
}

/// The words of all `columns` in `line`.
pub(super) fn push_line(
    columns: &mut [Column],
    line: &[u8],
    number: usize,
    budget: &Budget,
) -> Result<(), Problem> {
    let mut given = words(line);
    for column in &mut *columns {
        for _ in 0..column.components {
            let Some(word) = given.next() else { return Err(unfit(columns, line, number)) };
            column.push(word, number, budget)?;
        }
    }
    if given.next().is_some() { Err(unfit(columns, line, number)) } else { Ok(()) }
}

/// Says that the line has not as many words as there are columns.
#[cold]
fn unfit(columns: &[Column], line: &[u8], number: usize) -> Problem {
    let want: usize = columns.iter().map(|column| column.components).sum();
    let have = crate::io::error::counted(words(line).count(), "word");
    Problem::at(format!("line {number}"), format!("{have} where {want} are expected"))
}

/// What a word says that is true or false.
fn truth(word: &[u8]) -> Option<f64> {
    let is = |spellings: [&str; 3]| spellings.iter().any(|known| word.eq_ignore_ascii_case(known.as_bytes()));
    if is(["t", "true", "1"]) {
        return Some(1.0);
    }
    is(["f", "false", "0"]).then_some(0.0)
}
