//! What an ELF file says about the firmware in it.

use anyhow::{Context, Result};
use object::{Object, ObjectSection, ObjectSymbol};
use std::path::Path;

/// Parts of the names of functions that panic.
const TELLTALE: [&str; 6] =
    ["panic", "unwrap_failed", "expect_failed", "slice_index_fail", "_fail_rt", "begin_unwind"];

/// Whether a function of this name panics.
pub(crate) fn is_panic(name: &str) -> bool {
    TELLTALE.iter().any(|part| name.contains(part))
}

/// Sizes and symbols.
#[derive(Clone, Debug)]
pub(crate) struct Elf {
    /// Code, constants and the initial values of data: what takes flash.
    pub(crate) flash: u64,
    /// Data, initialised or not: what takes RAM, apart from the stack.
    pub(crate) ram: u64,
    /// The RAM that the storage's type promised as a constant.
    pub(crate) promised: u64,
    /// The names of all symbols, demangled.
    pub(crate) symbols: Vec<String>,
}

impl Elf {
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        let file = object::File::parse(&*bytes)?;
        let size = |name| file.section_by_name(name).map_or(0, |section| section.size());
        let promised = file.section_by_name(".ram_promised").context("no RAM is promised")?.data()?;
        let promised = promised.first_chunk().copied().map_or(0, u32::from_le_bytes);
        let symbols = file
            .symbols()
            .filter_map(|symbol| symbol.name().ok())
            .map(|name| format!("{:#}", rustc_demangle::demangle(name)))
            .collect();
        Ok(Self {
            flash: size(".text") + size(".data"),
            ram: size(".data") + size(".bss"),
            promised: promised.into(),
            symbols,
        })
    }

    /// What takes flash in an executable that promises no RAM.
    pub(crate) fn flash(path: &Path) -> Result<u64> {
        let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        let file = object::File::parse(&*bytes)?;
        let sizes =
            [".text", ".data"].map(|name| file.section_by_name(name).map_or(0, |section| section.size()));
        Ok(sizes.iter().sum())
    }

    /// The symbols that lead to a panic.
    pub(crate) fn panics(&self) -> Vec<&str> {
        self.matching(&TELLTALE)
    }

    /// The routines that compute with floating-point numbers in software.
    pub(crate) fn soft_float(&self) -> Vec<&str> {
        const ROUTINES: [&str; 10] = [
            "__aeabi_f",
            "__aeabi_d",
            "__aeabi_cf",
            "__aeabi_cd",
            "__aeabi_i2",
            "__aeabi_ui2",
            "addsf3",
            "mulsf3",
            "adddf3",
            "muldf3",
        ];
        self.matching(&ROUTINES)
    }

    fn matching(&self, parts: &[&str]) -> Vec<&str> {
        let symbols = self.symbols.iter().map(String::as_str);
        symbols.filter(|name| parts.iter().any(|part| name.contains(part))).collect()
    }
}
