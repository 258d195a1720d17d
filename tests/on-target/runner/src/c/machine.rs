//! The processors that C programs are compiled for, and the machines they run on.

use super::archive::target_dir;
use crate::qemu::{self, Outcome};
use crate::target::Target;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A processor, its compiler and the archive for it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Machine {
    pub(crate) name: &'static str,
    /// The target of the archive.
    pub(crate) triple: &'static str,
    pub(crate) compiler: &'static str,
    pub(crate) flags: &'static [&'static str],
    /// The machine as QEMU knows it and its memory: flash and RAM, origin and length each; none for this computer.
    qemu: Option<(&'static str, [&'static str; 4])>,
}

const ARM: &str = "arm-none-eabi-gcc";
const MICROBIT: [&str; 4] = ["0x0", "256K", "0x20000000", "16K"];
const AN386: [&str; 4] = ["0x0", "4M", "0x20000000", "4M"];
const AN505: [&str; 4] = ["0x10000000", "4M", "0x38000000", "4M"];

pub(crate) const M0: Machine = Machine {
    name: "Cortex-M0",
    triple: "thumbv6m-none-eabi",
    compiler: ARM,
    flags: &["-mthumb", "-mcpu=cortex-m0"],
    qemu: Some(("microbit", MICROBIT)),
};
pub(crate) const M4F: Machine = Machine {
    name: "Cortex-M4F",
    triple: "thumbv7em-none-eabihf",
    compiler: ARM,
    flags: &["-mthumb", "-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"],
    qemu: Some(("mps2-an386", AN386)),
};
pub(crate) const HOST: Machine = Machine {
    name: "x86-64, gcc",
    triple: "x86_64-unknown-linux-gnu",
    compiler: "gcc",
    flags: &[],
    qemu: None,
};

/// Every machine. The first of each target comes with the archive's own build.
pub(crate) const MACHINES: [Machine; 9] = [
    M0,
    Machine {
        name: "Cortex-M3",
        flags: &["-mthumb", "-mcpu=cortex-m3"],
        qemu: Some(("lm3s6965evb", ["0x0", "256K", "0x20000000", "64K"])),
        ..M0
    },
    M4F,
    Machine {
        name: "Cortex-M4, soft",
        triple: "thumbv7em-none-eabi",
        flags: &["-mthumb", "-mcpu=cortex-m4", "-mfloat-abi=soft"],
        ..M4F
    },
    Machine {
        name: "Cortex-M33",
        triple: "thumbv8m.main-none-eabihf",
        flags: &["-mthumb", "-mcpu=cortex-m33", "-mfpu=fpv5-sp-d16", "-mfloat-abi=hard"],
        qemu: Some(("mps2-an505", AN505)),
        ..M4F
    },
    // as the SDK of the RP2350 compiles: floats in integer registers
    Machine {
        name: "Cortex-M33, softfp",
        triple: "thumbv7em-none-eabi",
        flags: &["-mthumb", "-mcpu=cortex-m33", "-mfpu=fpv5-sp-d16", "-mfloat-abi=softfp"],
        qemu: Some(("mps2-an505", AN505)),
        ..M4F
    },
    Machine {
        name: "RV32IMC",
        triple: "riscv32imc-unknown-none-elf",
        compiler: "riscv64-unknown-elf-gcc",
        flags: &[
            "-march=rv32imc",
            "-mabi=ilp32",
            "-mcmodel=medany",
            "-ffreestanding",
            "-nostdlib",
            "-DNO_LIBC",
        ],
        qemu: Some(("virt", ["0x80000000", "1M", "0x80100000", "1M"])),
    },
    HOST,
    Machine { name: "x86-64, clang", compiler: "clang", ..HOST },
];

/// A program to be built.
pub(crate) struct Program<'a> {
    pub(crate) source: &'a str,
    /// Options beside those of the machine.
    pub(crate) options: &'a [&'a str],
    /// The language standard.
    pub(crate) standard: &'a str,
}

impl Machine {
    /// Whether the compiler is there.
    pub(crate) fn has_compiler(&self) -> bool {
        is_there(self.compiler)
    }

    /// Whether it is this computer.
    pub(crate) fn is_host(&self) -> bool {
        self.qemu.is_none()
    }

    /// Compiles and links a program; the language is that of the standard, C or C++.
    pub(crate) fn build(&self, archive: &Path, program: &Program<'_>) -> Result<PathBuf> {
        let folder = crate::root().join("c");
        let out = target_dir().join("c").join("programs");
        std::fs::create_dir_all(&out)?;
        let out = out.join("program.elf");
        let object = out.with_extension("o");
        let compiler = if program.standard.starts_with("c++") {
            self.compiler.replace("gcc", "g++")
        } else {
            self.compiler.into()
        };
        let language = if program.standard.starts_with("c++") { "c++" } else { "c" };
        let mut compile = self.command(&compiler, program);
        compile.args(["-x", language, "-c"]).arg(format!("-std={}", program.standard));
        run(compile.arg(folder.join(program.source)).arg("-o").arg(&object))?;
        let mut link = self.command(self.compiler, program);
        link.arg(&object).arg("-std=c11");
        match self.qemu {
            None => link.arg(folder.join("host.c")),
            Some((_, [flash, flash_size, ram, ram_size])) => {
                let start = if self.triple.starts_with("riscv") { "_start" } else { "start" };
                let script = crate::read("c/machine.ld")?
                    .replace("START_AT)", &format!("{start})"))
                    .replace("= FLASH_AT,", &format!("= {flash},"))
                    .replace("FLASH_SIZE }", flash_size)
                    .replace("= FLASH_SIZE ", &format!("= {flash_size} "))
                    .replace("= RAM_AT,", &format!("= {ram},"))
                    .replace("= RAM_SIZE ", &format!("= {ram_size} "));
                let path = out.with_extension("ld");
                std::fs::write(&path, script)?;
                link.arg(folder.join("start.c"))
                    .arg("-nostartfiles")
                    .arg("-T")
                    .arg(path)
                    .arg("-Wl,--gc-sections")
            }
        };
        link.arg(archive);
        if !self.flags.contains(&"-nostdlib") {
            link.arg("-lm");
        }
        run(link.arg("-lgcc").arg("-o").arg(&out))?;
        Ok(out)
    }

    fn command(&self, compiler: &str, program: &Program<'_>) -> Command {
        let mut command = Command::new(compiler);
        command.args(self.flags).args(["-O2", "-ffunction-sections", "-fdata-sections", "-g0"]);
        command.args(["-Wall", "-Wextra", "-Wpedantic", "-Werror"]).args(program.options);
        command.arg("-I").arg(crate::root().join("../../sph-core/c/include"));
        command
    }

    /// Runs a program to its end, under `wrapper` on this computer; gives what it printed.
    pub(crate) fn run(&self, elf: &Path, wrapper: &[&str]) -> Result<Outcome> {
        if let Some((machine, _)) = self.qemu {
            return qemu::run_printing(&Target { triple: self.triple, machine }, elf);
        }
        let mut words = wrapper.iter().copied().chain(elf.to_str());
        let program = words.next().context("a program")?;
        let output =
            Command::new(program).args(words).output().with_context(|| format!("cannot start {program}"))?;
        let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        Ok(Outcome { success: output.status.success(), log: text.lines().map(str::to_owned).collect() })
    }
}

/// Whether there is a program of this name.
pub(crate) fn is_there(program: &str) -> bool {
    let found = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    found.is_ok_and(|status| status.success())
}

/// Runs a program to its end; gives what it printed.
pub(crate) fn run(command: &mut Command) -> Result<String> {
    let output = command.output().with_context(|| format!("cannot start {command:?}"))?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    if !output.status.success() {
        bail!("{command:?} failed:\n{printed}{}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(printed)
}
