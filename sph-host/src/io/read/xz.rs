//! One block of LZMA2 in an .xz stream, as VTK packs blocks of arrays.
//!
//! A header of the stream (a magic word, what checksum there is), a header of the block (whose filter is LZMA2 with the size
//! of its dictionary), the packed bytes, zeros up to a multiple of 4, the checksum of the unpacked bytes. The index and
//! the end of the stream say nothing more. Source: *The .xz File Format* 1.2.1, tukaani.org.

use flate2::Crc;
use lzma_rust2::Lzma2Reader;
use std::io::Read;

/// The first bytes of a stream, with the first of its flags.
const MAGIC: &[u8] = b"\xfd7zXZ\0\0";

/// The number that stands for LZMA2.
const LZMA2: u64 = 0x21;

/// What the second flag of a stream says of its checksum.
const NO_CHECKSUM: u8 = 0;
const CRC32: u8 = 1;

/// Dictionaries are no smaller.
const LEAST_DICTIONARY: usize = 4096;

/// Appends what `stream` holds to `out`: `size` bytes, or one more where there are more.
pub(super) fn unpack(stream: &[u8], size: usize, out: &mut Vec<u8>) -> Result<(), String> {
    let start = out.len();
    let (header, rest) = stream.split_at_checked(12).ok_or("the header of the stream is cut short")?;
    let checksum = header[7];
    if !header.starts_with(MAGIC) || crc(&header[6..8]) != header[8..] {
        return Err("no header of an .xz stream".to_owned());
    }
    if checksum != CRC32 && checksum != NO_CHECKSUM {
        return Err(format!("a checksum of type {checksum}, where CRC-32 is expected"));
    }
    let length = 4 * (usize::from(*rest.first().ok_or("there is no block")?) + 1);
    let (header, packed) = rest.split_at_checked(length).ok_or("the header of the block is cut short")?;
    let dictionary = dictionary(header)?;
    // No byte refers further back than to the first, so that a claim of a large dictionary costs nothing.
    let dictionary = dictionary.min(size.max(LEAST_DICTIONARY) as u64);
    let mut left = packed;
    let reader = Lzma2Reader::new(&mut left, dictionary as u32, None);
    reader.take(size as u64 + 1).read_to_end(out).map_err(|error| error.to_string())?;
    let taken = packed.len() - left.len();
    let check = packed.get(taken.next_multiple_of(4)..).and_then(|check| check.get(..4));
    if checksum == CRC32 && check != Some(&crc(&out[start..])) {
        return Err("the checksum does not fit".to_owned());
    }
    Ok(())
}

fn crc(bytes: &[u8]) -> [u8; 4] {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum().to_le_bytes()
}

/// The size of the dictionary in the header of a block, whose only filter is LZMA2.
fn dictionary(header: &[u8]) -> Result<u64, String> {
    let (content, check) = header.split_last_chunk::<4>().ok_or("the header of the block is cut short")?;
    let wrong = || "no header of a block of LZMA2".to_owned();
    if crc(content) != *check {
        return Err(wrong());
    }
    let [_length, flags, rest @ ..] = content else { return Err(wrong()) };
    let mut rest = rest;
    // Two bits say whether the packed and the unpacked size are there; the others that there is one filter.
    for flag in [0x40, 0x80] {
        if flags & flag != 0 {
            integer(&mut rest).ok_or_else(wrong)?;
        }
    }
    let filter = (integer(&mut rest), integer(&mut rest), rest.first());
    match filter {
        (Some(LZMA2), Some(1), Some(&bits @ 0..40)) if flags & 0x3f == 0 => {
            Ok(u64::from(2 | bits & 1) << (bits / 2 + 11))
        }
        (Some(LZMA2), Some(1), Some(40)) if flags & 0x3f == 0 => Ok(u64::from(u32::MAX)),
        _ => Err(wrong()),
    }
}

/// An integer of 7 bits a byte, the lowest first, of which all but the last have the highest bit.
fn integer(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    for shift in (0..63).step_by(7) {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        value |= u64::from(byte & 0x7f) << shift;
        if byte < 0x80 {
            return Some(value);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `smoothed particle ` forty times, packed by xz 5.
    const STREAM: [u8; 88] = [
        253, 55, 122, 88, 90, 0, 0, 1, 105, 34, 222, 54, 2, 0, 33, 1, 22, 0, 0, 0, 116, 47, 229, 163, 224, 2,
        207, 0, 28, 93, 0, 57, 155, 74, 87, 61, 21, 176, 39, 103, 167, 208, 176, 239, 153, 57, 249, 139, 77,
        38, 232, 9, 7, 253, 209, 249, 255, 224, 0, 0, 221, 206, 124, 152, 0, 1, 52, 208, 5, 0, 0, 0, 13, 30,
        149, 226, 62, 48, 13, 139, 2, 0, 0, 0, 0, 1, 89, 90,
    ];

    /// Where the index starts: what is behind says nothing more.
    const INDEX: usize = 64;

    fn want() -> Vec<u8> {
        b"smoothed particle ".repeat(40)
    }

    fn unpacked(stream: &[u8]) -> Result<Vec<u8>, String> {
        let mut out = Vec::new();
        unpack(stream, want().len(), &mut out).map(|()| out)
    }

    #[test]
    fn no_truncation_and_no_flipped_bit_changes_a_byte() {
        assert_eq!(unpacked(&STREAM).unwrap(), want());
        for cut in 0..INDEX {
            assert!(unpacked(&STREAM[..cut]).is_err(), "{cut}");
        }
        let mut seen = 0;
        for bit in 0..8 * STREAM.len() {
            let mut damaged = STREAM;
            damaged[bit / 8] ^= 1 << (bit % 8);
            match unpacked(&damaged) {
                Ok(bytes) => assert!(bytes == want(), "bit {bit}"),
                Err(_) => seen += 1,
            }
        }
        assert!(seen > 8 * (INDEX - 8), "{seen} of {}", 8 * INDEX);
    }

    #[test]
    fn more_than_is_wanted_is_not_unpacked() {
        let mut out = vec![7];
        let found = unpack(&STREAM, 10, &mut out);
        assert!(found.is_err() && out.len() <= 12, "{found:?} {}", out.len());
    }

    #[test]
    fn a_dictionary_of_four_gibibytes_costs_nothing() {
        for (bits, is_right) in [(40, true), (39, true), (0, true), (41, false), (255, false)] {
            let mut stream = STREAM;
            stream[16] = bits;
            let check = crc(&stream[12..20]);
            stream[20..24].copy_from_slice(&check);
            assert_eq!(unpacked(&stream).is_ok(), is_right, "{bits}");
        }
        let checksum_of_another_kind = |kind| {
            let mut stream = STREAM;
            stream[7] = kind;
            let check = crc(&stream[6..8]);
            stream[8..12].copy_from_slice(&check);
            unpacked(&stream)
        };
        assert_eq!(checksum_of_another_kind(0).unwrap(), want());
        assert!(checksum_of_another_kind(4).unwrap_err().contains("type 4, where CRC-32 is expected"));
    }
}
