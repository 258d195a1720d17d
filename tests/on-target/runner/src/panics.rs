//! Firmware that calls the whole public API holds no symbol of a panic, so none can be reached.

use crate::compile::{self, Firmware};
use crate::elf::Elf;
use crate::target::{M0, M4F, RV32, Target};
use anyhow::{Context, Result, ensure};

/// Links the firmwares as release builds are by default; true when the API is free of panics and the control is not.
pub(crate) fn check() -> Result<bool> {
    println!("\n{:<30} {:<12} {:<16} paths to a panic", "target", "firmware", "profile");
    let mut good = true;
    let both = ["-p", "fluisim-footprint", "--bin", "everything", "--bin", "control", "--release"];
    for (target, built) in compile::build_for(&[M0, M4F, RV32], &both)? {
        ensure!(built.len() == 2, "both firmwares are built");
        for firmware in built {
            let panics = report(&target, &firmware, "release")?;
            good &= panics.is_empty() != (firmware.name == "control");
        }
    }
    Ok(good)
}

/// Says what remains when integer overflow is checked, which release builds do not do by default.
pub(crate) fn with_overflow_checks() -> Result<()> {
    println!("\n{:<30} {:<12} {:<16} paths to a panic", "target", "firmware", "profile");
    let arguments = ["-p", "fluisim-footprint", "--bin", "everything", "--profile", "checked"];
    let built = compile::build(&M4F, &arguments)?;
    report(&M4F, built.first().context("nothing was built")?, "checked").map(drop)
}

fn report(target: &Target, Firmware { name, path }: &Firmware, profile: &str) -> Result<Vec<String>> {
    let elf = Elf::read(path)?;
    let panics = elf.panics();
    println!("{:<30} {name:<12} {profile:<16} {}", target.triple, panics.len());
    for symbol in panics.iter().filter(|_| name != "control") {
        println!("  {symbol}");
    }
    Ok(panics.into_iter().map(str::to_owned).collect())
}
