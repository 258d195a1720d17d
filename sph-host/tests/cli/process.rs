//! The command as a process: streams, signals, timing.

use std::io::Read;
use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::support::{Folder, Said};

#[test]
fn messages_go_to_stderr_and_there_is_no_bar_without_a_terminal() {
    let folder = Folder::new();
    let words = "sample demo:vortex --particles 400 --grid 20,20";
    assert_eq!(folder.succeed(words).stderr, "");
    let said = folder.succeed(&format!("{words} --out out.csv"));
    assert_eq!((said.stdout, said.stderr), (String::new(), String::new()));
}

#[test]
fn standard_output_may_be_named() {
    let folder = Folder::new();
    let words = "sample demo:vortex --particles 400 --grid 20,20";
    assert_eq!(folder.succeed(&format!("{words} --out /dev/stdout")).stdout, folder.succeed(words).stdout);
    let said = folder.run(&format!("{words} --out /dev/stderr"));
    assert_eq!((said.status, said.stdout.as_str()), (Some(2), ""), "{}", said.stderr);
}

#[test]
fn timing_is_the_last_line_and_quiet_hides_no_message() {
    let folder = Folder::with("p.csv", "x,y,m,A\n0,0,1,1\n1,0,1,1\n");
    let words = "sample p.csv --support 0.5 --grid 3,1 --bounds -9,0,9,1 --threads 2 --timing";
    for quiet in ["", "--quiet"] {
        for out in ["", "--out out.csv --force"] {
            let Said { stderr, .. } = folder.succeed(&format!("{words} {quiet} {out}"));
            let lines: Vec<&str> = stderr.lines().collect();
            assert!(lines[0].starts_with("warning: ") && lines[0].contains("of 3 points"), "{stderr}");
            let json = lines.last().unwrap().strip_prefix("timing: ").unwrap();
            let timing: serde_json::Map<String, serde_json::Value> = serde_json::from_str(json).unwrap();
            for (key, value) in [("particles", 2), ("points", 3), ("threads", 2)] {
                assert_eq!(timing[key], value, "{json}");
            }
            for key in ["read_s", "search_s", "evaluate_s", "write_s"] {
                assert!((0.0..60.0).contains(&timing[key].as_f64().unwrap()), "{json}");
            }
            assert_eq!(timing.len(), 7, "{json}");
        }
        let said =
            folder.run(&format!("{} --mass 1 --support-column B", words.replace("--support 0.5", quiet)));
        assert!(said.stderr.starts_with("error: p.csv"), "{}", said.stderr);
    }
}

#[test]
fn a_closed_pipe_is_no_error() {
    let folder = Folder::new();
    for words in ["sample demo:vortex --at-particles --timing", "kernels", "--help"] {
        let mut command = folder.command(words);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // the first bytes are read, then the reader goes away
        let mut start = [0; 4];
        child.stdout.take().unwrap().read_exact(&mut start).unwrap();
        let said = Said::from(child.wait_with_output().unwrap());
        assert_eq!(said.status, Some(0), "{words}: {}", said.stderr);
        assert!(!said.stderr.contains("error"), "{words}: {}", said.stderr);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_an_error_and_a_full_stderr_no_panic() {
    let folder = Folder::new();
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let said = Said::from(
        folder
            .command("sample demo:vortex --at-particles")
            .stdout(full())
            .stderr(Stdio::piped())
            .output()
            .unwrap(),
    );
    assert_eq!(said.status, Some(1));
    assert!(said.stderr.starts_with("error: ") && said.stderr.contains("stdout"), "{}", said.stderr);
    let mut command = folder.command("sample missing.csv --support 1 --at-particles");
    assert_eq!(command.stderr(full()).status().unwrap().code(), Some(1));
    let mut command =
        folder.command("sample demo:lattice --particles 8 --at-particles --estimate corrected --timing");
    assert_eq!(command.stdout(Stdio::null()).stderr(full()).status().unwrap().code(), Some(0));
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_no_half_written_file() {
    let folder = Folder::new();
    let words =
        "sample demo:vortex --particles 4 --support 0.01 --quantity pressure --grid 1500,1000 --out out.csv";
    let mut child = folder.command(words).stderr(Stdio::null()).spawn().unwrap();
    let start = Instant::now();
    let is_growing = || {
        let names = folder.names();
        let part = names.iter().find(|name| name.ends_with(".part"));
        part.is_some_and(|name| folder.path(name).metadata().is_ok_and(|file| file.len() > 0))
    };
    while !is_growing() {
        assert!(child.try_wait().unwrap().is_none(), "over before it could be interrupted");
        assert!(start.elapsed() < Duration::from_secs(120), "nothing is written");
        std::thread::sleep(Duration::from_millis(1));
    }
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let status = child.wait().unwrap();
    assert_eq!(status.code(), Some(130));
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
