//! A place in a legacy VTK file: lines of keywords with numbers between them, as text or as bytes.

use super::parse_text;
use crate::io::error::{Parsed, Problem};
use crate::io::numbers::{Endian, Stored};

/// Where reading stands.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether numbers are text.
    pub ascii: bool,
    /// How many numbers a tuple of the array has that was read last.
    pub components: usize,
}

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
        Self { bytes, at: 0, ascii: true, components: 0 }
    }

    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Where the file stands, for messages.
    pub(super) fn place(&self) -> String {
        format!("byte {}", self.at)
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

    /// The words of the next line that is not blank. Blocks of metadata, which end with a blank line, are passed over.
    pub(super) fn words(&mut self) -> Parsed<Option<Vec<&'a str>>> {
        loop {
            self.at += self.rest().len() - self.rest().trim_ascii_start().len();
            let place = self.place();
            let Some(line) = self.line() else { return Ok(None) };
            if line.eq_ignore_ascii_case(b"METADATA") {
                self.skip_metadata();
                continue;
            }
            // A line of keywords is short: this is data where none is expected.
            let text = (line.len() < 4096).then(|| std::str::from_utf8(line).ok()).flatten();
            let text = text.ok_or_else(|| Problem::at(place, "a line of keywords is expected"))?;
            return Ok(Some(text.split_ascii_whitespace().collect()));
        }
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

    /// Passes over the next line if it starts with `keyword`.
    pub(super) fn skip_line(&mut self, keyword: &[u8]) {
        let blank = self.rest().len() - self.rest().trim_ascii_start().len();
        let line = &self.rest()[blank..];
        if line.get(..keyword.len()).is_some_and(|start| start.eq_ignore_ascii_case(keyword)) {
            self.at += blank;
            self.line();
        }
    }

    /// `count` numbers, of which nothing is believed before they are there; `what` names them in messages.
    pub(super) fn numbers(&mut self, what: &str, stored: Stored, count: usize) -> Parsed<Vec<f64>> {
        let left = self.rest();
        // As text a number takes a digit and a blank.
        let need = if self.ascii {
            count.checked_mul(2).map(|bytes| bytes.saturating_sub(1))
        } else {
            stored.bytes(count)
        };
        let Some(need) = need.filter(|&need| need <= left.len()) else {
            let problem = format!("{count} numbers are claimed, but only {} bytes follow", left.len());
            return Err(Problem::at(what, problem));
        };
        let mut values = Vec::with_capacity(count);
        if !self.ascii {
            stored.decode(&left[..need], Endian::Big, count, &mut values);
            self.at += need;
            return Ok(values);
        }
        let mut end = 0;
        let mut words = std::iter::from_fn(|| {
            let start = end + left[end..].iter().position(|byte| !byte.is_ascii_whitespace())?;
            let length = left[start..].iter().position(u8::is_ascii_whitespace);
            end = length.map_or(left.len(), |length| start + length);
            Some(&left[start..end])
        });
        parse_text(what, &mut words, count, &mut values)?;
        self.at += end;
        Ok(values)
    }

    /// Passes over `count` texts: a line each, or bytes behind their length.
    pub(super) fn skip_texts(&mut self, what: &str, count: usize) -> Parsed<()> {
        for index in 0..count {
            let there = if self.ascii { self.line().is_some() } else { self.skip_text().is_some() };
            if !there {
                return Err(Problem::at(what, format!("ends after {index} of {count} texts")));
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

    #[test]
    fn texts_are_passed_over() {
        let mut bytes = vec![0xc2, b'a', b'b', 0x80, 70];
        bytes.extend([b'x'; 70]);
        bytes.extend([0x40, 0, 0, 1, b'y', 0, 0, 0, 0, 0, 0, 0, 1, b'z', b'!']);
        let mut cursor = Cursor::new(&bytes);
        cursor.ascii = false;
        cursor.skip_texts("a", 4).unwrap();
        assert_eq!(cursor.rest(), b"!");
        assert!(cursor.skip_texts("a", 1).is_err());
    }
}
