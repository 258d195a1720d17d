//! The test suites on every target.

use crate::compile;
use crate::qemu::{self, Outcome};
use crate::target::{M0, TARGETS, Target};
use anyhow::{Result, ensure};

const SUITES: [&str; 4] = ["-p", "fluisim-firmware", "--tests", "--release"];

/// Runs all suites and prints a row for each target; true when everything passed.
pub(crate) fn check() -> Result<bool> {
    println!("\n{:<30} {:<12} {:>6} {:>6}", "target", "machine", "passed", "failed");
    let mut good = true;
    for (target, suites) in compile::build_for(&TARGETS, &SUITES)? {
        let (mut passed, mut failed) = (0, 0);
        for firmware in suites {
            let outcome = qemu::run(&target, &firmware.path, &[])?;
            let (begun, total) = progress(&outcome);
            if outcome.success && begun == total && total > 0 {
                passed += total;
            } else {
                let done = begun.saturating_sub(1);
                passed += done;
                failed += total.max(1) - done;
                println!("{} {}:\n  {}", target.triple, firmware.name, outcome.log.join("\n  "));
            }
        }
        println!("{:<30} {:<12} {passed:>6} {failed:>6}", target.triple, target.machine);
        good &= failed == 0 && passed > 0;
    }
    Ok(good)
}

/// A test that fails on purpose must be seen to fail.
pub(crate) fn self_check() -> Result<bool> {
    let target: Target = M0;
    let arguments = ["-p", "fluisim-firmware", "--test", "scalars", "--release", "--features", "broken"];
    let mut noticed = false;
    for firmware in compile::build(&target, &arguments)? {
        let outcome = qemu::run(&target, &firmware.path, &[])?;
        let broken = outcome.log.iter().any(|line| line.contains("this_test_is_broken"));
        ensure!(broken, "the broken test was not built");
        noticed = !outcome.success;
    }
    println!("\nself-check: a broken test is {}", if noticed { "noticed" } else { "NOT noticed" });
    Ok(noticed)
}

/// How many tests were begun, and how many there are: from the last line "(3/7) running `name`...".
fn progress(outcome: &Outcome) -> (usize, usize) {
    let counts = outcome.log.iter().rev().find_map(|line| {
        let (counts, _) = line.strip_prefix('(')?.split_once(')')?;
        let (begun, total) = counts.split_once('/')?;
        Some((begun.parse().ok()?, total.parse().ok()?))
    });
    counts.unwrap_or_default()
}
