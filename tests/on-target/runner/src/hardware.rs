//! The example for real chips: it builds for each, and says how large it is.

use crate::compile;
use crate::target::{M0, M4F, M33, RV32, Target};
use anyhow::{Context, Result};
use object::{Object, ObjectSection, SectionKind};

/// Chips, and the target of each.
const CHIPS: [(&str, Target); 5] =
    [("rp2040", M0), ("rp2350", M33), ("stm32f411", M4F), ("nrf52832", M4F), ("esp32c3", RV32)];

/// Builds the example for every chip and prints a row for each; an error where one does not build.
pub(crate) fn check() -> Result<bool> {
    println!("\n{:<12} {:<30} {:>8} {:>8}", "chip", "target", "flash", "RAM");
    for (chip, target) in CHIPS {
        let target = Target { machine: chip, ..target };
        let built = compile::build(&target, &["-p", "fluisim-hardware", "--profile", "small"])?;
        let firmware = built.first().context("nothing was built")?;
        let bytes = std::fs::read(&firmware.path)?;
        let (mut flash, mut ram) = (0, 0);
        for section in object::File::parse(&*bytes)?.sections() {
            match section.kind() {
                SectionKind::Text | SectionKind::ReadOnlyData => flash += section.size(),
                SectionKind::Data => (flash, ram) = (flash + section.size(), ram + section.size()),
                // riscv-rt makes sections of the heap and the stack, all that is left
                SectionKind::UninitializedData if section.name()?.starts_with(".bss") => {
                    ram += section.size()
                }
                _ => {}
            }
        }
        println!("{chip:<12} {:<30} {flash:>8} {ram:>8}", target.triple);
    }
    Ok(true)
}
