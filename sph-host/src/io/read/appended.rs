//! The bytes of a VTK XML array: base64 or raw, plain or in packed blocks, behind a header of sizes.
//!
//! Plain: one size, then the bytes. Compressed: the number of blocks, the size of a block, that of the last one if it
//! is shorter (else 0), the packed size of each, then the blocks. Source: *VTK File Formats*, docs.vtk.org.

use super::budget::MOST_PACKED;
use super::packer::Packer;
use crate::io::numbers::Endian;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::borrow::Cow;

/// How a file packs its arrays.
#[derive(Debug, Clone, Copy)]
pub(super) struct Packing {
    pub endian: Endian,
    /// Whether sizes have 8 bytes, else 4.
    pub wide: bool,
    /// What packs blocks, if they are packed.
    pub packer: Option<Packer>,
}

impl Packing {
    /// The `want` bytes of an array out of `data`, which starts with its header and may go on behind it.
    pub(super) fn unpack<'a>(self, data: &'a [u8], want: usize) -> Result<Cow<'a, [u8]>, String> {
        let (first, rest) = self.size(data)?;
        if let Some(packer) = self.packer {
            return self.blocks(packer, first, rest, want).map(Cow::Owned);
        }
        if first != want {
            return Err(format!("{first} bytes, where {want} are expected"));
        }
        let bytes =
            rest.get(..want).ok_or_else(|| format!("cut short: {} of {want} bytes are there", rest.len()))?;
        Ok(Cow::Borrowed(bytes))
    }

    /// Takes one size of the header.
    fn size(self, data: &[u8]) -> Result<(usize, &[u8]), String> {
        let width = if self.wide { 8 } else { 4 };
        let (bytes, rest) = data.split_at_checked(width).ok_or("cut short in its header of sizes")?;
        let join = |all: u64, &byte: &u8| all << 8 | u64::from(byte);
        let size = match self.endian {
            Endian::Big => bytes.iter().fold(0, join),
            Endian::Little => bytes.iter().rev().fold(0, join),
        };
        Ok((usize::try_from(size).map_err(|_| format!("a size of {size} bytes"))?, rest))
    }

    fn blocks(self, packer: Packer, blocks: usize, header: &[u8], want: usize) -> Result<Vec<u8>, String> {
        let (block, header) = self.size(header)?;
        let (last, header) = self.size(header)?;
        let width = if self.wide { 8 } else { 4 };
        let sizes = blocks.checked_mul(width).and_then(|bytes| header.split_at_checked(bytes));
        let (mut sizes, mut data) =
            sizes.ok_or_else(|| format!("cut short: {blocks} packed blocks are claimed"))?;
        let last = if last == 0 { block } else { last };
        let full = blocks.saturating_sub(1).checked_mul(block);
        let total = if blocks == 0 { Some(0) } else { full.and_then(|full| full.checked_add(last)) };
        if total != Some(want) {
            return Err(format!(
                "{blocks} blocks of {block} bytes, the last of {last}, where {want} are expected"
            ));
        }
        let mut out = Vec::with_capacity(want.min(data.len().saturating_mul(MOST_PACKED as usize)));
        for index in 0..blocks {
            let packed;
            (packed, sizes) = self.size(sizes)?;
            let (bytes, rest) = data.split_at_checked(packed).ok_or_else(|| {
                format!("cut short: block {index} of {blocks} has {} of {packed} bytes", data.len())
            })?;
            data = rest;
            let size = if index + 1 == blocks { last } else { block };
            packer
                .unpack(bytes, size, &mut out)
                .map_err(|problem| format!("block {index} of {blocks} {problem}"))?;
        }
        Ok(out)
    }
}

/// Bytes from base64, which may be wrapped, and padded in its midst: the header is often coded apart from the data.
pub(super) fn from_base64(text: &[u8]) -> Result<Vec<u8>, String> {
    let joined: Cow<'_, [u8]> = if text.iter().any(u8::is_ascii_whitespace) {
        Cow::Owned(text.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect())
    } else {
        Cow::Borrowed(text)
    };
    let mut bytes = Vec::with_capacity(joined.len() / 4 * 3);
    let mut rest = &joined[..];
    while !rest.is_empty() {
        let padding = memchr::memchr(b'=', rest).unwrap_or(rest.len());
        let (part, tail) = rest.split_at(rest.len().min((padding / 4 + 1) * 4));
        STANDARD.decode_vec(part, &mut bytes).map_err(|error| format!("not base64: {error}"))?;
        rest = tail;
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    fn zlib(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    }

    #[test]
    fn base64_with_padding_in_its_midst() {
        assert_eq!(from_base64(b"AQ==AgM=\n BAUG").unwrap(), [1, 2, 3, 4, 5, 6]);
        for wrong in ["A", "AQ=", "A$==", "=", "AQ==="] {
            assert!(from_base64(wrong.as_bytes()).is_err(), "{wrong}");
        }
    }

    #[test]
    fn blocks_in_either_order_and_width() {
        let data: Vec<u8> = (0..10).collect();
        let parts = [zlib(&data[..4]), zlib(&data[4..8]), zlib(&data[8..])];
        for (endian, wide) in
            [(Endian::Little, false), (Endian::Big, true), (Endian::Big, false), (Endian::Little, true)]
        {
            let mut bytes = Vec::new();
            for size in [3, 4, 2].into_iter().chain(parts.iter().map(Vec::len)) {
                let size = (size as u64).to_be_bytes();
                let mut size = size[if wide { 0 } else { 4 }..].to_vec();
                if endian == Endian::Little {
                    size.reverse();
                }
                bytes.extend(size);
            }
            bytes.extend(parts.concat());
            let packing = Packing { endian, wide, packer: Some(Packer::Zlib) };
            assert_eq!(&*packing.unpack(&bytes, 10).unwrap(), &data[..]);
            assert!(packing.unpack(&bytes, 11).is_err());
            for cut in 0..bytes.len() {
                assert!(packing.unpack(&bytes[..cut], 10).is_err(), "{cut}");
            }
        }
    }

    #[test]
    fn claims_are_not_believed() {
        let plain = Packing { endian: Endian::Little, wide: true, packer: None };
        for packer in [Packer::Zlib, Packer::Lz4, Packer::Xz] {
            let packing = Packing { packer: Some(packer), ..plain };
            assert!(packing.unpack(&[0xff; 64], usize::MAX).is_err());
            // One block of 2⁴⁰ bytes in a few.
            let sizes = [1, 1 << 40, 0, 8_u64].map(u64::to_le_bytes).concat();
            assert!(packing.unpack(&[&sizes[..], &[0; 8]].concat(), 1 << 40).is_err());
        }
        assert!(plain.unpack(&[0xff; 64], usize::MAX).is_err());
        assert!(plain.unpack(&[8, 0, 0, 0, 0, 0, 0, 0, 1], 8).is_err());
    }
}
