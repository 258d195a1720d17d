//! Numbers of any stored type, as `f64`.

use half::f16;

/// How a number is stored in a binary file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stored {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F16,
    F32,
    F64,
    /// One bit each, the first in the highest bit of a byte.
    Bit,
}

/// The order of a number's bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Endian {
    Little,
    Big,
}

/// Calls the macro `$each` with the type of a stored number and the function that makes `f64` of it, or does what is to be done for bits.
macro_rules! with_stored {
    ($stored:expr, $each:ident, $bits:block) => {
        match $stored {
            Self::I8 => $each!(i8, f64::from),
            Self::U8 => $each!(u8, f64::from),
            Self::I16 => $each!(i16, f64::from),
            Self::U16 => $each!(u16, f64::from),
            Self::I32 => $each!(i32, f64::from),
            Self::U32 => $each!(u32, f64::from),
            Self::I64 => $each!(i64, |v| v as f64),
            Self::U64 => $each!(u64, |v| v as f64),
            Self::F16 => $each!(f16, f64::from),
            Self::F32 => $each!(f32, f64::from),
            Self::F64 => $each!(f64, |v| v),
            Self::Bit => $bits,
        }
    };
}

impl Stored {
    /// The bytes that `count` numbers take; `None` when that is beyond what can be addressed.
    pub(super) fn bytes(self, count: usize) -> Option<usize> {
        let size = match self {
            Self::Bit => return Some(count.div_ceil(8)),
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 | Self::F16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        };
        count.checked_mul(size)
    }

    /// Appends the first `count` numbers of `bytes` to `out`; 64-bit integers beyond 2⁵³ are rounded.
    pub(super) fn decode(self, bytes: &[u8], endian: Endian, count: usize, out: &mut Vec<f64>) {
        macro_rules! each {
            ($type:ty, $value:expr) => {{
                let read = match endian {
                    Endian::Little => <$type>::from_le_bytes,
                    Endian::Big => <$type>::from_be_bytes,
                };
                let (chunks, _) = bytes.as_chunks();
                out.extend(chunks.iter().take(count).map(|chunk| $value(read(*chunk))))
            }};
        }
        with_stored!(self, each, {
            let bits = bytes.iter().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1));
            out.extend(bits.take(count).map(f64::from));
        });
    }

    /// Appends `components` numbers that stand at byte `offset` of each record of `length` bytes; bits do not stand so.
    pub(super) fn gather(
        self,
        records: &[u8],
        place: (usize, usize),
        endian: Endian,
        components: usize,
        out: &mut Vec<f64>,
    ) {
        macro_rules! each {
            ($type:ty, $value:expr) => {
                match endian {
                    Endian::Little => {
                        gather(records, place, components, out, |bytes| $value(<$type>::from_le_bytes(bytes)))
                    }
                    Endian::Big => {
                        gather(records, place, components, out, |bytes| $value(<$type>::from_be_bytes(bytes)))
                    }
                }
            };
        }
        with_stored!(self, each, {});
    }
}

/// Appends `components` numbers at byte `offset` of each record of `length` bytes.
fn gather<const N: usize>(
    records: &[u8],
    (length, offset): (usize, usize),
    components: usize,
    out: &mut Vec<f64>,
    value: impl Fn([u8; N]) -> f64,
) {
    let records = records.chunks_exact(length).map(|record| record.get(offset..).unwrap_or_default());
    if components == 1 {
        // One number a record, which every record has, is faster without a loop over its numbers.
        let number = |record: &[u8]| record.first_chunk().map_or(f64::NAN, |&bytes| value(bytes));
        return out.extend(records.map(number));
    }
    for record in records {
        let (numbers, _) = record.as_chunks();
        out.extend(numbers.iter().take(components).map(|&bytes| value(bytes)));
    }
}

/// The number that `text` spells in full, correctly rounded: decimal with an optional exponent, or one of the spellings
/// of NaN and infinity that C, C++ and Fortran programs print.
pub(super) fn parse(text: &[u8]) -> Option<f64> {
    fast_float2::parse(text).ok().or_else(|| not_finite(text))
}

/// As [`parse`], of a number that may have a comma where others have a point.
pub(super) fn parse_with_comma(text: &[u8]) -> Option<f64> {
    let Some(comma) = memchr::memchr(b',', text) else { return parse(text) };
    let mut with_point = text.to_vec();
    with_point[comma] = b'.';
    parse(&with_point)
}

/// NaN and infinity as C libraries print them beyond `nan` and `inf`: `nan(ind)`, `nan(0x7ff)`, and Microsoft's former
/// `1.#QNAN`, `1.#SNAN`, `1.#IND`, `1.#INF`, with zeros behind, or rounded to `1.#J` and `1.#R`.
#[cold]
fn not_finite(text: &[u8]) -> Option<f64> {
    let (is_negative, word) = match text.split_first()? {
        (b'-', rest) => (true, rest),
        (b'+', rest) => (false, rest),
        _ => (false, text),
    };
    let starts = |start: &[u8]| word.get(..start.len()).is_some_and(|word| word.eq_ignore_ascii_case(start));
    if starts(b"nan(") {
        let inside = word[4..].strip_suffix(b")")?;
        return inside.iter().all(|&byte| byte.is_ascii_alphanumeric() || byte == b'_').then_some(f64::NAN);
    }
    let mut word = word.strip_prefix(b"1.#")?;
    while let Some(shorter) = word.strip_suffix(b"0") {
        word = shorter;
    }
    match word {
        b"INF" if is_negative => Some(f64::NEG_INFINITY),
        b"INF" => Some(f64::INFINITY),
        b"QNAN" | b"SNAN" | b"IND" | b"J" | b"R" => Some(f64::NAN),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(stored: Stored, bytes: &[u8], endian: Endian, count: usize) -> Vec<f64> {
        let mut out = Vec::new();
        stored.decode(bytes, endian, count, &mut out);
        out
    }

    #[test]
    fn both_orders_of_bytes() {
        assert_eq!(decoded(Stored::I16, &[0xfe, 0xff, 1, 0], Endian::Little, 2), [-2.0, 1.0]);
        assert_eq!(decoded(Stored::I16, &[0xff, 0xfe, 0, 1], Endian::Big, 2), [-2.0, 1.0]);
        assert_eq!(decoded(Stored::F64, &(-0.1f64).to_be_bytes(), Endian::Big, 1), [-0.1]);
        assert_eq!(decoded(Stored::F16, &[0x00, 0x3e], Endian::Little, 1), [1.5]);
        assert_eq!(
            decoded(Stored::U64, &u64::MAX.to_le_bytes(), Endian::Little, 1),
            [18446744073709551616.0]
        );
    }

    #[test]
    fn bits_start_at_the_highest() {
        let bits = decoded(Stored::Bit, &[0b1010_0000, 0b1000_0000], Endian::Big, 9);
        assert_eq!(bits, [1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        assert_eq!(Stored::Bit.bytes(9), Some(2));
        assert_eq!(Stored::F64.bytes(usize::MAX), None);
    }

    #[test]
    fn a_comma_may_stand_for_the_point() {
        assert_eq!(parse_with_comma(b"-1,5e3"), Some(-1500.0));
        assert_eq!(parse_with_comma(b"1.5"), Some(1.5));
        for text in ["1.000,5", "1,000,5", ",", "1,5,"] {
            assert_eq!(parse_with_comma(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn what_is_a_number() {
        for (text, value) in
            [("1e5", 1e5), ("+1", 1.0), ("1.", 1.0), (".5", 0.5), ("-0", 0.0), ("1E-3", 1e-3)]
        {
            assert_eq!(parse(text.as_bytes()), Some(value), "{text}");
        }
        assert_eq!(parse(b"INF"), Some(f64::INFINITY));
        assert!(parse(b"NaN").is_some_and(f64::is_nan));
        assert!(parse(b"-nan(ind)").is_some_and(f64::is_nan));
        assert_eq!(parse(b"-1.#INF00"), Some(f64::NEG_INFINITY));
        for text in
            ["-", "nan(", "1.#", "1.#X", "", "1,5", "0x10", "1e", "e5", ".", "+", "1 2", "1_000", "--1", "1f"]
        {
            assert_eq!(parse(text.as_bytes()), None, "{text}");
        }
    }
}
