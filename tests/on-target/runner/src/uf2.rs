//! Firmware as a file to be dropped on a Raspberry Pi Pico: UF2, blocks of 512 bytes with 256 of flash in each.

use anyhow::{Context, Result, bail};
use object::read::elf::{FileHeader, ProgramHeader};
use object::{Endianness, elf};
use std::collections::BTreeMap;
use std::path::Path;

const PAGE: u32 = 256;
/// The RP2040's number among the families of chips.
const RP2040: u32 = 0xe48b_ff56;

/// Reads an ELF file and gives the blocks.
pub(crate) fn of_elf(path: &Path) -> Result<Vec<u8>> {
    let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
    let pages = pages(&bytes)?;
    let count = u32::try_from(pages.len())?;
    let mut blocks = Vec::new();
    for (number, (address, page)) in (0..).zip(&pages) {
        // the flags say that there is a family
        let head =
            [0x0a32_4655, 0x9e5d_5157, 0x2000, *address, PAGE, number, count, RP2040].map(u32::to_le_bytes);
        blocks.extend(head.as_flattened());
        blocks.extend(page);
        blocks.resize(blocks.len() + 512 - 32 - 4 - page.len(), 0);
        blocks.extend(0x0ab1_6f30_u32.to_le_bytes());
    }
    Ok(blocks)
}

/// What is loaded, by the addresses of its pages; a page that is not full ends with zeros.
fn pages(bytes: &[u8]) -> Result<BTreeMap<u32, [u8; PAGE as usize]>> {
    let file = elf::FileHeader32::<Endianness>::parse(bytes)?;
    let endian = file.endian()?;
    let mut pages = BTreeMap::new();
    for segment in file.program_headers(endian, bytes)? {
        let Ok(data) = segment.data(endian, bytes) else { bail!("a segment lies outside the file") };
        if segment.p_type(endian) != elf::PT_LOAD {
            continue;
        }
        for (address, byte) in (segment.p_paddr(endian)..).zip(data) {
            let page = pages.entry(address / PAGE * PAGE).or_insert([0; PAGE as usize]);
            page[(address % PAGE) as usize] = *byte;
        }
    }
    Ok(pages)
}
