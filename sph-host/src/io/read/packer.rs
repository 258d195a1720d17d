//! What packs a block of a VTK XML array: zlib, LZ4 or xz.
//!
//! zlib and xz carry a checksum, which is compared; LZ4 has none, so that damage to a number may stay unseen there.

use super::xz;
use flate2::read::ZlibDecoder;
use std::io::Read;

/// LZ4 packs at most so many bytes into one.
const MOST_BY_LZ4: usize = 255;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Packer {
    Zlib,
    /// A block of LZ4 without a frame.
    Lz4,
    /// LZMA2 in an .xz stream.
    Xz,
}

impl Packer {
    /// The names of all, for messages.
    pub(super) const NAMES: &'static str =
        "vtkZLibDataCompressor, vtkLZ4DataCompressor or vtkLZMADataCompressor";

    /// The packer by VTK's name.
    pub(super) fn named(name: &str) -> Option<Self> {
        match name {
            "vtkZLibDataCompressor" => Some(Self::Zlib),
            "vtkLZ4DataCompressor" => Some(Self::Lz4),
            "vtkLZMADataCompressor" => Some(Self::Xz),
            _ => None,
        }
    }

    /// Appends what `packed` holds to `out`, which are to be `size` bytes.
    ///
    /// # Errors
    /// The bytes are damaged or cut short, or hold more or fewer.
    pub(super) fn unpack(self, packed: &[u8], size: usize, out: &mut Vec<u8>) -> Result<(), String> {
        let start = out.len();
        match self {
            // The checksum is compared where the decoder meets the end, so one byte more than there should be is asked for.
            Self::Zlib => {
                let read = ZlibDecoder::new(packed).take(size as u64 + 1).read_to_end(out);
                read.map_err(|error| damaged(&error.to_string()))?;
            }
            Self::Lz4 => lz4(packed, size, out)?,
            Self::Xz => xz::unpack(packed, size, out).map_err(|problem| damaged(&problem))?,
        }
        let found = out.len() - start;
        if found == size {
            return Ok(());
        }
        Err(format!("holds {found} bytes or more, where {size} are expected"))
    }
}

fn damaged(problem: &str) -> String {
    format!("is damaged or cut short: {problem}")
}

fn lz4(packed: &[u8], size: usize, out: &mut Vec<u8>) -> Result<(), String> {
    if size / MOST_BY_LZ4 > packed.len() {
        return Err(format!("has {} packed bytes, which cannot hold {size}", packed.len()));
    }
    let start = out.len();
    out.resize(start + size, 0);
    let found = lz4_flex::block::decompress_into(packed, &mut out[start..]);
    let found = found.map_err(|error| damaged(&error.to_string()))?;
    out.truncate(start + found);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One `a`, 29 more from one byte back, and five `b`.
    const LZ4: [u8; 11] = [0x1f, b'a', 1, 0, 10, 0x50, b'b', b'b', b'b', b'b', b'b'];

    #[test]
    fn a_block_of_lz4() {
        let unpacked = |bytes: &[u8], size| {
            let mut out = vec![b'x'];
            Packer::Lz4.unpack(bytes, size, &mut out).map(|()| out)
        };
        assert_eq!(unpacked(&LZ4, 35).unwrap(), [&b"x"[..], &[b'a'; 30], b"bbbbb"].concat());
        for (size, words) in [(34, "damaged"), (36, "holds 35 bytes or more, where 36 are expected")] {
            let problem = unpacked(&LZ4, size).unwrap_err();
            assert!(problem.contains(words), "{problem}");
        }
        for cut in 0..LZ4.len() {
            assert!(unpacked(&LZ4[..cut], 35).is_err(), "{cut}");
        }
        let problem = unpacked(&LZ4, 1 << 40).unwrap_err();
        assert_eq!(problem, "has 11 packed bytes, which cannot hold 1099511627776");
    }
}
