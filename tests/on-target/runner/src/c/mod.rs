//! The C library: its archives, and C programs with them on every processor.

mod archive;
mod arduino;
mod cmake;
mod flash;
mod machine;
mod packages;

use crate::elf::Elf;
use crate::table;
use anyhow::{Context, Result, ensure};
use archive::Archive;
pub(crate) use archive::target_dir;
use machine::{HOST, M0, M4F, MACHINES, Machine, Program};
use std::collections::BTreeMap;
use std::process::Command;

type Archives = BTreeMap<&'static str, Archive>;

/// Builds all archives and holds them against C programs; true when everything holds.
pub(crate) fn check(update: bool) -> Result<bool> {
    let archives = archives()?;
    let mut good = header(&archives)?;
    good &= digests(&archives)?;
    good &= linked(&archives)?;
    good &= errors(&archives)?;
    good &= readme(&archives)?;
    good &= packages::check(&archives)?;
    good &= flash::check(&archives, update)?;
    Ok(good)
}

/// Builds all archives and puts the packages together.
pub(crate) fn pack() -> Result<()> {
    packages::write(&archives()?)?;
    Ok(())
}

fn archives() -> Result<Archives> {
    let mut archives = Archives::new();
    println!("\n{:<30} {:>8} {:>10} {:>8}  archive", "target", "bytes", "functions", "needs");
    for machine in MACHINES {
        if !archives.contains_key(machine.triple)
            && (!machine.is_host() || cfg!(all(target_arch = "x86_64", target_os = "linux")))
        {
            let archive = archive::build(machine.triple)?;
            let Archive { path, size, exported, needed } = &archive;
            println!(
                "{:<30} {size:>8} {exported:>10} {:>8}  {}",
                machine.triple,
                needed.len(),
                path.display()
            );
            archives.insert(machine.triple, archive);
        }
    }
    Ok(archives)
}

/// The machines that there is a compiler and an archive for; says loudly which are left out.
fn machines(archives: &Archives) -> impl Iterator<Item = (Machine, &Archive)> {
    MACHINES.into_iter().filter_map(|machine| {
        let archive = archives.get(machine.triple).filter(|_| machine.has_compiler());
        if archive.is_none() {
            println!("{:<30} SKIPPED: there is no {} here", machine.name, machine.compiler);
        }
        Some((machine, archive?))
    })
}

/// The two halves of the golden program.
const SCALARS: [&str; 2] = ["-DFIXED", "-DFLOATING"];

/// The header compiles without a warning in every standard; where another machine's compiler is missing, on those there are.
fn header(archives: &Archives) -> Result<bool> {
    for machine in [M4F, HOST].iter().filter(|machine| machine.has_compiler()) {
        let Some(archive) = archives.get(machine.triple) else { continue };
        for standard in ["c99", "c11", "c++17"] {
            machine.build(&archive.path, &Program { source: "flash.c", options: &["-DFIXED"], standard })?;
        }
    }
    println!("\nfluisim.h compiles as C99, C11 and C++17");
    Ok(true)
}

/// The rows of the golden file that C programs print, on every machine.
fn digests(archives: &Archives) -> Result<bool> {
    println!("\n{:<30} {:>8} {:>8}", "C on", "digests", "differ");
    let mut good = true;
    for (machine, archive) in machines(archives) {
        good &= agrees(&machine, machine.name, archive, ("c11", &[]))?;
    }
    Ok(good)
}

/// Whether what the golden program prints, compiled for a standard and with options, is in the golden file.
fn agrees(
    machine: &Machine,
    name: &str,
    archive: &Archive,
    (standard, options): (&str, &[&str]),
) -> Result<bool> {
    const ROWS: usize = 36;
    let golden = crate::read("digest/golden.txt")?;
    let (mut printed, mut success) = (Vec::new(), true);
    for scalar in SCALARS {
        let options = &[options, &[scalar]].concat();
        let elf = machine.build(&archive.path, &Program { source: "golden.c", options, standard })?;
        let outcome = machine.run(&elf, &[])?;
        success &= outcome.success;
        printed.extend(outcome.log);
    }
    let strange: Vec<_> = printed.iter().filter(|&row| !golden.lines().any(|line| line == row)).collect();
    println!("{name:<30} {:>8} {:>8}", printed.len(), strange.len());
    for row in &strange {
        println!("  not in the golden file: {row}");
    }
    Ok(success && strange.is_empty() && printed.len() == ROWS)
}

/// The same program as C++ and with link-time optimisation.
fn linked(archives: &Archives) -> Result<bool> {
    let mut good = true;
    for machine in [M0, M4F, HOST].iter().filter(|machine| machine.has_compiler()) {
        let Some(archive) = archives.get(machine.triple) else { continue };
        let how: [(&str, &str, &[&str]); 2] = [("C++17", "c++17", &[]), ("-flto", "c11", &["-flto"])];
        for (how, standard, options) in how {
            good &= agrees(machine, &format!("{}, {how}", machine.name), archive, (standard, options))?;
        }
    }
    Ok(good)
}

/// What every function answers to what is wrong, on a Cortex-M4F (all kernels in both number types do not fit into
/// the flash of a microbit) and on this computer, there under valgrind and with ASan.
fn errors(archives: &Archives) -> Result<bool> {
    let mut good = true;
    println!("\n{:<30} errors", "C on");
    let valgrind: &[&str] = &["valgrind", "--quiet", "--error-exitcode=9", "--leak-check=full"];
    let sanitized: &[&str] = &["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    let runs: [(Machine, &str, &[&str], &[&str]); 4] = [
        (M4F, "", &[], &[]),
        (HOST, "", &[], &[]),
        (HOST, "valgrind", &[], valgrind),
        (HOST, "ASan, UBSan", sanitized, &[]),
    ];
    for (machine, how, options, wrapper) in runs {
        let Some(archive) = archives.get(machine.triple).filter(|_| machine.has_compiler()) else { continue };
        if wrapper.first().is_some_and(|program| !machine::is_there(program)) {
            println!("{:<30} SKIPPED: there is no {how} here", machine.name);
            continue;
        }
        for (source, scalar) in [("errors.c", "-DBOTH"), ("golden.c", SCALARS[0]), ("golden.c", SCALARS[1])] {
            let options = &[options, &[scalar]].concat();
            let elf = machine.build(&archive.path, &Program { source, options, standard: "c11" })?;
            let outcome = machine.run(&elf, wrapper)?;
            let complaints = outcome.log.iter().any(|line| source == "errors.c" || line.starts_with("=="));
            let holds = outcome.success && !complaints;
            println!("{:<30} {source:<9} {} {how}", machine.name, if holds { "holds" } else { "FAILS" });
            if !holds {
                println!("  {}", outcome.log.join("\n  "));
                good = false;
            }
        }
    }
    Ok(good)
}

/// The first program of the README works, compiled as the README says, in a folder that has what it names.
fn readme(archives: &Archives) -> Result<bool> {
    let Some(archive) = archives.get(HOST.triple).filter(|_| HOST.has_compiler()) else { return Ok(true) };
    let text = crate::read("../../sph-core/c/README.md")?;
    let block = |language: &str, which: usize| {
        let rest = text.split(&format!("```{language}\n")).nth(which)?;
        rest.split("```").next()
    };
    let folder = target_dir().join("c/readme");
    let (include, built) = (folder.join("sph-core/c/include"), folder.join("target/fast"));
    std::fs::create_dir_all(&include)?;
    std::fs::create_dir_all(&built)?;
    std::fs::write(include.join("fluisim.h"), crate::read("../../sph-core/c/include/fluisim.h")?)?;
    std::fs::copy(&archive.path, built.join("libfluisim_c.a"))?;
    std::fs::write(folder.join("main.c"), block("c", 1).context("the README has no program")?)?;
    let commands = block("sh", 2).context("the README does not say how it is compiled")?;
    let printed = machine::run(Command::new("sh").args(["-ec", commands]).current_dir(&folder))?;
    let height = printed.split_whitespace().nth(1).and_then(|y| y.parse::<f64>().ok());
    println!("\nthe README's program prints {}", printed.trim());
    Ok(height.is_some_and(|y| (0.0..3.0).contains(&y)))
}
