//! The same run again: other threads, interrupted and resumed, in a directory that is taken.

use crate::support::Folder;

const RUN: &str = "run --resolution 8 --every 0.004";

/// Everything but the summary and the checkpoint, which hold the time it took.
const FILES: [&str; 7] = [
    "series.csv",
    "frame_0003.vtu",
    "frame_0003.png",
    "frame_0004.vtu",
    "frames.pvd",
    "front.png",
    "animation.gif",
];

fn assert_same(folder: &Folder, one: &str, other: &str) {
    for file in FILES {
        let [a, b] = [one, other].map(|place| folder.bytes(&format!("{place}/{file}")));
        assert!(a == b, "{file} of {one} and {other} differ");
    }
}

#[test]
fn threads_and_interruptions_change_no_byte() {
    let folder = Folder::new();
    for scalar in ["f64", "f32"] {
        let run = format!("{RUN} --solver wcsph --scalar {scalar} --force");
        folder.succeed(&format!("{run} --time 0.016 --out whole --threads 1"));
        folder.succeed(&format!("{run} --time 0.016 --out threads --threads 3"));
        assert_same(&folder, "whole", "threads");
        // ends between two frames, goes on
        folder.succeed(&format!("{run} --time 0.01 --out parted"));
        assert!(folder.path("parted/frame_0003.vtu").exists());
        let resumed = format!("{RUN} --solver wcsph --scalar {scalar} --time 0.016 --out parted --resume");
        folder.succeed(&resumed);
        assert_same(&folder, "whole", "parted");
    }
    let [a, b] = ["whole", "parted"].map(|place| {
        let mut json: serde_json::Value =
            serde_json::from_slice(&folder.bytes(&format!("{place}/summary.json"))).unwrap();
        let object = json.as_object_mut().unwrap();
        for name in ["wall_s", "particle_steps_per_s"] {
            assert!(object.remove(name).unwrap().as_f64().unwrap() > 0.0);
        }
        object.retain(|name, _| !name.contains("stepping") && !name.starts_with("us_per"));
        json
    });
    assert_eq!(a, b);
}

#[test]
fn an_earlier_run_is_kept_unless_told_otherwise() {
    let folder = Folder::new();
    let run = format!("{RUN} --time 0.004 --out dam");
    folder.succeed(&run);
    folder.write("dam/notes.txt", "mine");
    let before = folder.bytes("dam/summary.json");
    folder.fail_with(1, &run, &["dam", "--resume", "--force"]);
    folder.fail_with(1, "run drop --resolution 8 --out dam", &["dam"]);
    assert_eq!(before, folder.bytes("dam/summary.json"));
    for (other, parts) in [
        (
            "run --resolution 9 --every 0.004 --time 0.008 --out dam --resume",
            ["resolution 8", "resolution 9", "leave --resolution out"],
        ),
        (
            "run --every 0.002 --time 0.008 --out dam --resume",
            ["every 0.004", "every 0.002", "leave --every out"],
        ),
        ("run drop --time 0.008 --out dam --resume", ["dam-break", "drop", "leave the case out"]),
        ("run --scalar f64 --out dam --resume", ["scalar f32", "scalar f64", "leave --scalar out"]),
    ] {
        folder.fail_with(1, other, &parts);
    }
    folder.succeed("run drop --resolution 8 --time 0.0002 --every 0.0002 --out dam --force");
    assert!(!folder.path("dam/front.png").exists(), "nothing of the earlier run is left");
    assert_eq!(folder.bytes("dam/notes.txt"), b"mine");
}

#[test]
fn a_resumed_run_keeps_what_is_not_given() {
    let folder = Folder::new();
    let run = "run taylor-green --resolution 8 --scalar f32 --kernel cubic-spline --no-pictures";
    folder.succeed(&format!("{run} --time 0.05 --out parted"));
    let summary = String::from_utf8(folder.bytes("parted/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    // a fiftieth of the time of the first run
    let every = summary["every"].as_f64().unwrap();
    assert!((every / 0.001 - 1.0).abs() < 1e-12, "{every}");
    folder.succeed("run --time 0.1 --out parted --resume --no-pictures");
    folder.succeed(&format!("{run} --time 0.1 --every {every} --out whole"));
    for file in ["series.csv", "frame_0050.vtu", "frame_0100.vtu", "frames.pvd"] {
        let [a, b] = ["whole", "parted"].map(|place| folder.bytes(&format!("{place}/{file}")));
        assert!(a == b, "{file}");
    }
    // without --time, the time of the run is kept too
    folder.succeed("run --out parted --resume --no-pictures");
    assert!(!folder.path("parted/frame_0101.vtu").exists());
    // the decimal digits of the spacing are the spacing
    folder.succeed("run --every 0.001 --out parted --resume --no-pictures");
}
