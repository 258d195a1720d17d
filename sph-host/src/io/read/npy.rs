//! One array of NumPy: the header of a `.npy` file and what it says of the bytes behind it.
//!
//! The format is NumPy's NEP 1: a magic word, a version, the header's length, and a literal of a Python dictionary
//! with the keys `descr`, `fortran_order` and `shape`.

use super::budget::{Budget, MOST_DIMENSIONS, MOST_HEADER};
use super::literal::Literal;
use crate::io::error::{counted, shown};
use crate::io::numbers::{Endian, Stored};
use std::io::Read;

/// What the header of a `.npy` file says.
#[derive(Debug, PartialEq)]
pub(super) struct Header {
    /// The type as NumPy spells it.
    pub descr: String,
    /// The fields of records, each a name and a type, if the values are such.
    pub fields: Option<Literal>,
    pub fortran_order: bool,
    pub shape: Vec<usize>,
}

impl Header {
    /// The header, and the bytes behind it.
    pub(super) fn split(mut file: &[u8]) -> Result<(Self, &[u8]), String> {
        let header = Self::read(&mut file)?;
        Ok((header, file))
    }

    /// The header, from a reader that then stands at the bytes behind it.
    pub(super) fn read(input: &mut impl Read) -> Result<Self, String> {
        let wrong = || "not an array of NumPy, or cut short".to_owned();
        let mut start = [0; 8];
        input.read_exact(&mut start).map_err(|_| wrong())?;
        let [magic @ .., major, _minor] = start;
        if magic != *b"\x93NUMPY" {
            return Err(wrong());
        }
        let mut length = [0; 4];
        let bytes = if major == 1 { 2 } else { 4 };
        input.read_exact(&mut length[..bytes]).map_err(|_| wrong())?;
        let length = u64::from(u32::from_le_bytes(length));
        if length > MOST_HEADER {
            return Err(format!("a header of {length} bytes, where at most {MOST_HEADER} are read"));
        }
        let mut text = Vec::new();
        if !input.take(length).read_to_end(&mut text).is_ok_and(|found| found as u64 == length) {
            return Err(wrong());
        }
        let header = std::str::from_utf8(&text).ok().and_then(Self::parse);
        let header = header.ok_or_else(|| format!("the header {} is not one of NumPy", shown(&text)))?;
        let dimensions = header.shape.len();
        if dimensions > MOST_DIMENSIONS {
            return Err(format!("{dimensions} dimensions, where at most {MOST_DIMENSIONS} are read"));
        }
        Ok(header)
    }

    fn parse(text: &str) -> Option<Self> {
        let header = Literal::parse(text)?;
        let (descr, fields) = match header.get("descr")? {
            Literal::Text(name) => (name.clone(), None),
            fields => ("of several fields".to_owned(), Some(fields.clone())),
        };
        let &Literal::Truth(fortran_order) = header.get("fortran_order")? else { return None };
        let shape = header.get("shape")?.numbers()?;
        Some(Self { descr, fields, fortran_order, shape })
    }

    /// How the numbers are stored, `None` if they are no real numbers.
    pub(super) fn stored(&self) -> Option<(Stored, Endian)> {
        stored(&self.descr)
    }

    /// Says why there are no numbers.
    pub(super) fn refusal(&self) -> String {
        if self.fields.is_none() {
            return format!("values of type {} where numbers are expected", self.descr);
        }
        "records of several fields, where numbers are expected: each field is to be an array of its own"
            .to_owned()
    }

    /// The numbers in C order, whose bytes are `data`.
    pub(super) fn numbers(
        &self,
        (stored, endian): (Stored, Endian),
        data: &[u8],
        budget: &Budget,
    ) -> Result<Vec<f64>, String> {
        let count = self.shape.iter().try_fold(1usize, |product, &length| product.checked_mul(length));
        let want = count.and_then(|count| Some((count, stored.bytes(count)?)));
        let Some((count, _)) = want.filter(|&(_, bytes)| bytes == data.len()) else {
            let found = counted(data.len(), "byte");
            return Err(format!("{found} for the shape {:?} of {}", self.shape, self.descr));
        };
        let mut values = budget.numbers(count)?;
        stored.decode(data, endian, count, &mut values);
        if self.fortran_order && self.shape.len() > 1 {
            return Ok(self.transposed(&values, budget.numbers(count)?));
        }
        Ok(values)
    }

    /// `values`, whose first index runs fastest, with the last index fastest, in `out`.
    fn transposed(&self, values: &[f64], mut out: Vec<f64>) -> Vec<f64> {
        let mut index = vec![0; self.shape.len()];
        for _ in 0..values.len() {
            let at = index.iter().zip(&self.shape).rev().fold(0, |at, (i, length)| at * length + i);
            out.push(values[at]);
            for (i, &length) in index.iter_mut().zip(&self.shape).rev() {
                *i += 1;
                if *i < length {
                    break;
                }
                *i = 0;
            }
        }
        out
    }
}

/// How numbers of the type that NumPy spells so are stored, `None` if they are no real numbers.
pub(super) fn stored(descr: &str) -> Option<(Stored, Endian)> {
    let (order, kind) = descr.split_at_checked(1)?;
    let endian = match order {
        ">" => Endian::Big,
        "<" | "|" => Endian::Little,
        _ => return None,
    };
    let stored = match kind {
        "b1" | "u1" => Stored::U8,
        "i1" => Stored::I8,
        "i2" => Stored::I16,
        "u2" => Stored::U16,
        "i4" => Stored::I32,
        "u4" => Stored::U32,
        "i8" => Stored::I64,
        "u8" => Stored::U64,
        "f2" => Stored::F16,
        "f4" => Stored::F32,
        "f8" => Stored::F64,
        _ => return None,
    };
    Some((stored, endian))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_of_every_version() {
        let text = "{'descr': '>f4', 'fortran_order': True, 'shape': (2, 3L), }\n";
        let want = Header { descr: ">f4".to_owned(), fields: None, fortran_order: true, shape: vec![2, 3] };
        for version in 1..=3u8 {
            let mut file = b"\x93NUMPY".to_vec();
            file.extend([version, 0]);
            let length = text.len() as u32;
            file.extend(&length.to_le_bytes()[..if version == 1 { 2 } else { 4 }]);
            file.extend(text.as_bytes());
            file.push(7);
            let (header, data) = Header::split(&file).unwrap();
            assert_eq!((&header, data), (&want, &[7u8][..]));
            for cut in 0..file.len() - 1 {
                assert!(Header::split(&file[..cut]).is_err(), "{cut}");
            }
        }
    }

    #[test]
    fn a_header_that_is_too_long_is_called_so() {
        let mut file = b"\x93NUMPY\x02\0".to_vec();
        file.extend(65_537_u32.to_le_bytes());
        assert_eq!(
            Header::split(&file).unwrap_err(),
            "a header of 65537 bytes, where at most 65536 are read"
        );
    }

    #[test]
    fn shapes_that_overflow_are_refused() {
        let header = Header {
            descr: "<f8".to_owned(),
            fields: None,
            fortran_order: false,
            shape: vec![1 << 32, 1 << 32, 2],
        };
        assert!(header.numbers((Stored::F64, Endian::Little), &[], &Budget::of_file(1)).is_err());
        assert!(Header::parse("{'descr': '<f8', 'fortran_order': False, 'shape': (-1,), }").is_none());
    }

    #[test]
    fn fortran_order_is_turned_round() {
        let header =
            Header { descr: "|u1".to_owned(), fields: None, fortran_order: true, shape: vec![2, 3, 2] };
        let bytes: Vec<u8> = (0..12).collect();
        let values = header.numbers((Stored::U8, Endian::Little), &bytes, &Budget::of_file(12)).unwrap();
        // Element (i, j, k) lies at i + 2 j + 6 k.
        assert_eq!(values, [0.0, 6.0, 2.0, 8.0, 4.0, 10.0, 1.0, 7.0, 3.0, 9.0, 5.0, 11.0]);
    }
}
