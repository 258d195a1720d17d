//! A run as a process: streams and signals.

use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::support::Folder;

#[test]
fn without_a_directory_it_takes_the_name_of_the_case() {
    let folder = Folder::new();
    let said = folder.succeed("run poiseuille --resolution 8 --time 0.002 --every 0.001");
    assert!(said.stdout.contains("fluisim-poiseuille/profile.png"), "{}", said.stdout);
    assert_eq!(said.stderr, "");
    assert_eq!(folder.names().into_iter().collect::<Vec<_>>(), ["fluisim-poiseuille"]);
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_no_half_written_file_and_the_run_goes_on() {
    let folder = Folder::new();
    let words = "run taylor-green --resolution 8 --time 0.5 --every 0.01 --out vortices";
    let mut child = folder.command(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let start = Instant::now();
    while !folder.path("vortices/frame_0002.vtu").exists() {
        assert!(child.try_wait().unwrap().is_none(), "over before it could be interrupted");
        assert!(start.elapsed() < Duration::from_secs(120), "nothing is written");
        std::thread::sleep(Duration::from_millis(1));
    }
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    for entry in std::fs::read_dir(folder.path("vortices")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        assert!(!name.ends_with(".part"), "{name}");
        if name.ends_with(".vtu") {
            sph_host::io::read(&path).unwrap();
        }
    }
    folder.succeed(&format!("{words} --resume"));
    assert!(folder.path("vortices/frame_0050.vtu").exists());
}

#[cfg(unix)]
#[test]
fn one_run_at_a_time_writes_in_a_directory() {
    let folder = Folder::new();
    let words = "run taylor-green --resolution 8 --time 2 --every 0.01 --no-pictures --out vortices";
    let mut child = folder.command(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let start = Instant::now();
    while !folder.path("vortices/frame_0001.vtu").exists() {
        assert!(start.elapsed() < Duration::from_secs(120), "nothing is written");
        std::thread::sleep(Duration::from_millis(1));
    }
    let holder = format!("process {}", child.id());
    for option in ["", "--force", "--resume"] {
        folder.fail_with(1, &format!("{words} {option}"), &["vortices: another run", &holder, "--out"]);
    }
    assert!(child.try_wait().unwrap().is_none(), "the first run was over before the others were refused");
    child.kill().unwrap();
    child.wait().unwrap();
    folder.succeed(&format!("{words} --resume"));
    assert!(folder.path("vortices/frame_0200.vtu").exists());
}
