//! Every case at three resolutions: the tables of `docs/validation.md`.
//!
//! `cargo bench -p sph-host --bench validation`, with `-- NAME` for the case of that name alone. Takes some minutes.

use std::error::Error;
use std::path::Path;

use sph_host::run::{self, CaseName, Options};

/// A case, its resolutions, and the column of the series that is compared with that of the finest.
const CASES: [(CaseName, [u32; 3], &str); 5] = [
    (CaseName::DamBreak, [20, 40, 80], "front_x"),
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
            report(case, resolutions, column)?;
        }
    }
    Ok(())
}

/// Prints the checks of three runs side by side, and how a column compares.
fn report(case: CaseName, resolutions: [u32; 3], column: &str) -> Result<(), Box<dyn Error>> {
    let [coarse, middle, fine] = resolutions;
    println!("| {} | {coarse} | {middle} | {fine} | goal |\n|---|---|---|---|---|", case.name());
    let mut runs = Vec::new();
    for resolution in resolutions {
        let out = tempfile::tempdir()?;
        let options = Options { resolution: Some(resolution), ..Options::new(case, out.path().to_owned()) };
        let summary = run::run(&options, &())?;
        runs.push((summary, read(out.path(), column)?));
    }
    for (k, check) in runs[0].0.checks.iter().enumerate() {
        let values = runs.iter().map(|(summary, _)| summary.checks[k].value);
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
fn read(folder: &Path, column: &str) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(folder.join("series.csv"))?;
    let index = reader.headers()?.iter().position(|name| name == column).ok_or("no such column")?;
    let mut values = Vec::new();
    for record in reader.records().skip(1) {
        values.push(record?[index].parse()?);
    }
    if values.is_empty() { Err("no rows".into()) } else { Ok(values) }
}
