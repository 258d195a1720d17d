//! The same firmware on rp2040js, an emulator of a chip with a Cortex-M0+ that counts cycles by itself.

use super::pendants::Pendant;
use super::region::{self, Region};
use crate::node;
use crate::target::{M0, Target};
use anyhow::{Context, Result, ensure};
use std::path::PathBuf;
use std::process::Command;

/// The two sums of a region differ by less than this fraction.
const TOLERANCE: f64 = 0.05;

/// Runs the pendants there and compares region by region; true when they agree, or when it cannot be installed, and then it says so.
///
/// rp2040js 1.4.1 leaves out one cycle for the link register of a PUSH and one for the program counter of a POP, against the manual.
/// Apart from that the sums are to be equal.
pub(crate) fn agrees(pendants: &[Pendant]) -> Result<bool> {
    let script = match install() {
        Ok(script) => script,
        Err(missing) => {
            println!("\ncycles: rp2040js is SKIPPED: {missing:#}");
            return Ok(true);
        }
    };
    let firmware = super::build(&Target { machine: "rp2040", ..M0 }, "cycles_i16f16")?;
    let output =
        Command::new("node").arg(script).arg(&firmware.path).output().context("cannot start node")?;
    ensure!(output.status.success(), "rp2040js failed: {}", String::from_utf8_lossy(&output.stderr));
    let theirs = region::numbers::<2>(&String::from_utf8_lossy(&output.stdout))?;
    let ours: Vec<Region> = pendants.iter().flat_map(|pendant| pendant.regions.iter().copied()).collect();
    ensure!(ours.len() == theirs.len(), "{} regions, {} on rp2040js", ours.len(), theirs.len());
    let mut worst = 0.0_f64;
    let mut good = true;
    for (region, [instructions, cycles]) in ours.iter().zip(theirs) {
        worst = worst.max((region.m0_plus as f64 / cycles as f64 - 1.0).abs());
        let explained = region.m0_plus == cycles + region.linked;
        if !explained || region.instructions != instructions {
            println!("cycles: rp2040js has {instructions} instructions, {cycles} cycles where {region:?}");
            good = false;
        }
    }
    println!(
        "\ncycles: rp2040js on {} regions: at most {:.2} % apart, {}",
        ours.len(),
        100.0 * worst,
        if good {
            "all of it the link registers that are pushed and the program counters that are popped"
        } else {
            "NOT explained"
        }
    );
    Ok(good && worst <= TOLERANCE)
}

/// Installs rp2040js as its lock file says; an error where npm is missing or reaches no registry.
fn install() -> Result<PathBuf> {
    let from = crate::root().join("cycles/rp2040js");
    let out = crate::c::target_dir().join("rp2040js");
    std::fs::create_dir_all(&out)?;
    node::install("rp2040js", &from, &out)?;
    let script = out.join("run.mjs"); // beside what it imports
    std::fs::copy(from.join("run.mjs"), &script).context("cannot copy run.mjs")?;
    Ok(script)
}
