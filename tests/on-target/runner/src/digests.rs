//! The digests of the fixed scene, from every processor, against the golden file.

use crate::compile::{self, Firmware};
use crate::qemu;
use crate::target::{M0, TARGETS, Target};
use crate::toolchain::Toolchain;
use anyhow::{Context, Result, bail, ensure};
use std::process::Command;

/// The golden digests, one a line.
const GOLDEN: &str = "digest/golden.txt";
pub(crate) const WASM: &str = "wasm32v1-none";

/// Writes the golden file from this computer.
pub(crate) fn update() -> Result<()> {
    let mut text = String::new();
    fluisim_digest::all(|item| text += &format!("{item}\n")).context("the scene")?;
    crate::write(GOLDEN, &text)
}

/// Runs the digests everywhere and prints a row for each; true when all agree with the golden file.
pub(crate) fn check() -> Result<bool> {
    let golden = crate::read(GOLDEN)?;
    let golden: Vec<&str> = golden.lines().collect();
    println!("\n{:<30} {:<8} {:>8} {:>8}", "target", "profile", "digests", "differ");
    let mut good = true;
    for (profile, targets) in [("release", &TARGETS[..]), ("dev", &[M0])] {
        let programs =
            ["-p", "fluisim-firmware", "--features", "programs", "--bin", "digest_*", "--profile", profile];
        for (target, firmware) in compile::build_for(targets, &programs)? {
            good &= agree(target.triple, profile, &golden, &on_target(&target, &firmware)?);
        }
    }
    if Toolchain::find(WASM).is_err() {
        println!("{WASM:<30} SKIPPED: no toolchain has this target");
        return Ok(good);
    }
    good &= agree(WASM, "release", &golden, &in_node()?);
    Ok(good)
}

fn on_target(target: &Target, firmware: &[Firmware]) -> Result<Vec<String>> {
    let mut lines = Vec::new();
    for Firmware { name, path } in firmware {
        let outcome = qemu::run(target, path, &[])?;
        ensure!(outcome.success, "{name} failed on {}: {:?}", target.triple, outcome.log.last());
        lines.extend(outcome.log);
    }
    Ok(lines)
}

fn in_node() -> Result<Vec<String>> {
    let mut cargo = Toolchain::find(WASM)?.cargo("build", &[WASM])?;
    cargo.args(["-p", "fluisim-wasm", "--release"]);
    let built = compile::run(cargo)?;
    let module = built.first().context("no module was built")?;
    let output =
        Command::new("node").arg(crate::root().join("wasm/digest.mjs")).arg(&module.path).output()?;
    if !output.status.success() {
        bail!("node failed: {}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect())
}

/// Compares line by line, in any order of the scalars, and prints both where they differ.
fn agree(target: &str, profile: &str, golden: &[&str], found: &[String]) -> bool {
    let mut differ = 0;
    for expected in golden {
        let (item, digest) = expected.rsplit_once(' ').unwrap_or((expected, ""));
        let of_item = |line: &&String| line.rsplit_once(' ').is_some_and(|(name, _)| name == item);
        let digest_found = found.iter().find(of_item).and_then(|line| line.rsplit(' ').next());
        if digest_found != Some(digest) {
            differ += 1;
            println!("{target} {profile} {item}: golden {digest}, found {}", digest_found.unwrap_or("none"));
        }
    }
    println!("{target:<30} {profile:<8} {:>8} {differ:>8}", found.len());
    differ == 0 && found.len() == golden.len()
}
