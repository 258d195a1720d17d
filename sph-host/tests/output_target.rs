//! Targets: nothing is half-written, nothing is replaced unasked, nothing is left over.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sph_host::output::{Column, Content, Precision, Table, Target, WriteError, cleanup_on_interrupt, write};

fn table() -> Table {
    Table {
        coordinates: vec![Column::new("x", vec![0.0, 1.0])],
        columns: vec![Column::new("density", vec![1.0, 2.0])],
        grid: None,
        precision: Precision::F64,
        caption: String::new(),
    }
}

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn an_existing_target_is_kept_unless_forced() {
    let directory = tempfile::tempdir().unwrap();
    let mut target = Target::new(directory.path().join("out.csv"));
    fs::write(&target.path, "precious").unwrap();
    assert!(matches!(target.check(Content::Points), Err(WriteError::Exists(_))));
    let error = write(&table(), &target).unwrap_err();
    assert!(error.to_string().ends_with("out.csv: the file exists already and is kept"), "{error}");
    assert!(!error.is_usage());
    assert_eq!(fs::read_to_string(&target.path).unwrap(), "precious");
    target.force = true;
    write(&table(), &target).unwrap();
    assert_eq!(fs::read_to_string(&target.path).unwrap(), "x,density\n0.0,1.0\n1.0,2.0\n");
    assert_eq!(names(directory.path()), ["out.csv"]);
}

#[test]
fn a_target_that_appears_meanwhile_is_kept() {
    let directory = tempfile::tempdir().unwrap();
    let target = Target::new(directory.path().join("out.csv"));
    let result = target.create(|file| {
        fs::write(&target.path, "precious")?;
        file.write_all(b"late")
    });
    assert!(matches!(result, Err(WriteError::Exists(_))));
    assert_eq!(fs::read_to_string(&target.path).unwrap(), "precious");
    assert_eq!(names(directory.path()), ["out.csv"]);
}

#[test]
fn a_failure_leaves_the_old_file_and_nothing_else() {
    let directory = tempfile::tempdir().unwrap();
    let target = Target { path: directory.path().join("out.csv"), force: true };
    fs::write(&target.path, "precious").unwrap();
    let result = target.create(|file| {
        file.write_all(&[b'x'; 3 << 20])?;
        Err(io::Error::other("the disk is full"))
    });
    assert!(result.unwrap_err().to_string().ends_with("cannot be written: the disk is full"));
    assert_eq!(fs::read_to_string(&target.path).unwrap(), "precious");
    assert_eq!(names(directory.path()), ["out.csv"]);
}

#[test]
fn what_cannot_be_is_said_before_the_work() {
    let directory = tempfile::tempdir().unwrap();
    let check = |name: &str, content| Target::new(directory.path().join(name)).check(content);
    let (points, grid, surface) = (Content::Points, Content::Grid, Content::Surface);
    for name in ["out", "out.txt", "out.csv.gz", ".csv"] {
        let error = check(name, grid).unwrap_err();
        assert!(matches!(error, WriteError::UnknownEnding(_)) && error.is_usage(), "{name}: {error}");
    }
    for (name, holds, not, said) in [
        ("out.png", &[grid][..], &[points, surface][..], "no grid"),
        ("out.vti", &[grid], &[points, surface], "no grid"),
        ("out.ply", &[points, surface], &[grid], "a grid without a surface"),
        ("out.obj", &[surface], &[points, grid], "these are points"),
        ("out.xyz", &[points, grid], &[surface], "a surface can be written as one of .ply, .obj"),
    ] {
        holds.iter().for_each(|&content| assert!(check(name, content).is_ok(), "{name}"));
        for &content in not {
            let error = check(name, content).unwrap_err();
            assert!(matches!(error, WriteError::Unfit { .. }) && error.is_usage(), "{name}: {error}");
        }
        let error = check(name, not[0]).unwrap_err().to_string();
        assert!(error.contains(said), "{name}: {error}");
    }
    assert_eq!(check("OUT.CSV", points).unwrap().ending, ".csv");
    assert!(matches!(check("missing/out.csv", points), Err(WriteError::Directory { .. })));
    fs::create_dir(directory.path().join("folder.vtk")).unwrap();
    assert!(matches!(check("folder.vtk", points), Err(WriteError::IsDirectory(_))));
    assert_eq!(names(directory.path()), ["folder.vtk"]);
}

#[cfg(unix)]
#[test]
fn a_device_or_a_pipe_is_never_replaced() {
    use std::os::unix::fs::symlink;
    let directory = tempfile::tempdir().unwrap();
    let pipe = directory.path().join("pipe.csv");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let mut places = vec![pipe];
    for device in ["null", "zero", "full"] {
        let link = directory.path().join(format!("{device}.csv"));
        symlink(Path::new("/dev").join(device), &link).unwrap();
        places.push(link);
    }
    for path in places {
        let before = fs::symlink_metadata(&path).unwrap().file_type();
        for force in [false, true] {
            let target = Target { path: path.clone(), force };
            for result in
                [target.check(Content::Points).map(drop), write(&table(), &target), target.create(|_| Ok(()))]
            {
                let error = result.unwrap_err();
                assert!(matches!(error, WriteError::NotAFile(_)) && !error.is_usage(), "{error}");
            }
        }
        assert_eq!(fs::symlink_metadata(&path).unwrap().file_type(), before);
    }
    assert_eq!(names(directory.path()).len(), 4, "nothing is left over");
}

#[cfg(unix)]
#[test]
fn a_result_has_the_permissions_of_an_ordinary_file_and_goes_through_a_link() {
    use std::os::unix::fs::{MetadataExt, symlink};
    let directory = tempfile::tempdir().unwrap();
    let (link, file) = (directory.path().join("link.csv"), directory.path().join("file.csv"));
    File::create(&file).unwrap();
    let ordinary = fs::metadata(&file).unwrap().mode();
    symlink("file.csv", &link).unwrap();
    assert!(matches!(Target::new(&link).check(Content::Points), Err(WriteError::Exists(_))));
    write(&table(), &Target { path: link.clone(), force: true }).unwrap();
    assert!(link.is_symlink());
    assert_eq!(fs::metadata(&file).unwrap().mode(), ordinary);
    assert!(fs::read_to_string(&file).unwrap().starts_with("x,density"));
}

/// The test runs itself as a process that writes without end, and interrupts it.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_and_exits_130() {
    const DIRECTORY: &str = "FLUISIM_TEST_INTERRUPT";
    if let Some(directory) = std::env::var_os(DIRECTORY) {
        cleanup_on_interrupt().unwrap();
        cleanup_on_interrupt().unwrap();
        let target = Target::new(Path::new(&directory).join("out.csv"));
        target
            .create(|file| {
                (0..600).try_for_each(|_| {
                    std::thread::sleep(Duration::from_millis(50));
                    file.write_all(b"1,2\n").and_then(|()| file.flush())
                })
            })
            .unwrap();
        return;
    }
    let directory = tempfile::tempdir().unwrap();
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["an_interrupt_leaves_nothing_and_exits_130", "--exact"])
        .env(DIRECTORY, directory.path())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let deadline = Instant::now() + Duration::from_secs(20);
    while names(directory.path()).is_empty() && Instant::now() < deadline {
        std::thread::sleep(Duration::from_millis(10));
    }
    assert_eq!(names(directory.path()).len(), 1, "the unfinished file");
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", id.as_str()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(names(directory.path()).is_empty());
}

#[cfg(unix)]
#[test]
fn a_link_to_nothing_and_one_to_a_device_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("out.csv");
    std::os::unix::fs::symlink(directory.path().join("gone/nothing.csv"), &path).unwrap();
    let target = Target { path: path.clone(), force: true };
    assert!(matches!(target.check(Content::Points), Err(WriteError::DanglingLink(_))));
    assert!(matches!(write(&table(), &target), Err(WriteError::DanglingLink(_))));
    assert!(path.is_symlink());
    std::fs::remove_file(&path).unwrap();
    std::os::unix::fs::symlink("/dev/null", &path).unwrap();
    let said = target.check(Content::Points).unwrap_err().to_string();
    assert!(said.contains("without a name, text goes to standard output"), "{said}");
    assert_eq!(names(directory.path()), ["out.csv"]);
}
