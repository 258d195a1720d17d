//! The pendant on boards: its firmware for a Raspberry Pi Pico runs whole on rp2040js, that for an LM3S6965 on QEMU, and what
//! their displays show is held against pictures.

use crate::c::target_dir;
use crate::compile;
use crate::elf::is_panic;
use crate::target::{M0, M3, Target};
use crate::{node, table, uf2};
use anyhow::{Context, Result, bail};
use object::{Object, ObjectSymbol};
use std::path::{Path, PathBuf};
use std::process::Command;

const HEAD: &str = "board,scalar,particles,quantity,number";

/// Builds both firmwares, runs them and compares pictures and times, or replaces those; true when everything holds.
pub(crate) fn check(update: bool) -> Result<bool> {
    let out = target_dir().join("board");
    std::fs::create_dir_all(&out)?;
    let here = crate::root().join("board");
    for script in std::fs::read_dir(here.join("emulator"))? {
        let script = script?;
        std::fs::copy(script.path(), out.join(script.file_name()))?;
    }
    node::install("rp2040js", &here.join("emulator"), &out)?;
    let pictures = here.join("golden");
    let (uf2, oled) = (pico(&out)?, build(&M3, "oled")?);
    println!("\nboard: {}", uf2.display());
    let mut good = node::run(&with_update(&[&out.join("oled.mjs"), &oled, &pictures, &out], update))?;
    let gif = crate::root().join("../../docs/pictures/pico.gif");
    let arguments = with_update(&[&out.join("run.mjs"), &uf2, &pictures, &out, &gif], update);
    let run = Command::new("node").args(arguments).output().context("cannot start node")?;
    eprint!("{}", String::from_utf8_lossy(&run.stderr));
    good &= run.status.success();
    let rows: Vec<_> = String::from_utf8(run.stdout)?.lines().map(str::to_owned).collect();
    good &= table::check("board.csv", HEAD, &rows, update)?;
    Ok(good)
}

fn with_update(arguments: &[&PathBuf], update: bool) -> Vec<PathBuf> {
    let flag = update.then(|| PathBuf::from("--update"));
    arguments.iter().map(|&path| path.clone()).chain(flag).collect()
}

/// The firmware of the Pico as a file to drop on it.
fn pico(out: &Path) -> Result<PathBuf> {
    let elf = build(&Target { machine: "rp2040", ..M0 }, "pico")?;
    let file = out.join("fluisim-pendant.uf2");
    std::fs::write(&file, uf2::of_elf(&elf)?).with_context(|| format!("cannot write {}", file.display()))?;
    Ok(file)
}

/// The firmware of this name, as it is shipped; an error where it can panic.
fn build(target: &Target, name: &str) -> Result<PathBuf> {
    let arguments = ["-p", "fluisim-board", "--bin", name, "--profile", "fast"];
    let built = compile::build(target, &arguments)?;
    let path = built.first().context("nothing was built")?.path.clone();
    let bytes = std::fs::read(&path)?;
    let file = object::File::parse(&*bytes)?;
    let names = file.symbols().filter_map(|symbol| symbol.name().ok());
    let panics: Vec<_> = names.filter(|name| is_panic(name)).collect();
    if !panics.is_empty() {
        bail!("{name} can panic: {panics:?}");
    }
    Ok(path)
}
