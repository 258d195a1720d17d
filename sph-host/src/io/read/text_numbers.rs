//! Numbers written as text with blanks between: what is no number is a fault of their array, not of the file.

use super::budget::Budget;
use crate::io::error::{Parsed, counted, shown};
use crate::io::numbers;
use crate::io::table::{Array, Fault, Unusable};

/// The numbers of one array while they are read.
pub(super) struct TextNumbers {
    /// One for each word so far; NaN for what is no number.
    values: Vec<f64>,
    /// How many there are to be.
    count: usize,
    /// The first word that is no number, with its index.
    odd: Option<(usize, String)>,
    /// How many words there were.
    words: usize,
    /// Why not all are kept: there is no memory.
    full: Option<String>,
}

impl TextNumbers {
    /// `count` numbers to come.
    pub(super) fn new(count: usize) -> Self {
        Self { values: Vec::new(), count, odd: None, words: 0, full: None }
    }

    /// Whether all are there.
    pub(super) fn is_full(&self) -> bool {
        self.words >= self.count
    }

    /// Takes the next word, and keeps its number while there is room.
    pub(super) fn push(&mut self, word: &[u8], budget: &Budget) {
        self.words += 1;
        if self.full.is_some() {
            return;
        }
        if let Err(problem) = budget.push(&mut self.values) {
            self.full = Some(problem);
            return;
        }
        let value = numbers::parse(word);
        if value.is_none() && self.odd.is_none() {
            self.odd = Some((self.values.len(), shown(word)));
        }
        self.values.push(value.unwrap_or(f64::NAN));
    }

    /// The array `name` of these numbers; `first` is the number of its first point.
    pub(super) fn into_array(self, name: String, components: usize, first: usize) -> Array {
        if let Some(problem) = self.full {
            return Array::unusable(name, Unusable::numbers(problem));
        }
        if let Some((index, word)) = self.odd {
            let point = first + index / components.max(1);
            let at = format!("array `{name}`, point {point}");
            let problem = format!("{word} where a number is expected");
            let has_numbers = self.values.iter().any(|value| !value.is_nan());
            return Array::faulty(name, Fault { at, problem }, has_numbers);
        }
        if self.values.len() < self.count {
            let problem = format!("it ends after {} of {}", self.values.len(), counted(self.count, "number"));
            return Array::unusable(name, Unusable::numbers(problem));
        }
        Array::new(name, components, self.values)
    }
}

/// The numbers of an array that must be usable.
pub(super) fn required(array: Array) -> Parsed<Vec<f64>> {
    array.usable()?;
    Ok(array.values)
}
