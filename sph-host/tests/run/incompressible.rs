//! The incompressible solver: what is promised of it in every case that it simulates.

use serde_json::Value;

use crate::support::{Columns, Folder};

fn summary(folder: &Folder, place: &str) -> Value {
    serde_json::from_slice(&folder.bytes(&format!("{place}/summary.json"))).unwrap()
}

fn steps_of(summary: &Value) -> u64 {
    summary["steps"].as_u64().unwrap()
}

fn series(folder: &Folder, place: &str) -> Columns {
    Columns::parse(&String::from_utf8(folder.bytes(&format!("{place}/series.csv"))).unwrap())
}

#[test]
fn threads_and_interruptions_change_no_byte() {
    let folder = Folder::new();
    for (case, every) in [("dam-break --scalar f32", 0.03), ("dam-break --scalar f64", 0.03), ("tilt", 0.2)] {
        let run = format!("run {case} --solver incompressible --resolution 8 --every {every}");
        let [whole, part] = [4.0, 2.3].map(|frames| frames * every);
        for threads in 1..=3 {
            folder.succeed(&format!("{run} --time {whole} --out {threads} --threads {threads} --force"));
        }
        folder.succeed(&format!("{run} --time {part} --out parted --force"));
        folder.succeed(&format!("{run} --time {whole} --out parted --resume"));
        for other in ["2", "3", "parted"] {
            for file in ["series.csv", "frame_0004.vtu", "frame_0004.png", "frames.pvd", "animation.gif"] {
                let [a, b] = ["1", other].map(|place| folder.bytes(&format!("{place}/{file}")));
                assert!(a == b, "{case}: {file} of 1 and {other} differ");
            }
        }
    }
}

#[test]
fn a_dam_breaks_in_two_and_three_dimensions() {
    let folder = Folder::new();
    for (dim, resolution) in [(2, 12), (3, 8)] {
        let place = format!("dam{dim}");
        folder.succeed(&format!(
            "run --solver incompressible --dim {dim} --resolution {resolution} --time 0.2 --every 0.1 --no-pictures \
             --out {place}"
        ));
        let summary = summary(&folder, &place);
        assert_eq!((&summary["solver"], &summary["scalar"]), (&"incompressible".into(), &"f32".into()));
        assert!(summary["put_back"].as_u64().unwrap() <= steps_of(&summary));
        let iterations = summary["iterations"].as_u64().unwrap();
        assert!((2 * steps_of(&summary)..20 * steps_of(&summary)).contains(&iterations), "{iterations}");
        let series = series(&folder, &place);
        let front = series.get("front_x");
        assert!(front[0] < 0.15 && front.last().is_some_and(|&x| x > 0.35 && x < 0.55), "{front:?}");
        assert!(series.get("mean_density_error").iter().all(|&error| error < 2e-3));
        assert!(series.get("max_density_error").iter().all(|&error| error < 0.1));
        assert!(series.get("outside").iter().all(|&outside| outside == 0.0));
        let steps = series.get("steps");
        assert!(
            steps.is_sorted() && steps.last().is_some_and(|&steps| steps < 400.0),
            "long steps: {steps:?}"
        );
    }
}

#[test]
fn a_drop_keeps_its_momentum_and_becomes_the_ellipse() {
    let folder = Folder::new();
    folder.succeed("run drop --solver incompressible --scalar f64 --resolution 12 --no-pictures --out drop");
    let checks = summary(&folder, "drop")["checks"].clone();
    let value = |name: &str| {
        let check =
            checks.as_array().unwrap().iter().find(|check| check["name"].as_str().unwrap().starts_with(name));
        check.unwrap_or_else(|| panic!("{name}: {checks}"))["value"].as_f64().unwrap()
    };
    assert!(value("momentum error") < 1e-12 && value("angular momentum error") < 1e-12, "{checks}");
    assert!(value("growth of total energy") < 2e-3, "{checks}");
    assert!(value("semi-axis x") < 0.06 && value("semi-axis y") < 0.06, "{checks}");
}

#[test]
fn a_box_that_is_turned_ends_level_at_its_height() {
    let folder = Folder::new();
    folder.succeed("run tilt --solver incompressible --resolution 12 --every 1 --no-pictures --out box");
    let summary = summary(&folder, "box");
    for check in summary["checks"].as_array().unwrap() {
        assert_eq!(check["holds"], true, "{check}");
    }
}
