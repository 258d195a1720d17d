//! A committed table of measurements: the last column of a row is a number that must not grow unnoticed.

use crate::target::M4F;
use crate::toolchain::Toolchain;
use anyhow::{Context, Result};

/// A row grows by more than this fraction only with the table being updated.
const TOLERANCE: f64 = 0.02;

/// Compares with the committed table, or replaces it; true when no row is new and none has grown.
///
/// The first line names the compiler. Another one makes other code, so growth is then told but not held against anyone.
pub(crate) fn check(file: &str, head: &str, rows: &[String], update: bool) -> Result<bool> {
    let compiler = format!("# {}", Toolchain::find(M4F.triple)?.version());
    let rows = rows.join("\n");
    println!("\n{head}\n{rows}");
    if update {
        return crate::write(file, &format!("{compiler}\n{head}\n{rows}\n")).map(|()| true);
    }
    let committed = crate::read(file)?;
    let grown = grown(file, &committed, &rows)?;
    let same_compiler = committed.lines().next() == Some(&compiler);
    if grown && !same_compiler {
        println!("{file} was measured with another compiler: no failure");
    }
    Ok(!grown || !same_compiler)
}

fn grown(file: &str, committed: &str, rows: &str) -> Result<bool> {
    let mut grown = false;
    for row in rows.lines() {
        let (key, now) = split(row)?;
        let before =
            committed.lines().skip(2).find_map(|row| split(row).ok().filter(|(name, _)| *name == key));
        let complaint = match before {
            Some((_, before)) if now <= before * (1.0 + TOLERANCE) => continue,
            Some((_, before)) => format!("has grown from {before} to {now}"),
            None => format!("is not in {file}"),
        };
        println!("{key} {complaint}: make it smaller, or run with --update");
        grown = true;
    }
    Ok(grown)
}

/// The row's name and its number.
fn split(row: &str) -> Result<(&str, f64)> {
    let (key, number) = row.rsplit_once(',').context("a row of several columns")?;
    Ok((key, number.parse().context("a number in the last column")?))
}
