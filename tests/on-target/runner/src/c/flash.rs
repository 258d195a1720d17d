//! Flash of the same work in C and in Rust: a fluid that is made when the program runs, in memory of zeros, and numbers that the compiler does
//! not know.

use super::{Archives, Context, Elf, M0, M4F, Machine, Program, Result, ensure, table};
use crate::compile;
use crate::target::{self, Target};

/// How much more C should take at most.
const MARGIN: f64 = 1.10;

/// Measures both and compares with the table, or replaces it; true when no row has grown. Where C is beyond the margin, it says so.
pub(crate) fn check(archives: &Archives, update: bool) -> Result<bool> {
    let mut rows = Vec::new();
    for (machine, target) in [(M0, target::M0), (M4F, target::M4F)] {
        let Some(archive) = archives.get(machine.triple).filter(|_| machine.has_compiler()) else { continue };
        let in_c = |options: &[&str]| flash(&machine, &archive.path, options);
        let empty = in_c(&["-DEMPTY"])?;
        let rust = in_rust(&target)?;
        for (scalar, option, rust) in [("f32", "-DFLOATING", rust[0]), ("i16f16", "-DFIXED", rust[1])] {
            let c = in_c(&[option])? - empty;
            rows.push(format!("{},{scalar},C,{c}", machine.triple));
            rows.push(format!("{},{scalar},Rust,{rust}", machine.triple));
            if c as f64 > rust as f64 * MARGIN {
                println!("{} {scalar}: {c} bytes in C, {rust} in Rust", machine.triple);
                println!("  the aim, a tenth more, is missed");
            }
        }
    }
    table::check("c.csv", "target,scalar,language,flash", &rows, update)
}

fn flash(machine: &Machine, archive: &std::path::Path, options: &[&str]) -> Result<u64> {
    let elf = machine.build(archive, &Program { source: "flash.c", options, standard: "c11" })?;
    Elf::flash(&elf)
}

/// In f32 and in fixed point.
fn in_rust(target: &Target) -> Result<[u64; 2]> {
    let arguments = [
        "-p",
        "fluisim-footprint",
        "--profile",
        "fast",
        "--bin",
        "empty",
        "--bin",
        "pendant",
        "--bin",
        "fixed_pendant",
    ];
    let built = compile::build(target, &arguments)?;
    let read = |name: &str| {
        Elf::read(&built.iter().find(|firmware| firmware.name == name).context("a binary is missing")?.path)
    };
    let empty = read("empty")?;
    let of = |name| {
        let elf = read(name)?;
        ensure!(elf.panics().is_empty(), "{name} can panic: {:?}", elf.panics());
        ensure!(elf.ram - empty.ram == elf.promised, "{name}: RAM is not what size_of says");
        Ok(elf.flash - empty.flash)
    };
    Ok([of("pendant")?, of("fixed_pendant")?])
}
