//! The numbers of a legacy VTK file: words, or bytes behind the end of a line.

use super::legacy_text::{Cursor, Kind, is_keyword};
use super::text_numbers::TextNumbers;
use crate::io::error::{Parsed, Problem, counted};
use crate::io::numbers::{Endian, Stored};
use crate::io::table::{Array, Unusable};

impl<'a> Cursor<'a> {
    /// The array `name` of `tuples` times `components` numbers, of which nothing is believed before they are there. What
    /// is wrong with it is its own fault.
    pub(super) fn array(&mut self, name: String, stored: Stored, components: usize, tuples: usize) -> Array {
        let count = components.saturating_mul(tuples);
        if self.ascii {
            let mut numbers = TextNumbers::new(count);
            while !numbers.is_full()
                && let Some(word) = self.number_word()
            {
                numbers.push(word, &self.budget);
            }
            return numbers.into_array(name, components, 0);
        }
        let bytes = self.bytes_of(stored, count);
        match bytes.and_then(|bytes| Ok((bytes, self.budget.numbers(count)?))) {
            Ok((bytes, mut values)) => {
                stored.decode(bytes, Endian::Big, count, &mut values);
                Array::new(name, components, values)
            }
            Err(problem) => Array::unusable(name, Unusable::numbers(problem)),
        }
    }

    /// Passes over `count` numbers that nobody needs; `what` names them in messages.
    pub(super) fn skip_numbers(&mut self, what: &str, stored: Stored, count: usize) -> Parsed<()> {
        if !self.ascii {
            return self.bytes_of(stored, count).map(drop).map_err(|problem| Problem::at(what, problem));
        }
        for index in 0..count {
            if self.number_word().is_none() {
                let problem = format!("ends after {index} of {}", counted(count, "number"));
                return Err(Problem::at(what, problem));
            }
        }
        Ok(())
    }

    /// The bytes of `count` numbers behind the end of the line.
    fn bytes_of(&mut self, stored: Stored, count: usize) -> Result<&'a [u8], String> {
        self.line();
        let left = self.rest();
        let bytes = stored.bytes(count).and_then(|bytes| left.get(..bytes));
        self.at += bytes.map_or(left.len(), <[u8]>::len);
        bytes.ok_or_else(|| {
            format!(
                "{} are claimed, but only {} follow",
                counted(count, "number"),
                counted(left.len(), "byte")
            )
        })
    }

    /// The next word, unless it starts something else than numbers: the array before it is too short.
    fn number_word(&mut self) -> Option<&'a [u8]> {
        let before = self.at;
        let word = self.word()?;
        let may_be_number = word[0].is_ascii_digit() || b"+-.".contains(&word[0]);
        if !may_be_number && (is_keyword(word) || self.is_before_header()) {
            self.at = before;
            return None;
        }
        Some(word)
    }

    /// Whether two counts and a type follow, as behind the name of an array of a `FIELD`.
    fn is_before_header(&mut self) -> bool {
        let before = self.at;
        let mut text = || std::str::from_utf8(self.word()?).ok();
        let mut count = || text().is_some_and(|word| word.parse::<usize>().is_ok());
        let is_header = count() && count() && text().is_some_and(|word| Kind::named(word).is_some());
        self.at = before;
        is_header
    }

    /// Passes over `count` texts: a line each, or bytes behind their length.
    pub(super) fn skip_texts(&mut self, what: &str, count: usize) -> Parsed<()> {
        self.line();
        for index in 0..count {
            let there = if self.ascii { self.line().is_some() } else { self.skip_text().is_some() };
            if !there {
                return Err(Problem::at(what, format!("ends after {index} of {}", counted(count, "text"))));
            }
        }
        Ok(())
    }

    /// Passes over a text whose length stands before it in 1, 2, 4 or 8 bytes, told apart by the two highest bits.
    fn skip_text(&mut self) -> Option<()> {
        let (&first, _) = self.rest().split_first()?;
        let size = [8, 4, 2, 1][usize::from(first >> 6)];
        let length = self.rest().get(..size)?.iter().fold(0u64, |all, &byte| all << 8 | u64::from(byte));
        let length = usize::try_from(length & (u64::MAX >> (66 - 8 * size))).ok()?;
        let end = self.at.checked_add(size)?.checked_add(length)?;
        self.at = (end <= self.bytes.len()).then_some(end)?;
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_passed_over() {
        let mut bytes = vec![b'\n', 0xc2, b'a', b'b', 0x80, 70];
        bytes.extend([b'x'; 70]);
        bytes.extend([0x40, 0, 0, 1, b'y', 0, 0, 0, 0, 0, 0, 0, 1, b'z', b'!']);
        let mut cursor = Cursor::new(&bytes);
        cursor.ascii = false;
        cursor.skip_texts("a", 4).unwrap();
        assert_eq!(cursor.rest(), b"!");
        assert!(cursor.skip_texts("a", 1).is_err());
    }
}
