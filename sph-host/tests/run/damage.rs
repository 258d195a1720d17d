//! A directory that lost something: a run goes on from its last whole frame, tells what it found, and ends with the same bytes.

use std::fs;

use crate::support::Folder;

const RUN: &str = "run --resolution 8 --every 0.004 --threads 2";

/// What is left of a file.
#[derive(Clone, Copy, Debug)]
enum Left {
    Nothing,
    NoBytes,
    Half,
    AllButOneByte,
}

fn damage(folder: &Folder, file: &str, left: Left) {
    let bytes = folder.bytes(file);
    match left {
        Left::Nothing => fs::remove_file(folder.path(file)).unwrap(),
        Left::NoBytes => folder.write(file, ""),
        Left::Half => folder.write(file, &bytes[..bytes.len() / 2]),
        Left::AllButOneByte => folder.write(file, &bytes[..bytes.len() - 1]),
    }
}

fn assert_same(folder: &Folder, files: &[&str], what: &str) {
    for file in files {
        let [a, b] = ["whole", "parted"].map(|place| folder.bytes(&format!("{place}/{file}")));
        assert!(a == b, "{what}: {file} differs");
    }
}

const LOST: [Left; 4] = [Left::Nothing, Left::NoBytes, Left::Half, Left::AllButOneByte];

#[test]
fn a_run_goes_on_before_what_is_cut_short_or_missing() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.016 --out whole --no-pictures"));
    for (file, goes_on) in [
        ("frame_0002.vtu", Some("frame 1, at 0.004 s")),
        ("frame_0000.vtu", Some("beginning anew")),
        ("frame_0001.vtu", Some("frame 0, at 0 s")),
        ("series.csv", None),
        ("checkpoint.json", None),
        ("run.json", None),
        ("summary.json", None),
        ("frames.pvd", None),
    ] {
        for left in LOST {
            let _ = fs::remove_dir_all(folder.path("parted"));
            folder.succeed(&format!("{RUN} --time 0.008 --out parted --no-pictures"));
            damage(&folder, &format!("parted/{file}"), left);
            let said = folder.succeed("run --time 0.016 --out parted --resume --no-pictures");
            if let Some(goes_on) = goes_on {
                let told = said.stderr.lines().find(|line| line.starts_with("note: ") && line.contains(file));
                assert!(told.is_some_and(|told| told.contains(goes_on)), "{file} {left:?}: {}", said.stderr);
            }
            let what = format!("{file} {left:?}");
            let files = ["series.csv", "frame_0000.vtu", "frame_0002.vtu", "frame_0004.vtu", "frames.pvd"];
            assert_same(&folder, &files, &what);
            assert!(folder.path("parted/summary.json").exists());
        }
    }
}

/// Nothing is left to be computed, and yet all that was lost is there again.
#[test]
fn what_a_whole_run_lost_is_made_anew() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.008 --out whole --no-pictures"));
    let files = ["series.csv", "frame_0000.vtu", "frame_0002.vtu", "frames.pvd"];
    for file in files.iter().chain(&["checkpoint.json"]) {
        for left in LOST {
            let _ = fs::remove_dir_all(folder.path("parted"));
            folder.succeed(&format!("{RUN} --time 0.008 --out parted --no-pictures"));
            damage(&folder, &format!("parted/{file}"), left);
            folder.succeed("run --out parted --resume --no-pictures");
            assert_same(&folder, &files, &format!("{file} {left:?}"));
            let again = folder.succeed("run --out parted --resume --no-pictures");
            assert!(!again.stderr.contains("note: "), "{file} {left:?}: {}", again.stderr);
        }
    }
}

#[test]
fn what_is_lost_is_told() {
    let folder = Folder::new();
    for (file, left, part) in [
        ("series.csv", Left::Nothing, "is missing: beginning anew"),
        ("series.csv", Left::NoBytes, "has other columns: beginning anew"),
        ("series.csv", Left::AllButOneByte, "is cut short: going on from frame 1, at 0.004 s"),
        ("run.json", Left::Half, "is damaged"),
        ("checkpoint.json", Left::Half, "is damaged: the time spent so far is not known"),
        ("run.json", Left::Nothing, "is missing"),
    ] {
        folder.succeed(&format!("{RUN} --time 0.008 --out dam --no-pictures --force"));
        damage(&folder, &format!("dam/{file}"), left);
        let said = folder.succeed("run --out dam --resume --no-pictures --quiet");
        assert!(said.stderr.starts_with("note: "), "{file}: {}", said.stderr);
        assert!(said.stderr.contains(&format!("{file} {part}")), "{file}: {}", said.stderr);
    }
}

#[test]
fn a_sound_run_goes_on_without_a_word() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.01 --out dam"));
    for time in ["0.01", "0.012", "0.016"] {
        let said = folder.succeed(&format!("run --time {time} --out dam --resume"));
        assert_eq!(said.stderr, "", "{time}");
    }
}

#[test]
fn numbers_that_changed_are_found_by_their_file() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.016 --out whole --no-pictures"));
    folder.succeed(&format!("{RUN} --time 0.008 --out parted --no-pictures"));
    let frame = String::from_utf8(folder.bytes("parted/frame_0002.vtu")).unwrap();
    folder
        .write("parted/frame_0002.vtu", frame.replacen("NumberOfPoints=\"128\"", "NumberOfPoints=\"12\"", 1));
    let said = folder.succeed("run --time 0.016 --out parted --resume --no-pictures");
    assert!(said.stderr.contains("frame_0002.vtu"), "{}", said.stderr);
    // a digit more in the series
    let series = String::from_utf8(folder.bytes("parted/series.csv")).unwrap();
    folder.write("parted/series.csv", series.replacen("\n0.007,", "\n0.0071,", 1));
    let said = folder.succeed("run --time 0.016 --out parted --resume --no-pictures");
    assert!(said.stderr.contains("series.csv has another time in line 9"), "{}", said.stderr);
    assert_same(&folder, &["series.csv", "frame_0002.vtu", "frame_0004.vtu"], "changed");
}

#[test]
fn pictures_that_are_lost_are_drawn_again() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.016 --out whole"));
    folder.succeed(&format!("{RUN} --time 0.012 --out parted"));
    damage(&folder, "parted/frame_0000.png", Left::Nothing);
    damage(&folder, "parted/frame_0001.png", Left::NoBytes);
    damage(&folder, "parted/frame_0002.png", Left::Half);
    damage(&folder, "parted/frame_0003.png", Left::AllButOneByte);
    damage(&folder, "parted/animation.gif", Left::Half);
    damage(&folder, "parted/front.png", Left::Nothing);
    let said = folder.succeed("run --time 0.016 --out parted --resume");
    assert!(
        said.stderr.contains("drawing again what is missing or cut short: 4 pictures"),
        "{}",
        said.stderr
    );
    let files = ["0", "1", "2", "3", "4"].map(|number| format!("frame_000{number}.png"));
    let files: Vec<&str> = files.iter().map(String::as_str).chain(["animation.gif", "front.png"]).collect();
    assert_same(&folder, &files, "pictures");
}

#[test]
fn without_pictures_there_are_none_until_they_are_asked_for() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.008 --out whole"));
    let said = folder.succeed(&format!("{RUN} --time 0.008 --out parted --no-pictures"));
    let is_picture = |name: &String| name.ends_with(".png") || name.ends_with(".gif");
    assert!(!folder.names_in("parted").iter().any(is_picture), "{:?}", folder.names_in("parted"));
    assert!(!said.stdout.contains(".png") && said.stdout.contains("parted/frames.pvd"), "{}", said.stdout);
    folder.succeed("run --out parted --resume");
    let pictures = ["frame_0000.png", "frame_0001.png", "frame_0002.png", "animation.gif", "front.png"];
    assert_same(&folder, &pictures, "drawn later");
    // an animation and a plot that end before the run are worse than none
    folder.succeed("run --time 0.012 --out parted --resume --no-pictures");
    assert!(!folder.names_in("parted").contains("animation.gif"));
    assert!(!folder.names_in("parted").contains("front.png"));
}

#[test]
fn a_picture_that_cannot_be_written_is_an_error() {
    let folder = Folder::new();
    for threads in [1, 3] {
        let place = format!("dam{threads}");
        fs::create_dir_all(folder.path(&format!("{place}/frame_0001.png/in"))).unwrap();
        let words = format!(
            "run --resolution 8 --time 0.008 --every 0.004 --threads {threads} --out {place} --resume"
        );
        let said = folder.run(&words);
        assert_eq!(said.status, Some(1), "{}", said.stderr);
        assert!(said.stderr.contains("frame_0001.png"), "{}", said.stderr);
    }
}

#[test]
fn a_frame_that_is_no_more_is_never_left_behind() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.016 --out dam --no-pictures"));
    damage(&folder, "dam/frame_0001.vtu", Left::Half);
    folder.succeed("run --time 0.008 --out dam --resume --no-pictures");
    let frames = folder.names_in("dam").into_iter().filter(|name| name.ends_with(".vtu"));
    assert_eq!(frames.collect::<Vec<_>>(), ["frame_0000.vtu", "frame_0001.vtu", "frame_0002.vtu"]);
}

#[test]
fn frames_of_an_unknown_run_are_kept_and_the_way_out_is_told() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.008 --out dam --no-pictures"));
    damage(&folder, "dam/run.json", Left::Half);
    damage(&folder, "dam/checkpoint.json", Left::Nothing);
    let before = folder.names_in("dam");
    let said = folder.run("run --resume --out dam --no-pictures");
    assert_eq!(said.status, Some(1));
    for part in ["dam", "run.json", "--force"] {
        assert!(said.stderr.lines().any(|line| line.starts_with("error: ") && line.contains(part)), "{part}");
    }
    assert_eq!(folder.names_in("dam"), before);
    folder.succeed(&format!("{RUN} --time 0.008 --out dam --no-pictures --force"));
}

#[test]
fn what_a_killed_process_left_is_removed_and_nothing_else() {
    let folder = Folder::new();
    for (option, place) in [("--resume", "dam"), ("--force", "dam")] {
        let _ = fs::remove_dir_all(folder.path(place));
        folder.succeed(&format!("{RUN} --time 0.004 --out {place} --no-pictures"));
        fs::create_dir_all(folder.path("dam/deeper")).unwrap();
        fs::create_dir_all(folder.path("dam/.fluisim-Folder.part")).unwrap();
        let kept = [
            "dam/notes.part",
            "dam/.fluisim-notes.txt",
            "dam/.fluisim-my notes.part",
            "dam/fluisim-Ab12Cd.part",
            "dam/deeper/.fluisim-Ab12Cd.part",
            ".fluisim-Ab12Cd.part",
        ];
        for file in kept {
            folder.write(file, "kept");
        }
        folder.write("dam/.fluisim-Ab12Cd.part", "left behind");
        folder.write("dam/.fluisim-x9Y8z7.part", "");
        folder.succeed(&format!("{RUN} --time 0.008 --out {place} --no-pictures {option}"));
        for file in kept {
            assert!(folder.path(file).exists(), "{option}: {file}");
        }
        assert!(folder.path("dam/.fluisim-Folder.part").is_dir(), "{option}");
        for file in ["dam/.fluisim-Ab12Cd.part", "dam/.fluisim-x9Y8z7.part"] {
            assert!(!folder.path(file).exists(), "{option}: {file}");
        }
    }
}

/// A count of steps that no run comes to is damage: with 2⁶⁴ − 1 the next step had the number 0.
#[test]
fn a_number_of_steps_beyond_all_is_damage() {
    let folder = Folder::new();
    folder.succeed(&format!("{RUN} --time 0.008 --out parted --no-pictures"));
    let series = String::from_utf8(folder.bytes("parted/series.csv")).unwrap();
    for steps in ["18446744073709551615", "-1.0", "0.5", "NaN", "inf"] {
        let lines: Vec<String> = series
            .lines()
            .enumerate()
            .map(|(number, line)| match line.rsplit_once(',') {
                Some((start, _)) if number > 5 => format!("{start},{steps}\n"),
                _ => format!("{line}\n"),
            })
            .collect();
        folder.write("parted/series.csv", lines.concat());
        let said = folder.succeed("run --time 0.008 --out parted --resume --no-pictures");
        assert!(said.stderr.contains("series.csv is damaged in line 7"), "{steps}: {}", said.stderr);
        let summary = String::from_utf8(folder.bytes("parted/summary.json")).unwrap();
        assert!(!summary.contains("18446744073709551615"), "{summary}");
    }
}

#[test]
fn no_lock_is_left_in_a_directory_that_is_taken() {
    let folder = Folder::new();
    fs::create_dir(folder.path("taken")).unwrap();
    folder.write("taken/frame_0000.vtu", "another's");
    folder.fail_with(1, &format!("{RUN} --time 0.008 --out taken"), &["taken: already holds a run"]);
    assert_eq!(folder.names_in("taken").into_iter().collect::<Vec<_>>(), ["frame_0000.vtu"]);
}
