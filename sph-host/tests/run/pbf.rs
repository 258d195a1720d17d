//! The position-based fluid: what is promised of it, in every number type it has.

use serde_json::Value;

use crate::support::{Columns, Folder};

fn summary(folder: &Folder, place: &str) -> Value {
    serde_json::from_slice(&folder.bytes(&format!("{place}/summary.json"))).unwrap()
}

#[test]
fn a_box_that_is_turned_meets_its_goals() {
    let folder = Folder::new();
    for scalar in ["f32", "i16f16", "i8f24"] {
        folder
            .succeed(&format!("run tilt --resolution 24 --scalar {scalar} --every 1 --out {scalar} --check"));
        let summary = summary(&folder, scalar);
        assert_eq!((&summary["solver"], &summary["scalar"]), (&"pbf".into(), &scalar.into()));
        assert_eq!(summary["kernel"], "poly6");
        assert_eq!(summary["particles"], 24 * 9);
        let series =
            Columns::parse(&String::from_utf8(folder.bytes(&format!("{scalar}/series.csv"))).unwrap());
        let height = series.get("fluid_height");
        assert!((height[0] / (0.1 * 9.0 / 24.0) - 1.0).abs() < 1e-3, "{height:?}");
        assert!(series.get("max_speed").iter().all(|speed| (0.0..2.0).contains(speed)));
    }
}

#[test]
fn a_resumed_run_ends_with_the_same_bytes() {
    let folder = Folder::new();
    for (case, scalar) in [("tilt", "f32"), ("tilt", "i16f16"), ("dam-break --solver pbf", "fast32")] {
        let run = format!("run {case} --resolution 12 --scalar {scalar} --every 0.2 --force");
        folder.succeed(&format!("{run} --time 0.8 --out whole --threads 2"));
        folder.succeed(&format!("{run} --time 0.5 --out parted --threads 1"));
        folder.succeed(&format!("{} --time 0.8 --out parted --resume", run.replace(" --force", "")));
        for file in ["series.csv", "frame_0004.vtu", "frame_0004.png", "frames.pvd", "animation.gif"] {
            let [a, b] = ["whole", "parted"].map(|place| folder.bytes(&format!("{place}/{file}")));
            assert!(a == b, "{case} {scalar}: {file}");
        }
    }
}

#[test]
fn a_dam_breaks_in_two_and_three_dimensions() {
    let folder = Folder::new();
    for dim in [2, 3] {
        let place = format!("dam{dim}");
        folder.succeed(&format!(
            "run --solver pbf --dim {dim} --resolution 8 --time 0.3 --every 0.1 --out {place}"
        ));
        let series =
            Columns::parse(&String::from_utf8(folder.bytes(&format!("{place}/series.csv"))).unwrap());
        let front = series.get("front_x");
        assert!(front[0] < 0.15 && front.last().is_some_and(|&x| x > 0.4 && x < 0.6), "{front:?}");
        assert!(series.get("min_spacing").iter().all(|&spacing| spacing > 0.2));
        assert!(series.get("outside").iter().all(|&outside| outside == 0.0));
    }
}

#[test]
fn the_weakly_compressible_solver_turns_the_box_too() {
    let folder = Folder::new();
    folder.succeed("run tilt --solver wcsph --scalar f32 --resolution 10 --time 1.1 --every 0.1 --out box");
    let summary = summary(&folder, "box");
    assert_eq!((&summary["solver"], &summary["scalar"]), (&"wcsph".into(), &"f32".into()));
    let series = Columns::parse(&String::from_utf8(folder.bytes("box/series.csv")).unwrap());
    let offset = series.get("centre_offset");
    assert!(
        offset[0].abs() < 1e-9 && offset.last().is_some_and(|&x| x > 0.004),
        "to the low side: {offset:?}"
    );
}
