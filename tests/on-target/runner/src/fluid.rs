//! What a frame of the position-based fluid takes: instructions a particle pass by pass, RAM, stack and flash.

use crate::compile;
use crate::elf::Elf;
use crate::qemu;
use crate::table;
use crate::target::{M0, M4F, RV32, Target};
use anyhow::{Context, Result, ensure};

const HEAD: &str = "target,scalar,particles,quantity,number";

/// Measures and compares with the table, or replaces it; true when no row has grown.
pub(crate) fn check(update: bool) -> Result<bool> {
    let mut rows = Vec::new();
    // The microbit has no SysTick that counts instructions; the larger machine runs the same code.
    let counting = Target { machine: M4F.machine, ..M0 };
    let of_instructions = |row: &str| !row.contains(",stack,");
    for (target, binary) in
        [(counting, "fluid_i16f16"), (M4F, "fluid_f32"), (M4F, "fluid_i16f16"), (RV32, "fluid_i16f16")]
    {
        rows.extend(
            run(&target, binary, &["-icount", "shift=0"])?.into_iter().filter(|row| of_instructions(row)),
        );
    }
    // in the microbit's 16 KiB
    for binary in ["fluid_f32", "fluid_i16f16"] {
        rows.extend(run(&M0, binary, &[])?.into_iter().filter(|row| !of_instructions(row)));
    }
    for target in [M0, M4F, RV32] {
        for profile in ["release", "fast", "small"] {
            rows.extend(flash(&target, profile)?);
        }
    }
    table::check("fluid.csv", HEAD, &rows, update)
}

fn run(target: &Target, binary: &str, more: &[&str]) -> Result<Vec<String>> {
    let arguments =
        ["-p", "fluisim-firmware", "--features", "programs", "--bin", binary, "--profile", "fast"];
    let built = compile::build(target, &arguments)?;
    let firmware = built.first().context("nothing was built")?;
    let outcome = qemu::run(target, &firmware.path, more)?;
    ensure!(outcome.success, "{binary} failed on {}: {:?}", target.triple, outcome.log.last());
    Ok(outcome.log.iter().map(|line| format!("{},{line}", target.triple)).collect())
}

/// The code of a frame with all that it calls, without the storage's initial values, and that it cannot panic.
fn flash(target: &Target, profile: &str) -> Result<Vec<String>> {
    let binaries = ["--bin", "empty", "--bin", "fluid", "--bin", "fixed_fluid"];
    let built = compile::build(
        target,
        &[&["-p", "fluisim-footprint", "--profile", profile], &binaries[..]].concat(),
    )?;
    let read = |name: &str| {
        let firmware = built.iter().find(|firmware| firmware.name == name).context("a binary is missing")?;
        Elf::read(&firmware.path)
    };
    let empty = read("empty")?;
    [("fluid", "f32"), ("fixed_fluid", "saturating i16f16")]
        .into_iter()
        .map(|(name, scalar)| {
            let elf = read(name)?;
            ensure!(
                elf.panics().is_empty(),
                "{} {profile}: {name} can panic: {:?}",
                target.triple,
                elf.panics()
            );
            ensure!(
                !name.starts_with("fixed") || elf.soft_float().is_empty(),
                "fixed point needs {:?}",
                elf.soft_float()
            );
            Ok(format!(
                "{},{scalar},64,flash {profile},{}",
                target.triple,
                elf.flash - empty.flash - elf.promised
            ))
        })
        .collect()
}
