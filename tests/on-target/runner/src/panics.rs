//! Firmware that calls the whole public API holds no symbol of a panic, so none can be reached.

use crate::compile;
use crate::elf::Elf;
use crate::target::{M0, M4F, RV32, Target};
use anyhow::{Context, Result};

/// Links the firmwares as release builds are by default; true when the API is free of panics and the control is not.
pub(crate) fn check() -> Result<bool> {
    println!("\n{:<30} {:<12} {:<16} paths to a panic", "target", "firmware", "profile");
    let mut good = true;
    for target in [M0, M4F, RV32] {
        good &= report(&target, "everything", "release")?.is_empty();
        good &= !report(&target, "control", "release")?.is_empty();
    }
    Ok(good)
}

/// Says what remains when integer overflow is checked, which release builds do not do by default.
pub(crate) fn with_overflow_checks() -> Result<()> {
    println!("\n{:<30} {:<12} {:<16} paths to a panic", "target", "firmware", "profile");
    report(&M4F, "everything", "checked").map(drop)
}

fn report(target: &Target, name: &str, profile: &str) -> Result<Vec<String>> {
    let built = compile::build(target, &["-p", "fluisim-footprint", "--bin", name, "--profile", profile])?;
    let elf = Elf::read(&built.first().context("nothing was built")?.path)?;
    let panics = elf.panics();
    println!("{:<30} {name:<12} {profile:<16} {}", target.triple, panics.len());
    for symbol in panics.iter().filter(|_| name != "control") {
        println!("  {symbol}");
    }
    Ok(panics.into_iter().map(str::to_owned).collect())
}
