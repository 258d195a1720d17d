//! Small runs of every case, with bounds on both sides, and what does not depend on how a run is run.

use std::fs;
use std::path::Path;

use super::*;

fn options(case: CaseName, resolution: u32, out: &Path) -> Options {
    Options { resolution: Some(resolution), ..Options::new(case, out.to_owned()) }
}

/// Drives a case in a quarter of the usual frames, and gives its checks.
fn checks<const D: usize>(case: &dyn Case<D>, scalar: ScalarName, duration: f64) -> Vec<(String, f64)> {
    let method = Method { solver: Solver::Wcsph, scalar, kernel: KernelName::WendlandC2 };
    let mut drive = Drive::new(case, method, duration / 10.0).unwrap();
    let mut last = drive.next_frame(duration, &()).unwrap();
    while drive.frames < drive.frames_in(duration) {
        last = drive.next_frame(duration, &()).unwrap();
    }
    drive.checks(&last).into_iter().map(|check| (check.name, check.value)).collect()
}

#[track_caller]
fn between(found: &(String, f64), least: f64, most: f64) {
    assert!((least..=most).contains(&found.1), "{found:?}: {least} to {most} expected");
}

#[test]
fn a_dam_breaks_as_computed_by_others() {
    let found = checks::<2>(&case::DamBreak { resolution: 12 }, ScalarName::F64, 0.28);
    between(&found[0], 0.005, 0.06);
    between(&found[1], 0.06, 0.13);
    between(&found[3], 0.0, 0.0);
}

#[test]
fn a_dam_breaks_in_three_dimensions() {
    let found = checks::<3>(&case::DamBreak { resolution: 8 }, ScalarName::F32, 0.02);
    let [energy, outside] = [&found[2], &found[3]];
    between(energy, 0.0, 1e-2);
    between(outside, 0.0, 0.0);
}

#[test]
fn water_at_rest_stays_at_rest() {
    let found = checks(&case::Hydrostatic { resolution: 12 }, ScalarName::F64, 1.0);
    between(&found[0], 1e-4, 0.05);
    between(&found[1], 1e-12, 1e-4);
}

#[test]
fn a_drop_becomes_the_exact_ellipse() {
    for (scalar, rounding) in [(ScalarName::F64, 1e-13), (ScalarName::F32, 1e-5)] {
        let case = case::Drop { resolution: 15, rounding };
        let found = checks(&case, scalar, case.duration());
        between(&found[0], 1e-5, 0.03);
        between(&found[1], 1e-5, 0.02);
        between(&found[3], 1e-20, rounding);
        between(&found[4], 1e-20, rounding);
    }
}

#[test]
fn vortices_decay_as_they_must() {
    let found = checks(&case::TaylorGreen { resolution: 20, rounding: 1e-12 }, ScalarName::F64, 1.0);
    between(&found[0], -0.1, 0.1);
    between(&found[1], 0.0, 1e-12);
}

#[test]
fn a_channel_flow_starts_as_the_series_says() {
    let found = checks(&case::Poiseuille { resolution: 16 }, ScalarName::F64, 0.225);
    for profile in &found[..4] {
        between(profile, 1e-4, 0.04);
    }
}

fn read(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap()
}

#[test]
fn threads_and_interruptions_change_no_bit() {
    let room = tempfile::tempdir().unwrap();
    let [whole, parted, single] = ["whole", "parted", "single"].map(|name| room.path().join(name));
    for scalar in [ScalarName::F64, ScalarName::F32] {
        let set = |out: &Path, time: f64| Options {
            time: Some(time),
            every: Some(0.01),
            scalar: Some(scalar),
            threads: Some(3),
            ..options(CaseName::DamBreak, 8, out)
        };
        run(&set(&whole, 0.04), &()).unwrap();
        run(&set(&parted, 0.02), &()).unwrap();
        run(&Options { resume: true, ..set(&parted, 0.04) }, &()).unwrap();
        run(&Options { threads: Some(1), ..set(&single, 0.04) }, &()).unwrap();
        for file in
            ["series.csv", "frame_0004.vtu", "frame_0004.png", "frames.pvd", "front.png", "animation.gif"]
        {
            let expected = read(&whole.join(file));
            assert!(expected == read(&parted.join(file)), "{file} of a resumed run");
            assert!(expected == read(&single.join(file)), "{file} of one thread");
        }
        for folder in [&whole, &parted, &single] {
            fs::remove_dir_all(folder).unwrap();
        }
    }
}

#[test]
fn an_earlier_run_is_kept_unless_told_otherwise() {
    let room = tempfile::tempdir().unwrap();
    let short =
        Options { time: Some(1e-3), every: Some(1e-3), ..options(CaseName::Hydrostatic, 8, room.path()) };
    let summary = run(&short, &()).unwrap();
    for name in
        ["particles", "steps", "simulated_s", "wall_s", "mass_drift", "momentum_drift", "energy_drift"]
    {
        assert!(summary.json[name].is_number(), "{name}");
    }
    assert!(summary.json["checks"].as_array().is_some_and(|checks| checks.len() == summary.checks.len()));
    let before = read(&room.path().join("series.csv"));
    let refused = run(&short, &()).unwrap_err();
    assert_eq!(refused.status(), 1);
    assert!(refused.to_string().contains("--resume"), "{refused}");
    assert_eq!(before, read(&room.path().join("series.csv")));
    let other = Options { resume: true, resolution: Some(9), ..short.clone() };
    assert!(run(&other, &()).unwrap_err().to_string().contains("resolution 8"));
    run(&Options { force: true, ..short }, &()).unwrap();
}

#[test]
fn contradictions_are_wrong_usage() {
    let room = tempfile::tempdir().unwrap();
    let base = options(CaseName::Drop, 8, room.path());
    let wrong = [
        Options { dim: 3, ..base.clone() },
        Options { resolution: Some(2), ..base.clone() },
        Options { every: Some(1.0), ..base.clone() },
        Options { scalar: Some(ScalarName::I16F16), ..base },
    ];
    for options in wrong {
        assert_eq!(run(&options, &()).unwrap_err().status(), 2, "{options:?}");
    }
}
