//! Flash and RAM of typical uses, less those of firmware that does nothing.

use crate::compile::{self, Firmware};
use crate::elf::Elf;
use crate::table;
use crate::target::{M0, M4F, RV32, TARGETS, Target};
use anyhow::{Context, Result, ensure};

const USES: [&str; 8] =
    ["density", "fields", "fields_poly6", "fields_brute", "fixed", "fixed_brute", "fixed16", "fixed16_brute"];

/// Measures and compares with the table, or replaces it; true when no row has grown.
pub(crate) fn check(update: bool) -> Result<bool> {
    let mut rows = Vec::new();
    for (profile, targets) in [("release", &TARGETS[..]), ("small", &[M0, M4F, RV32])] {
        let mut arguments = vec!["-p", "fluisim-footprint", "--profile", profile, "--bin", "empty"];
        arguments.extend(USES.iter().flat_map(|name| ["--bin", name]));
        for (target, firmware) in compile::build_for(targets, &arguments)? {
            rows.extend(measure(&target, profile, &firmware)?);
        }
    }
    table::check("footprint.csv", "target,profile,use,RAM,flash", &rows, update)
}

fn measure(target: &Target, profile: &str, built: &[Firmware]) -> Result<Vec<String>> {
    let read = |name: &str| {
        let firmware = built.iter().find(|firmware| firmware.name == name).context("a binary is missing")?;
        Elf::read(&firmware.path)
    };
    let empty = read("empty")?;
    let mut rows = Vec::new();
    for name in USES {
        let elf = read(name)?;
        ensure!(elf.ram - empty.ram == elf.promised, "{name}: RAM is not what size_of says");
        ensure!(elf.panics().is_empty(), "{} {profile}: {name} can panic: {:?}", target.triple, elf.panics());
        if name.starts_with("fixed") {
            ensure!(elf.soft_float().is_empty(), "fixed point needs {:?}", elf.soft_float());
        }
        rows.push(format!("{},{profile},{name},{},{}", target.triple, elf.promised, elf.flash - empty.flash));
    }
    Ok(rows)
}
