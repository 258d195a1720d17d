//! What does not depend on how a run is run, and what is refused.

use super::*;
use crate::kernel_choice::KernelName;
use crate::scalar_choice::ScalarName;

/// The value of each check of a case, in a fifth of the usual frames.
pub(super) fn values(case: CaseName, resolution: u32, scalar: ScalarName, time: Option<f64>) -> Vec<f64> {
    let every = time.map(|time| time / 10.0);
    let options =
        Options { resolution: Some(resolution), scalar: Some(scalar), time, every, ..Options::new(case) };
    let (summary, _) = simulate(&options, &()).unwrap();
    summary.checks.iter().map(|check| check.value.unwrap_or(f64::NAN)).collect()
}

#[track_caller]
pub(super) fn assert_within(values: &[f64], bounds: &[[f64; 2]]) {
    for (k, (value, [least, most])) in values.iter().zip(bounds).enumerate() {
        assert!((least..=most).contains(&value), "check {k}: {value}, expected {least} to {most}");
    }
}

#[test]
fn in_memory_and_into_a_directory_it_is_the_same_run() {
    let room = tempfile::tempdir().unwrap();
    let options = Options {
        resolution: Some(8),
        time: Some(0.01),
        every: Some(0.005),
        ..Options::new(CaseName::DamBreak)
    };
    let (summary, series) = simulate(&options, &()).unwrap();
    let output = Output { directory: room.path().join("dam"), earlier: Earlier::Keep, pictures: false };
    let written = run(&options, &output, &()).unwrap();
    assert_eq!(summary.checks, written.checks);
    let text = std::fs::read_to_string(output.directory.join("series.csv")).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(series.rows, rows);
    assert_eq!(series.columns.join(","), text.lines().next().unwrap());
}

#[test]
fn errors_hold_what_was_found_and_what_is_possible() {
    let base = Options { resolution: Some(8), time: Some(1e-3), ..Options::new(CaseName::Drop) };
    let refused = |options: Options| simulate(&options, &()).map(|_| ()).unwrap_err();
    assert!(matches!(
        refused(Options { resolution: Some(2), ..base.clone() }),
        Error::Resolution { found: 2, least: 8, most: 2000 }
    ));
    let deep = Options { resolution: Some(1000), dim: Some(3), ..Options::new(CaseName::DamBreak) };
    assert!(matches!(refused(deep), Error::Resolution { found: 1000, least: 8, most: 256 }));
    assert!(matches!(refused(Options { dim: Some(3), ..base.clone() }), Error::Dimensions { found: 3, .. }));
    assert!(matches!(refused(Options { dim: Some(1), ..base.clone() }), Error::Dimensions { found: 1, .. }));
    assert!(matches!(
        refused(Options { every: Some(1.0), ..base.clone() }),
        Error::TooFewFrames { every: 1.0, time: 1e-3 }
    ));
    assert!(matches!(refused(Options { every: Some(1e-9), ..base.clone() }), Error::TooManyFrames { .. }));
    assert!(matches!(
        refused(Options { scalar: ScalarName::of_name("i16f16"), ..base.clone() }),
        Error::ScalarForSolver { scalar: ScalarName::Fixed(_), solver: Solver::Wcsph }
    ));
    assert!(matches!(
        refused(Options { kernel: Some(KernelName::Viscosity), ..base.clone() }),
        Error::KernelForSolver { kernel: KernelName::Viscosity, .. }
    ));
    assert!(matches!(
        refused(Options { solver: Some(Solver::Pbf), ..base }),
        Error::SolverForCase { solver: Solver::Pbf, case: CaseName::Drop }
    ));
}

#[test]
fn no_word_of_the_command_is_in_an_error() {
    let errors = [
        Error::Resolution { found: 2, least: 8, most: 2000 },
        Error::TooManyFrames { every: 1e-9, time: 1.0, most: 10 },
        Error::SolverForCase { solver: Solver::Pbf, case: CaseName::Drop },
        Error::KernelForSolver { kernel: KernelName::Spiky, solver: Solver::Pbf },
        Error::Taken("dam".into()),
    ];
    for error in errors {
        assert!(!error.to_string().contains("--"), "{error}");
    }
}
