//! Builds the firmware for every target, runs it under QEMU and holds the outcome against what is committed.

mod board;
mod c;
mod compile;
mod counts;
mod cycles;
mod digests;
mod elf;
mod fluid;
mod footprint;
mod hardware;
mod node;
mod panics;
mod qemu;
mod suites;
mod sysroot;
mod table;
mod target;
mod toolchain;
mod uf2;
mod web;

use anyhow::{Context, Result, bail};
use lexopt::Arg::{Long, Value};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use toolchain::Toolchain;

const USAGE: &str = "usage: tests/on-target/run [OPTION]

Without an option, everything: the suites and the digests under QEMU, the search for panics, the footprint, the
counts of instructions, the fluid, its cycles, the example for real chips, the C library, the page for browsers, the
pendant on boards.

  --only PART         one of: suites, self-check, digests, panics, footprint, counts, fluid, cycles, hardware, c, web,
                      board
  --self-check        the same as --only self-check
  --pack              the C library as packages for Arduino, CMake and ESP-IDF; judges nothing
  --overflow-checks   what can panic when integer overflow is checked; judges nothing
  --update            replaces the committed tables, and the pictures of the boards
  --update-golden     replaces the golden digests by those of this computer";

/// What is to be done.
#[derive(Default)]
struct Options {
    only: Option<String>,
    pack: bool,
    overflow_checks: bool,
    update: bool,
    update_golden: bool,
}

fn main() -> ExitCode {
    match options().and_then(|options| run(&options)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("\non-target: FAILED");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("on-target: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn options() -> Result<Options> {
    let mut options = Options::default();
    let mut arguments = lexopt::Parser::from_env();
    while let Some(argument) = arguments.next()? {
        match argument {
            Long("only") => options.only = Some(arguments.value()?.to_string_lossy().into_owned()),
            Long("self-check") => options.only = Some("self-check".into()),
            Long("pack") => options.pack = true,
            Long("overflow-checks") => options.overflow_checks = true,
            Long("update") => options.update = true,
            Long("update-golden") => options.update_golden = true,
            Long("help") => {
                println!("{USAGE}");
                std::process::exit(0);
            }
            Long(_) | Value(_) | lexopt::Arg::Short(_) => bail!("{}\n{USAGE}", argument.unexpected()),
        }
    }
    Ok(options)
}

fn run(options: &Options) -> Result<bool> {
    if options.pack {
        return c::pack().map(|()| true);
    }
    toolchain::require_programs()?;
    println!("toolchains");
    for target in target::TARGETS {
        println!("{:<30} {}", target.triple, Toolchain::find(target.triple)?.description());
    }
    let wasm =
        Toolchain::find(digests::WASM).map_or("none: digests skip it".into(), |found| found.description());
    println!("{:<30} {wasm}", digests::WASM);
    if options.update_golden {
        return digests::update().map(|()| true);
    }
    if options.overflow_checks {
        return panics::with_overflow_checks().map(|()| true);
    }
    let parts: [(&str, &dyn Fn() -> Result<bool>); 12] = [
        ("suites", &suites::check),
        ("self-check", &suites::self_check),
        ("digests", &digests::check),
        ("panics", &panics::check),
        ("footprint", &|| footprint::check(options.update)),
        ("counts", &|| counts::check(options.update)),
        ("fluid", &|| fluid::check(options.update)),
        ("cycles", &|| cycles::check(options.update)),
        ("hardware", &hardware::check),
        ("c", &|| c::check(options.update)),
        ("web", &web::check),
        ("board", &|| board::check(options.update)),
    ];
    let chosen = |name: &str| options.only.as_deref().is_none_or(|only| only == name);
    if !parts.iter().any(|(name, _)| chosen(name)) {
        bail!("there is no part {:?}\n{USAGE}", options.only.as_deref().unwrap_or_default());
    }
    let mut good = true;
    for (_, part) in parts.iter().filter(|(name, _)| chosen(name)) {
        good &= part()?;
    }
    Ok(good)
}

/// The folder `tests/on-target`.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

fn read(name: &str) -> Result<String> {
    let path = root().join(name);
    std::fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))
}

/// Writes beside the file and renames, so that it is never half written.
fn write(name: &str, text: &str) -> Result<()> {
    let (path, beside): (PathBuf, PathBuf) =
        (root().join(name), root().join(format!(".{name}.tmp").replace('/', "_")));
    std::fs::write(&beside, text).with_context(|| format!("cannot write {}", beside.display()))?;
    std::fs::rename(&beside, &path).with_context(|| format!("cannot write {}", path.display()))
}
