//! A place in a legacy VTK file: words with blanks or line ends between.

use super::budget::Budget;
use crate::io::error::{Parsed, Problem, shown};
use crate::io::numbers::Stored;

/// Where reading stands.
pub(super) struct Cursor<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
    /// Whether numbers are text.
    pub ascii: bool,
    /// How many numbers a tuple of the array has that was read last.
    pub components: usize,
    pub budget: Budget,
}

/// The words that start a block.
const KEYWORDS: [&str; 27] = [
    "DATASET",
    "DIMENSIONS",
    "ORIGIN",
    "SPACING",
    "ASPECT_RATIO",
    "POINTS",
    "CELLS",
    "VERTICES",
    "LINES",
    "POLYGONS",
    "TRIANGLE_STRIPS",
    "CELL_TYPES",
    "POINT_DATA",
    "CELL_DATA",
    "FIELD",
    "LOOKUP_TABLE",
    "SCALARS",
    "COLOR_SCALARS",
    "TEXTURE_COORDINATES",
    "VECTORS",
    "NORMALS",
    "TENSORS",
    "TENSORS6",
    "GLOBAL_IDS",
    "PEDIGREE_IDS",
    "EDGE_FLAGS",
    "METADATA",
];

/// Where a word stands, in bytes from the file's start.
#[derive(Clone, Copy)]
pub(super) struct Place(usize);

/// A type of numbers by VTK's legacy name, or text.
pub(super) enum Kind {
    Numbers(Stored),
    Text,
}

impl Kind {
    /// The type called `name`; `vtkIdType` is written with 32 bits.
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(Self::Numbers(match name.to_ascii_lowercase().as_str() {
            "bit" => Stored::Bit,
            "char" | "signed_char" | "vtktypeint8" => Stored::I8,
            "unsigned_char" | "vtktypeuint8" => Stored::U8,
            "short" | "vtktypeint16" => Stored::I16,
            "unsigned_short" | "vtktypeuint16" => Stored::U16,
            "int" | "vtkidtype" | "vtktypeint32" => Stored::I32,
            "unsigned_int" | "vtktypeuint32" => Stored::U32,
            "long" | "vtktypeint64" => Stored::I64,
            "unsigned_long" | "vtktypeuint64" => Stored::U64,
            "float" => Stored::F32,
            "double" => Stored::F64,
            "string" | "utf8_string" => return Some(Self::Text),
            _ => return None,
        }))
    }
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, ascii: true, components: 0, budget: Budget::of_file(bytes.len() as u64) }
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Where the next word stands, for messages.
    pub(super) fn place(&self) -> Place {
        Place(self.at + self.rest().len() - self.rest().trim_ascii_start().len())
    }

    /// A problem of the word at `place`: its line where numbers are text, else its byte.
    pub(super) fn problem(&self, Place(at): Place, problem: impl Into<String>) -> Problem {
        let before = &self.bytes[..at.min(self.bytes.len())];
        let place = if self.ascii {
            format!("line {}", memchr::memchr_iter(b'\n', before).count() + 1)
        } else {
            format!("byte {at}")
        };
        Problem::at(place, problem)
    }

    /// The rest of the line, without blanks around it; `None` at the end of the file.
    pub(super) fn line(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest();
        if rest.is_empty() {
            return None;
        }
        let end = memchr::memchr(b'\n', rest);
        self.at += end.map_or(rest.len(), |end| end + 1);
        Some(rest[..end.unwrap_or(rest.len())].trim_ascii())
    }

    /// The next word; `None` at the end of the file.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        let Place(start) = self.place();
        let rest = self.bytes.get(start..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at = start + length;
        Some(&rest[..length])
    }

    /// The next word behind blocks of metadata, which end with a blank line.
    pub(super) fn word_behind_metadata(&mut self) -> Option<&'a [u8]> {
        loop {
            let Place(start) = self.place();
            self.at = start;
            if !self.is_line(b"METADATA") {
                return self.word();
            }
            self.line();
            self.skip_metadata();
        }
    }

    /// Whether nothing but `word` and blanks is left of the line. Looks no further than it must: a line may be the whole file.
    fn is_line(&self, word: &[u8]) -> bool {
        let Some((start, rest)) = self.rest().split_at_checked(word.len()) else { return false };
        let behind = rest.iter().find(|&&byte| byte == b'\n' || !byte.is_ascii_whitespace());
        start.eq_ignore_ascii_case(word) && behind.is_none_or(|&byte| byte == b'\n')
    }

    /// The next word as text, for a name or a type; `what` says what it is.
    pub(super) fn text(&mut self, what: &str) -> Parsed<&'a str> {
        let place = self.place();
        let word =
            self.word().ok_or_else(|| self.problem(place, format!("cut short where {what} is expected")))?;
        std::str::from_utf8(word)
            .map_err(|_| self.problem(place, format!("{} where {what} is expected", shown(word))))
    }

    /// The next word as a number of type `N`; `what` says of what.
    pub(super) fn number<N: std::str::FromStr>(&mut self, what: &str) -> Parsed<N> {
        let place = self.place();
        let word = self.text(what)?;
        word.parse()
            .map_err(|_| self.problem(place, format!("{} where {what} is expected", shown(word.as_bytes()))))
    }

    /// The next word as a type of numbers.
    pub(super) fn kind(&mut self, of: &str) -> Parsed<Kind> {
        let place = self.place();
        let word = self.text("a type of numbers")?;
        Kind::named(word).ok_or_else(|| {
            self.problem(
                place,
                format!("{of}: {} where a type of numbers is expected", shown(word.as_bytes())),
            )
        })
    }

    /// Passes over the next word if it is `keyword`.
    pub(super) fn skip_keyword(&mut self, keyword: &str) -> bool {
        let before = self.at;
        let is_there = self.word().is_some_and(|word| word.eq_ignore_ascii_case(keyword.as_bytes()));
        if !is_there {
            self.at = before;
        }
        is_there
    }

    /// The number of components of `SCALARS` and the name of its look-up table, both of which may be missing. A number
    /// counts components where it stands on the same line, or before the table.
    pub(super) fn scalars(&mut self) -> Parsed<usize> {
        const TABLE: &str = "LOOKUP_TABLE";
        let before = self.at;
        let mut components = 1;
        let count = self.word().and_then(|word| std::str::from_utf8(word).ok()?.parse().ok());
        let is_same_line = !self.bytes[before..self.at].contains(&b'\n');
        let behind = self.at;
        match count {
            Some(count) if is_same_line || self.skip_keyword(TABLE) => {
                (components, self.at) = (count, behind)
            }
            _ => self.at = before,
        }
        if self.skip_keyword(TABLE) {
            self.text("the name of a look-up table")?;
        }
        Ok(components)
    }

    /// Passes over metadata to the blank line behind them. The components' names have a line each, blank or not.
    fn skip_metadata(&mut self) {
        while let Some(line) = self.line().filter(|line| !line.is_empty()) {
            if line.eq_ignore_ascii_case(b"COMPONENT_NAMES") {
                for _ in 0..self.components {
                    if self.line().is_none() {
                        return;
                    }
                }
            }
        }
    }
}

/// Whether `word` starts a block.
pub(super) fn is_keyword(word: &[u8]) -> bool {
    KEYWORDS.iter().any(|keyword| word.eq_ignore_ascii_case(keyword.as_bytes()))
}

/// A name as legacy VTK writes it, where `%20` stands for a blank.
pub(super) fn decoded(name: &str) -> String {
    let mut bytes = Vec::with_capacity(name.len());
    let mut rest = name.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let digit = |at: usize| tail.get(at).and_then(|&digit| char::from(digit).to_digit(16));
        let code = digit(0).zip(digit(1)).filter(|_| first == b'%');
        match code.and_then(|(high, low)| u8::try_from(16 * high + low).ok()) {
            Some(byte) => (bytes.push(byte), rest = &tail[2..]),
            None => (bytes.push(first), rest = tail),
        };
    }
    String::from_utf8(bytes).unwrap_or_else(|_| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_decoded() {
        assert_eq!(decoded("a%20b%25%e"), "a b%%e");
        assert_eq!(decoded("%C3%A9%"), "é%");
        assert_eq!(decoded("%FF"), "%FF");
        assert_eq!(decoded("%+1"), "%+1");
    }
}
