//! Builds the copy: first without the changes that the compiler refuses, then its tests.

use anyhow::{Result, bail, ensure};
use serde_json::Value;
use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::process::Stdio;

use crate::change::{Change, blamed, on_the_line};
use crate::copy::Workspace;

/// Rounds after which a copy that does not compile is a fault of this program.
const ROUNDS: usize = 12;

/// Leaves out what does not compile; the numbers of what was left out.
pub(crate) fn drop_what_does_not_compile(
    workspace: &Workspace,
    changes: &mut Vec<Change>,
) -> Result<BTreeSet<u32>> {
    let count = changes.len();
    let memory = Memory::of(workspace, changes);
    let mut dropped = memory.refused();
    changes.retain(|change| !dropped.contains(&change.number));
    for round in 0..ROUNDS {
        workspace.write(changes, count)?;
        let mut cargo = workspace.cargo();
        cargo.args([
            "check",
            "--message-format=json",
            "--all-features",
            "--lib",
            "-p",
            workspace.subject.package,
        ]);
        let output = cargo.stderr(Stdio::null()).output()?;
        if output.status.success() {
            memory.keep(&dropped)?;
            return Ok(dropped);
        }
        let mut refused = BTreeSet::new();
        for line in String::from_utf8(output.stdout)?.lines() {
            let message: Value = serde_json::from_str(line)?;
            if message["message"]["level"] == "error" {
                refused.extend(blame(workspace, &message["message"])?);
            }
        }
        eprintln!("round {round}: {} changes do not compile", refused.len());
        ensure!(
            !refused.is_empty(),
            "the copy does not compile, and no change is to blame: {}",
            workspace.copy.display()
        );
        changes.retain(|change| !refused.contains(&change.number));
        dropped.extend(refused);
    }
    bail!("the copy does not compile after {ROUNDS} rounds")
}

/// What was refused the last time that all changes were the same: files that are written once more would all be built once more.
struct Memory {
    file: PathBuf,
    fingerprint: String,
}

impl Memory {
    fn of(workspace: &Workspace, changes: &[Change]) -> Self {
        let mut hasher = DefaultHasher::new();
        changes.iter().for_each(|change| (change.number, change.name(), &change.range).hash(&mut hasher));
        let file = workspace.copy.with_extension("refused");
        Self { file, fingerprint: format!("{:016x}", hasher.finish()) }
    }

    fn refused(&self) -> BTreeSet<u32> {
        let text = std::fs::read_to_string(&self.file).unwrap_or_default();
        let numbers = text.strip_prefix(&self.fingerprint).unwrap_or_default();
        numbers.lines().filter_map(|line| line.parse().ok()).collect()
    }

    fn keep(&self, refused: &BTreeSet<u32>) -> Result<()> {
        let numbers: String = refused.iter().map(|number| format!("\n{number}")).collect();
        Ok(std::fs::write(&self.file, format!("{}{numbers}", self.fingerprint))?)
    }
}

/// The changes that an error points at: in what they put in, or else all of its line.
fn blame(workspace: &Workspace, message: &Value) -> Result<Vec<u32>> {
    let mut places = Vec::new();
    collect(message, &mut places);
    let mut lines = Vec::new();
    for (file, byte) in places {
        let Ok(text) = std::fs::read_to_string(workspace.copy.join(&file)) else { continue };
        if let Some(number) = blamed(&text, byte) {
            return Ok(vec![number]);
        }
        if lines.is_empty() && byte < text.len() {
            lines = on_the_line(&text, byte);
        }
    }
    if !lines.is_empty() {
        eprintln!(
            "{} changes of one line: {}",
            lines.len(),
            message["rendered"].as_str().unwrap_or_default()
        );
    }
    Ok(lines)
}

/// File and byte of all that a message points at: its own places first, then those of its notes and of macros.
fn collect(message: &Value, places: &mut Vec<(PathBuf, usize)>) {
    let empty = Vec::new();
    let list = |value: &'_ Value| value.as_array().unwrap_or(&empty).clone();
    for span in list(&message["spans"]) {
        let mut span = &span;
        while let (Some(file), Some(byte)) = (span["file_name"].as_str(), span["byte_start"].as_u64()) {
            places.push((file.into(), byte as usize));
            span = &span["expansion"]["span"];
        }
    }
    for child in list(&message["children"]) {
        collect(&child, places);
    }
}

/// Builds the tests; the programs.
pub(crate) fn tests(workspace: &Workspace) -> Result<Vec<PathBuf>> {
    let mut cargo = workspace.cargo();
    cargo.args([
        "test",
        "--no-run",
        "--message-format=json-render-diagnostics",
        "--all-features",
        "--lib",
        "--tests",
    ]);
    cargo.args(workspace.subject.tested.iter().flat_map(|package| ["-p", package]));
    let output = cargo.stderr(Stdio::inherit()).output()?;
    ensure!(output.status.success(), "the tests of the copy do not compile: {}", workspace.copy.display());
    let mut programs = Vec::new();
    for line in String::from_utf8(output.stdout)?.lines() {
        let message: Value = serde_json::from_str(line)?;
        if message["profile"]["test"] == true
            && let Some(program) = message["executable"].as_str()
        {
            programs.push(program.into());
        }
    }
    Ok(programs)
}
