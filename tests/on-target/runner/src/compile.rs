//! Builds firmware and says where it is.

use crate::target::{TARGETS, Target};
use crate::toolchain::Toolchain;
use anyhow::{Context, Result, bail};
use cargo_metadata::Message;
use std::env::consts::DLL_EXTENSION;
use std::io::BufReader;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// An executable, or a library that is loaded as one.
#[derive(Clone, Debug)]
pub(crate) struct Firmware {
    /// The name of the test or binary.
    pub(crate) name: String,
    /// Where it is.
    pub(crate) path: PathBuf,
}

/// Builds with the machine's memory map; `arguments` choose package, profile and features.
pub(crate) fn build(target: &Target, arguments: &[&str]) -> Result<Vec<Firmware>> {
    let mut command = Toolchain::find(target.triple)?.cargo("build", &[target.triple])?;
    if !TARGETS.contains(target) {
        command.env("FLUISIM_MACHINE", target.machine);
    }
    command.args(arguments);
    run(command)
}

/// Builds for several of [`TARGETS`], those of one architecture and toolchain at once, so that no core is idle while another
/// compiles a crate alone; the firmware of each target, in their order. Across architectures cargo would join the features
/// of the crates that both have, and critical-section's exclude each other.
pub(crate) fn build_for(targets: &[Target], arguments: &[&str]) -> Result<Vec<(Target, Vec<Firmware>)>> {
    let with_toolchain = |target: &Target| Ok((*target, Toolchain::find(target.triple)?));
    let targets = targets.iter().map(with_toolchain).collect::<Result<Vec<_>>>()?;
    let together = |(a, of_a): &(Target, Toolchain), (b, of_b): &(Target, Toolchain)| {
        a.architecture() == b.architecture() && of_a == of_b
    };
    let mut all = Vec::new();
    for group in targets.chunk_by(together) {
        let triples: Vec<_> = group.iter().map(|(target, _)| target.triple).collect();
        let mut command = group[0].1.cargo("build", &triples)?;
        command.args(arguments);
        let built = run(command)?;
        for (target, _) in group {
            let is_of_target = |firmware: &&Firmware| firmware.path.iter().any(|part| part == target.triple);
            all.push((*target, built.iter().filter(is_of_target).cloned().collect()));
        }
    }
    Ok(all)
}

/// Runs a cargo command; gives the executables and the libraries with C linkage in the order of their names.
pub(crate) fn run(mut command: Command) -> Result<Vec<Firmware>> {
    command
        .current_dir(crate::root())
        .args(["--locked", "--quiet", "--message-format=json-render-diagnostics"])
        .stdout(Stdio::piped());
    let mut child = command.spawn().with_context(|| format!("cannot start {command:?}"))?;
    let stdout = child.stdout.take().context("cargo's output is piped")?;
    let mut built = Vec::new();
    for message in Message::parse_stream(BufReader::new(stdout)) {
        if let Message::CompilerArtifact(artifact) = message? {
            let plugin = artifact.target.is_cdylib().then_some(DLL_EXTENSION);
            let is_library = |ending: Option<&str>| {
                matches!(ending, Some("wasm" | "a")) || ending.is_some() && ending == plugin
            };
            let module = artifact.filenames.iter().find(|file| is_library(file.extension()));
            if let Some(path) = artifact.executable.as_ref().or(module) {
                built.push(Firmware { name: artifact.target.name, path: path.into() });
            }
        }
    }
    if !child.wait()?.success() {
        bail!("{command:?} failed");
    }
    built.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(built)
}
