//! The Arduino library: its examples compiled without a warning for every folder of an archive, and run on this computer over a mock
//! of Arduino's core.

use super::archive::target_dir;
use super::machine::{HOST, is_there, run};
use super::packages::{ARDUINO, Packages};
use super::{Context, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

const EXAMPLES: [&str; 3] = ["SerialPicture", "LedMatrix", "OledTilt"];
const FRAMES: &str = "400";

/// Which way a key tilts, as columns to the right and rows upwards.
const TILTS: [(&str, [f64; 2]); 4] =
    [("a", [-1.0, 0.0]), ("d", [1.0, 0.0]), ("w", [0.0, 1.0]), ("s", [0.0, -1.0])];

/// True when every example links on every ARM processor and shows, on this computer, a fluid that lies where it is tilted to.
pub(crate) fn check(packages: &Packages, on_host: bool) -> Result<bool> {
    println!("\n{:<30} example", "Arduino library on");
    // one example for each folder, in turn
    for ((folder, _, flags), example) in ARDUINO.into_iter().zip(EXAMPLES.into_iter().cycle()) {
        if flags.is_empty() || !is_there("arm-none-eabi-g++") {
            println!("{folder:<30} SKIPPED: there is no compiler with a C library for it here");
            continue;
        }
        let archive = packages.arduino.join("src").join(folder).join("libfluisim.a");
        let flags = [&["-mthumb", "--specs=nosys.specs", "-Wl,--gc-sections"], flags].concat();
        build(packages, example, ("arm-none-eabi-", &flags), &archive)?;
        println!("{folder:<30} {example} links");
    }
    let mut good = true;
    for example in EXAMPLES.into_iter().filter(|_| on_host && HOST.has_compiler()) {
        let flows = flows(packages, example)?;
        let outcome = if flows { "flows" } else { "FAILS to flow" };
        println!("{:<30} {example} {outcome} to each of four sides", HOST.name);
        good &= flows;
    }
    Ok(good)
}

/// Whether an example, on this computer, shows a fluid on each side that it is tilted to.
fn flows(packages: &Packages, example: &str) -> Result<bool> {
    let archive = packages.cmake.join("lib").join(HOST.triple).join("libfluisim.a");
    let program = build(packages, example, ("", &[]), &archive)?;
    let mut good = true;
    for (key, tilt) in TILTS {
        let printed = run(Command::new(&program).args([key, FRAMES]))?;
        let picture = last_picture(&printed);
        if !leans(&picture, tilt) {
            println!("  tilted by {key} it shows\n{}", picture.join("\n"));
            good = false;
        }
    }
    Ok(good)
}

/// Compiles a sketch and the mock and links them with an archive.
fn build(
    packages: &Packages,
    example: &str,
    (prefix, flags): (&str, &[&str]),
    archive: &Path,
) -> Result<PathBuf> {
    let (mock, out) = (crate::root().join("c/arduino"), target_dir().join("c/programs"));
    std::fs::create_dir_all(&out)?;
    let sketch = packages.arduino.join("examples").join(example).join(format!("{example}.ino"));
    let mut objects = Vec::new();
    for source in [sketch, mock.join("mock.cpp")] {
        let object = out.join(source.file_name().context("a name")?).with_extension("sketch.o");
        let mut compile = Command::new(format!("{prefix}g++"));
        compile.args(flags.iter().filter(|flag| !flag.starts_with("-W") && !flag.starts_with("--")));
        compile.args(["-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror", "-x", "c++", "-c"]);
        compile.arg("-I").arg(&mock).arg("-I").arg(packages.arduino.join("src"));
        run(compile.arg(source).arg("-o").arg(&object))?;
        objects.push(object);
    }
    let program = out.join(format!("sketch-{example}"));
    // the C compiler links: the mock needs nothing of the C++ library
    let mut link = Command::new(format!("{prefix}gcc"));
    run(link.args(flags).args(objects).arg(archive).arg("-lm").arg("-o").arg(&program))?;
    Ok(program)
}

/// The rows of the last picture that was printed, from the top: what stands between two bars.
fn last_picture(printed: &str) -> Vec<&str> {
    let is_row = |line: &&str| line.len() > 2 && line.starts_with('|') && line.ends_with('|');
    let mut rows: Vec<_> =
        printed.lines().rev().skip_while(|line| !is_row(line)).take_while(is_row).collect();
    rows.reverse();
    rows
}

/// Whether what is drawn lies on one side, by a quarter of half the picture's size or more.
fn leans(rows: &[&str], [right, up]: [f64; 2]) -> bool {
    let (mut count, mut sum) = (0.0, 0.0);
    for (row, line) in rows.iter().enumerate() {
        let width = line.len() as f64 - 2.0;
        for (column, _) in line.bytes().skip(1).enumerate().filter(|&(_, letter)| !b" |".contains(&letter)) {
            let across = |place: usize, size: f64| (2.0 * place as f64 + 1.0) / size - 1.0;
            sum += right * across(column, width) - up * across(row, rows.len() as f64);
            count += 1.0;
        }
    }
    count > 0.0 && sum > 0.25 * count
}
