//! Every case and solver at three resolutions: the tables of `docs/validation.md`.
//!
//! `cargo bench -p sph-host --bench validation`, with `-- NAME` for the case of that name alone. Takes some minutes.

use std::error::Error;

use sph_host::run::{self, CaseName, Options, Series, Solver};

/// A case, its resolutions, and the column of the series that is compared with that of the finest.
const CASES: [(CaseName, [u32; 3], &str); 6] = [
    (CaseName::DamBreak, [20, 40, 80], "front_x"),
    (CaseName::Impact, [20, 40, 80], "wall_pressure"),
    (CaseName::Hydrostatic, [20, 40, 80], "pressure_error"),
    (CaseName::Drop, [20, 40, 80], "semi_axis_y"),
    (CaseName::TaylorGreen, [25, 50, 100], "velocity_error"),
    (CaseName::Poiseuille, [20, 40, 80], "profile_error"),
];

fn main() -> Result<(), Box<dyn Error>> {
    // cargo adds --bench
    let wanted = std::env::args().skip(1).find(|word| word != "--bench");
    for (case, resolutions, column) in CASES {
        if wanted.as_ref().is_none_or(|name| *name == case.name()) {
            for &solver in case.solvers() {
                report(case, solver, resolutions, column)?;
            }
        }
    }
    Ok(())
}

/// Prints the checks of three runs side by side, and how a column compares.
fn report(case: CaseName, solver: Solver, resolutions: [u32; 3], column: &str) -> Result<(), Box<dyn Error>> {
    let [coarse, middle, fine] = resolutions;
    println!("| {case}, {solver} | {coarse} | {middle} | {fine} | goal |\n|---|---|---|---|---|");
    let mut runs = Vec::new();
    for resolution in resolutions {
        let options = Options { resolution: Some(resolution), solver: Some(solver), ..Options::new(case) };
        let (summary, series) = run::simulate(&options, &())?;
        runs.push((summary, values(&series, column)));
    }
    for (k, check) in runs[0].0.checks.iter().enumerate() {
        let values = runs.iter().map(|(summary, _)| summary.checks[k].value.unwrap_or(f64::NAN));
        println!("| {} | {} | {} |", check.name, cells(values), check.goal);
    }
    println!("| {column} at the end | {} | |", cells(runs.iter().map(|(_, rows)| rows[rows.len() - 1])));
    // rows of one case are at the same times whatever the resolution
    let finest = &runs[2].1;
    let difference = |rows: &[f64]| {
        let squares: f64 = rows.iter().zip(finest).map(|(a, b)| (a / b - 1.0).powi(2)).sum();
        (squares / rows.len() as f64).sqrt()
    };
    println!(
        "| {column} against the finest, RMS | {} | |\n",
        cells(runs.iter().map(|(_, rows)| difference(rows)))
    );
    Ok(())
}

fn cells(values: impl Iterator<Item = f64>) -> String {
    values.map(|value| format!("{value:.2e}")).collect::<Vec<_>>().join(" | ")
}

/// A column of the series without its first row, at which all errors are zero.
fn values(series: &Series, column: &str) -> Vec<f64> {
    series.column(column).into_iter().skip(1).map(|point| point[1]).collect()
}
