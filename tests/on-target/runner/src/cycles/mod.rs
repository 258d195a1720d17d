//! Cycles of a frame on a Cortex-M0 and a Cortex-M0+, and bounds of them on a Cortex-M4, which a plugin of QEMU adds up, and the
//! frames a second that follow.

mod pendants;
mod region;
mod rp2040js;

use crate::compile::{self, Firmware};
use crate::qemu;
use crate::table;
use crate::target::{M0, M4F, Target};
use anyhow::{Context, Result, ensure};
use pendants::Pendant;
use region::Region;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Measures and compares with the table, or replaces it; true when known loops have their cycles, no row has grown and rp2040js
/// agrees. Where QEMU takes no plugin it says so and is true.
pub(crate) fn check(update: bool) -> Result<bool> {
    let plugin = plugin()?;
    if let Some(refusal) = qemu::refuses(&plugin, &scratch("refused"))? {
        println!("\ncycles: SKIPPED: QEMU does not take the plugin {}: {refusal}", plugin.display());
        return Ok(true);
    }
    let mut good = known(&plugin)?;
    let fixed = pendants(&plugin, M0, "cycles_i16f16")?;
    let mut all = fixed.clone();
    for (target, binary) in [(M0, "cycles_f32"), (M4F, "cycles_i16f16"), (M4F, "cycles_f32")] {
        all.extend(pendants(&plugin, target, binary)?);
    }
    let rows: Vec<String> = all.iter().flat_map(Pendant::rows).collect();
    good &= table::check("cycles.csv", "target,scalar,particles,work,quantity,number", &rows, update)?;
    pendants::print_frames_a_second(&all);
    good &= rp2040js::agrees(&fixed)?;
    Ok(good)
}

/// Builds the plugin for this computer.
fn plugin() -> Result<PathBuf> {
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "-p", "fluisim-cycles", "--release"]);
    let built = compile::run(cargo)?;
    Ok(built.into_iter().next().context("no plugin was built")?.path)
}

/// Loops whose cycles are known by hand; true when each has exactly them.
fn known(plugin: &Path) -> Result<bool> {
    let firmware = build(&M0, "cycles_known")?;
    let (log, regions) = run(plugin, &M0, &firmware)?;
    ensure!(log.len() == regions.len(), "{} loops, {} regions", log.len(), regions.len());
    let mut good = true;
    for (line, region) in log.iter().zip(regions) {
        let counted = format!("{},{},{}", region.instructions, region.m0, region.m0_plus);
        let right = region.unknown == 0 && line.ends_with(&format!(",{counted}"));
        if !right {
            println!(
                "cycles: {line} is known by hand, counted is {counted}, {} without a number",
                region.unknown
            );
        }
        good &= right;
    }
    println!(
        "\ncycles: {} loops known by hand, {}",
        log.len(),
        if good { "all exact" } else { "NOT all exact" }
    );
    Ok(good)
}

fn pendants(plugin: &Path, target: Target, binary: &str) -> Result<Vec<Pendant>> {
    let (log, regions) = run(plugin, &target, &build(&target, binary)?)?;
    Pendant::read(target, &log, &regions)
}

fn build(target: &Target, binary: &str) -> Result<Firmware> {
    let arguments = ["-p", "fluisim-firmware", "--features", "cycles", "--bin", binary, "--profile", "fast"];
    compile::build(target, &arguments)?.into_iter().next().context("nothing was built")
}

/// The log of the firmware, and its regions.
fn run(plugin: &Path, target: &Target, firmware: &Firmware) -> Result<(Vec<String>, Vec<Region>)> {
    let out = scratch(&firmware.name);
    let argument = format!("{},out={}", plugin.display(), out.display());
    let outcome = qemu::run(target, &firmware.path, &["-plugin", &argument])?;
    ensure!(outcome.success, "{} failed: {:?}", firmware.name, outcome.log.last());
    let text = std::fs::read_to_string(&out).with_context(|| format!("cannot read {}", out.display()))?;
    Ok((outcome.log, region::read(&text)?))
}

/// Where the plugin writes.
fn scratch(name: &str) -> PathBuf {
    crate::c::target_dir().join(format!("{name}.regions"))
}
