//! Flash and RAM of typical uses, against the committed table.

use crate::compile;
use crate::elf::Elf;
use crate::target::{TARGETS, Target};
use crate::toolchain::Toolchain;
use anyhow::{Context, Result, ensure};

const TABLE: &str = "footprint.csv";
const HEAD: &str = "target,use,optimised for,flash,ram\n";
const USES: [&str; 4] = ["density", "fields", "fields_brute", "fixed"];
/// Optimisation levels, and what they are for.
const LEVELS: [(&str, &str); 2] = [("s", "size"), ("3", "speed")];

/// A row grows by more than this fraction only with the table being updated.
const TOLERANCE: f64 = 0.02;

/// Measures and compares with the table, or replaces it; true when no row has grown.
pub(crate) fn check(update: bool) -> Result<bool> {
    let mut table = String::from(HEAD);
    for target in TARGETS {
        for (level, purpose) in LEVELS {
            let empty = measure(&target, "empty", level)?;
            for name in USES {
                let elf = measure(&target, name, level)?;
                ensure!(elf.ram - empty.ram == elf.promised, "{name}: RAM is not what size_of says");
                if name == "fixed" {
                    ensure!(elf.soft_float().is_empty(), "fixed point needs {:?}", elf.soft_float());
                }
                let flash = elf.flash - empty.flash;
                table += &format!("{},{name},{purpose},{flash},{}\n", target.triple, elf.promised);
            }
        }
    }
    print!("\n{table}");
    if update {
        crate::write(TABLE, &table)?;
        return Ok(true);
    }
    compare(&crate::read(TABLE)?, &table)
}

fn measure(target: &Target, name: &str, level: &str) -> Result<Elf> {
    let mut cargo = Toolchain::find(target.triple)?.cargo("rustc", target.triple);
    cargo.args(["-p", "fluisim-footprint", "--release", "--bin", name]);
    cargo.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", level);
    let built = compile::run(cargo)?;
    Elf::read(&built.first().context("nothing was built")?.path)
}

/// True when each row of the table is there and none has grown too much.
fn compare(committed: &str, measured: &str) -> Result<bool> {
    let mut good = true;
    for row in measured.lines().skip(1) {
        let (key, flash) = split(row)?;
        let before = committed.lines().skip(1).find_map(|row| split(row).ok().filter(|(k, _)| *k == key));
        match before {
            Some((_, before)) if flash <= before * (1.0 + TOLERANCE) => (),
            Some((_, before)) => {
                println!(
                    "{key} has grown from {before} to {flash} bytes: make it smaller, or run with --update"
                );
                good = false;
            }
            None => {
                println!("{key} is not in {TABLE}: run with --update");
                good = false;
            }
        }
    }
    Ok(good)
}

/// The row's name and its flash.
fn split(row: &str) -> Result<(&str, f64)> {
    let (rest, _ram) = row.rsplit_once(',').context("a row of five columns")?;
    let (key, flash) = rest.rsplit_once(',').context("a row of five columns")?;
    Ok((key, flash.parse().context("flash in bytes")?))
}
