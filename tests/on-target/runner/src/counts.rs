//! Instructions of a pair and of the cell grid, counted by QEMU, which repeats them exactly.

use crate::compile;
use crate::qemu;
use crate::table;
use crate::target::{M0, M4F, RV32, Target};
use anyhow::{Context, Result, ensure};

/// Counts and compares with the table, or replaces it; true when no row has grown.
pub(crate) fn check(update: bool) -> Result<bool> {
    let mut rows = Vec::new();
    // The microbit has no SysTick that counts instructions; the larger machine runs the same code.
    for target in [Target { machine: M4F.machine, ..M0 }, M4F, RV32] {
        let arguments = ["-p", "fluisim-firmware", "--features", "count", "--bin", "count", "--release"];
        let built = compile::build(&target, &arguments)?;
        let firmware = built.first().context("nothing was built")?;
        let outcome = qemu::run(&target, &firmware.path, &["-icount", "shift=0"])?;
        ensure!(outcome.success, "counting failed on {}: {:?}", target.triple, outcome.log.last());
        rows.extend(outcome.log.iter().map(|line| format!("{},{line}", target.triple)));
    }
    table::check("counts.csv", "target,scalar,kernel or search,work,instructions", &rows, update)
}
