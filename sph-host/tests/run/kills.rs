//! A run that is killed at any moment, and whose last files then lose their ends, goes on and ends with the bytes of one that was not.

use std::fs;
use std::path::PathBuf;
use std::process::Stdio;
use std::time::{Duration, SystemTime};

use crate::support::{Folder, Random};

const RUN: &str =
    "run taylor-green --resolution 8 --time 0.1 --every 0.005 --threads 1 --no-pictures --quiet";
const FILES: [&str; 4] = ["series.csv", "frames.pvd", "frame_0000.vtu", "frame_0020.vtu"];

/// The files that were written last, the newest first. `run.json` is on the disk before there is any other, and is not written again.
fn newest(folder: &Folder) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder.path("killed")) else { return Vec::new() };
    let mut files: Vec<(SystemTime, PathBuf)> = entries
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_name() != "run.json")
        .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.path())))
        .collect();
    files.sort();
    files.into_iter().rev().map(|(_, path)| path).collect()
}

/// Kills the run after a part of the time that it takes, then empties or cuts up to three of the newest files.
fn kill_and_damage(folder: &Folder, whole: Duration, random: &mut Random) {
    let words = format!("{RUN} --out killed --resume");
    let mut child = folder.command(&words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    std::thread::sleep(whole.mul_f64(random.next()));
    child.kill().unwrap();
    child.wait().unwrap();
    let lost = (4.0 * random.next()) as usize;
    for path in newest(folder).iter().take(lost) {
        let bytes = fs::read(path).unwrap();
        let left = if random.next() < 0.5 { 0 } else { (bytes.len() as f64 * random.next()) as usize };
        fs::write(path, &bytes[..left]).unwrap();
    }
}

fn kill(times: usize, seed: u64) {
    let folder = Folder::new();
    let start = std::time::Instant::now();
    folder.succeed(&format!("{RUN} --out whole"));
    let whole = start.elapsed();
    let mut random = Random(seed);
    for time in 0..times {
        kill_and_damage(&folder, whole, &mut random);
        if time % 5 < 4 {
            continue;
        }
        // a directory without any run is begun anew
        folder.succeed(&format!("{RUN} --out killed --resume"));
        for file in FILES {
            let [a, b] = ["whole", "killed"].map(|place| folder.bytes(&format!("{place}/{file}")));
            assert!(a == b, "kill {time}: {file} differs");
        }
        fs::remove_dir_all(folder.path("killed")).unwrap();
    }
}

#[test]
fn ten_kills_change_no_byte() {
    kill(10, 1);
}

#[test]
#[ignore = "minutes: by hand, see CONTRIBUTING.md"]
fn five_hundred_kills_change_no_byte() {
    kill(500, 2);
}
