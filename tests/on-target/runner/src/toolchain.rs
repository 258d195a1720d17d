//! Finds a compiler for a bare-metal target: one that has the target installed, else one that can build `core` itself.

use crate::sysroot;
use anyhow::{Result, bail};
use std::path::Path;
use std::process::{Command, Stdio};

/// What to install where nothing is found.
const ADVICE: &str = "install either\n  \
    rustup target add thumbv6m-none-eabi thumbv7m-none-eabi thumbv7em-none-eabi thumbv7em-none-eabihf \\\n      \
    thumbv8m.main-none-eabihf riscv32imc-unknown-none-elf wasm32v1-none\n\
    or, on Debian,\n  \
    apt-get install rustc-web cargo-web rust-web-src lld";

/// Programs that must be there, and the Debian package of each.
const PROGRAMS: [(&str, &str); 3] =
    [("qemu-system-arm", "qemu-system-arm"), ("qemu-system-riscv32", "qemu-system-misc"), ("node", "nodejs")];

/// A cargo, its compiler, and whether `core` has to be built from source.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Toolchain {
    cargo: String,
    rustc: String,
    build_core: bool,
}

impl Toolchain {
    /// The toolchain for a target.
    pub(crate) fn find(triple: &str) -> Result<Self> {
        let candidates = [("cargo", "rustc"), ("/usr/bin/cargo", "/usr/bin/rustc")];
        for build_core in [false, true] {
            for (cargo, rustc) in candidates {
                if succeeds(cargo) && succeeds(rustc) && offers(rustc, triple, build_core) {
                    return Ok(Self { cargo: cargo.into(), rustc: rustc.into(), build_core });
                }
            }
        }
        bail!("no toolchain for {triple}: {ADVICE}")
    }

    /// What it is, in a line.
    pub(crate) fn description(&self) -> String {
        let how = if self.build_core { "core built from source" } else { "target installed" };
        format!("{} ({how})", self.version())
    }

    /// The compiler's version, in a line.
    pub(crate) fn version(&self) -> String {
        output(&self.rustc, &["--version"]).unwrap_or_default().trim().to_owned()
    }

    /// A cargo command for some targets.
    pub(crate) fn cargo(&self, subcommand: &str, triples: &[&str]) -> Result<Command> {
        let mut command = self.command(subcommand);
        for triple in triples {
            command.args(["--target", triple]);
        }
        if self.build_core {
            command.env_remove("RUSTFLAGS"); // it would hide those of a target
            let sysroot = sysroot::with_core(self.command("build"), &self.version(), triples)?;
            for triple in triples {
                let of_target = format!("CARGO_TARGET_{}", triple.to_uppercase().replace(['-', '.'], "_"));
                let linker = if triple.starts_with("wasm32") { "wasm-ld" } else { "ld.lld" };
                command.env(format!("{of_target}_LINKER"), linker);
                command.env(format!("{of_target}_RUSTFLAGS"), format!("--sysroot={}", sysroot.display()));
            }
        }
        Ok(command)
    }

    fn command(&self, subcommand: &str) -> Command {
        let mut command = Command::new(&self.cargo);
        command.arg(subcommand).env("RUSTC", &self.rustc);
        command
    }
}

/// Fails with what to install unless every program that runs firmware is there.
pub(crate) fn require_programs() -> Result<()> {
    let missing: Vec<_> =
        PROGRAMS.into_iter().filter(|(program, _)| !succeeds(program)).map(|(_, package)| package).collect();
    if missing.is_empty() {
        return Ok(());
    }
    bail!("missing programs; on Debian: apt-get install --no-install-recommends {}", missing.join(" "))
}

fn offers(rustc: &str, triple: &str, build_core: bool) -> bool {
    let (query, inside): (&[&str], _) = if build_core {
        (&["--print=sysroot"], "lib/rustlib/src/rust/library/core/Cargo.toml")
    } else {
        (&["--print=target-libdir", "--target", triple], "")
    };
    output(rustc, query).is_some_and(|path| Path::new(path.trim()).join(inside).exists())
}

fn succeeds(program: &str) -> bool {
    output(program, &["--version"]).is_some()
}

fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).stderr(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}
