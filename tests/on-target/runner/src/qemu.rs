//! Runs firmware on an emulated machine and reads its log.

use crate::target::Target;
use anyhow::{Context, Result, bail};
use defmt_decoder::{DecodeError, Table};
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// Firmware that runs longer than this is taken to hang.
const PATIENCE: Duration = Duration::from_secs(600);

/// What a run came to.
#[derive(Clone, Debug)]
pub(crate) struct Outcome {
    /// Whether the firmware ended by itself, reporting success.
    pub(crate) success: bool,
    /// Its log, a message each.
    pub(crate) log: Vec<String>,
}

/// Runs firmware to its end; its log is defmt's.
pub(crate) fn run(target: &Target, elf: &Path, more: &[&str]) -> Result<Outcome> {
    let (success, bytes, errors) = start(target, elf, more)?;
    if !success {
        eprintln!("{errors}");
    }
    Ok(Outcome { success, log: decode(elf, &bytes)? })
}

/// Runs firmware to its end; its log is text.
pub(crate) fn run_printing(target: &Target, elf: &Path) -> Result<Outcome> {
    let (success, bytes, errors) = start(target, elf, &[])?;
    // programs print to the stream that QEMU warns on
    let printed = errors.replace("Timer with period zero, disabling\n", "");
    let text = String::from_utf8_lossy(&bytes) + printed.as_str();
    Ok(Outcome { success, log: text.lines().map(str::to_owned).collect() })
}

/// What QEMU says when it does not take a plugin that writes to `out`, and nothing when it does.
pub(crate) fn refuses(plugin: &Path, out: &Path) -> Result<Option<String>> {
    let argument = format!("{},out={}", plugin.display(), out.display());
    let mut child = Command::new("qemu-system-arm")
        .args(["-machine", "none", "-display", "none", "-monitor", "stdio", "-plugin", &argument])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .context("cannot start qemu-system-arm")?;
    // one that refuses has ended before it reads this
    let _ = child.stdin.take().context("QEMU's input is piped")?.write_all(b"quit\n");
    let output = child.wait_with_output()?;
    let errors = String::from_utf8_lossy(&output.stderr).trim().to_owned();
    Ok((!output.status.success()).then_some(errors))
}

/// Whether it ended well, and what came out of both streams.
fn start(target: &Target, elf: &Path, more: &[&str]) -> Result<(bool, Vec<u8>, String)> {
    let (program, machine) = target.qemu();
    let mut child = Command::new(program)
        .args(machine)
        .args(["-nographic", "-monitor", "none", "-serial", "none"])
        .args(["-semihosting-config", "enable=on,target=native"])
        .args(more)
        .arg("-kernel")
        .arg(elf)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .with_context(|| format!("cannot start {program}"))?;
    let mut stdout = child.stdout.take().context("QEMU's output is piped")?;
    let reader = thread::spawn(move || {
        let mut bytes = Vec::new();
        stdout.read_to_end(&mut bytes).map(|_| bytes)
    });
    let success = ends_well(&mut child)?;
    let Ok(bytes) = reader.join() else { bail!("the thread that reads from QEMU panicked") };
    let mut errors = String::new();
    child.stderr.take().context("QEMU's errors are piped")?.read_to_string(&mut errors)?;
    Ok((success, bytes?, errors))
}

fn ends_well(child: &mut Child) -> Result<bool> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(status.success());
        }
        if start.elapsed() > PATIENCE {
            child.kill()?;
            child.wait()?;
            return Ok(false);
        }
        thread::sleep(Duration::from_millis(10));
    }
}

fn decode(elf: &Path, bytes: &[u8]) -> Result<Vec<String>> {
    let file = std::fs::read(elf).with_context(|| format!("cannot read {}", elf.display()))?;
    let table = Table::parse(&file)?.with_context(|| format!("{} logs nothing", elf.display()))?;
    let mut decoder = table.new_stream_decoder();
    decoder.received(bytes);
    let mut log = Vec::new();
    loop {
        match decoder.decode() {
            Ok(frame) => log.push(frame.display_message().to_string()),
            Err(DecodeError::UnexpectedEof) => return Ok(log),
            Err(DecodeError::Malformed) => bail!("{} wrote a log that cannot be decoded", elf.display()),
        }
    }
}
