//! Runs tests: once each to see which changes they reach, then for each change those that reach it, the quickest first.

use anyhow::{Context, Result, ensure};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

use crate::copy::Workspace;

/// One test of one program.
pub(crate) struct Test {
    program: PathBuf,
    name: String,
    time: Duration,
    /// The changes that it reaches.
    reached: Vec<u32>,
}

/// What the tests say of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// A test failed.
    Killed,
    /// A test took much longer than it does.
    TooLong,
    /// All tests that reach it pass.
    Survived,
    /// No test reaches it.
    NotReached,
}

/// Tests are run in groups of similar time; the upper ends.
const GROUPS: [Duration; 5] = [
    Duration::from_millis(15),
    Duration::from_millis(60),
    Duration::from_millis(300),
    Duration::from_millis(1500),
    Duration::MAX,
];

/// Runs every test once without a change.
pub(crate) fn watch(workspace: &Workspace, programs: &[PathBuf]) -> Result<Vec<Test>> {
    let mut names = Vec::new();
    for program in programs {
        let output = Command::new(program)
            .current_dir(folder(workspace, program))
            .args(["--list", "--format=terse"])
            .output()?;
        for line in String::from_utf8(output.stdout)?.lines() {
            names.extend(line.strip_suffix(": test").map(|name| (program, name.to_owned())));
        }
    }
    let tests = Mutex::new(Vec::new());
    in_parallel(names.len(), |i| {
        let (program, name) = &names[i];
        let test = watch_one(workspace, program, name, i)?;
        tests.lock().unwrap().extend(test);
        Ok(())
    })?;
    let mut tests = tests.into_inner().unwrap();
    tests.sort_by_key(|test| test.time);
    Ok(tests)
}

/// Processor time of a test at most, in seconds: one that takes longer is left out, since each change would cost as much.
const LONGEST: u64 = 3;

/// A test whose promise is a panic cannot be told from one that fails: it is left out, and so is a long one.
fn watch_one(workspace: &Workspace, program: &Path, name: &str, i: usize) -> Result<Option<Test>> {
    let seen = workspace.copy.join(format!("../reached-{i}"));
    let _ = fs::remove_file(&seen);
    let start = Instant::now();
    let mut command = limited(LONGEST, program);
    command.current_dir(folder(workspace, program)).args(["--exact", name, "--test-threads=1"]);
    let output = command.env("FLUISIM_REACHED", &seen).env("PROPTEST_RNG_SEED", "1").output()?;
    let time = start.elapsed();
    if !output.status.success() {
        println!("left out, it does not pass here in {LONGEST} s: {name}");
        return Ok(None);
    }
    let text = fs::read_to_string(&seen).unwrap_or_default();
    let reached = text.lines().filter_map(|line| line.parse().ok()).collect();
    let _ = fs::remove_file(&seen);
    Ok(Some(Test { program: program.into(), name: name.into(), time, reached }))
}

/// Tests run in the folder of their package, as cargo runs them.
fn folder(workspace: &Workspace, program: &Path) -> PathBuf {
    let name = program.file_name().unwrap().to_string_lossy().into_owned();
    let is_of = |member: &&&str| {
        let name = name.rsplit_once('-').map_or(&*name, |(name, _)| name);
        name == member.replace('-', "_")
            || workspace.copy.join(member).join("tests").join(name).exists()
            || workspace.copy.join(member).join("tests").join(format!("{name}.rs")).exists()
    };
    let member = workspace.subject.members.iter().find(is_of).unwrap_or(&"tests");
    workspace.copy.join(member)
}

/// What the tests say of each change, in their order.
pub(crate) fn outcomes(
    workspace: &Workspace,
    tests: &[Test],
    numbers: &[u32],
    tell: impl Fn(u32, Outcome) + Sync,
) -> Result<Vec<Outcome>> {
    let outcomes = Mutex::new(vec![Outcome::NotReached; numbers.len()]);
    let last = numbers.iter().max().map_or(0, |&last| last as usize);
    let mut reaching = vec![Vec::new(); last + 1];
    for (i, test) in tests.iter().enumerate() {
        for &number in &test.reached {
            if let Some(list) = reaching.get_mut(number as usize) {
                list.push(i);
            }
        }
    }
    in_parallel(numbers.len(), |i| {
        let number = numbers[i];
        let list: Vec<&Test> = reaching[number as usize].iter().map(|&i| &tests[i]).collect();
        let outcome = outcome(workspace, &list, number)?;
        tell(number, outcome);
        outcomes.lock().unwrap()[i] = outcome;
        Ok(())
    })?;
    Ok(outcomes.into_inner().unwrap())
}

fn outcome(workspace: &Workspace, tests: &[&Test], number: u32) -> Result<Outcome> {
    if tests.is_empty() {
        return Ok(Outcome::NotReached);
    }
    let mut least = Duration::ZERO;
    for most in GROUPS {
        let mut programs = BTreeMap::<&Path, Vec<&Test>>::new();
        for test in tests.iter().filter(|test| test.time >= least && test.time < most) {
            programs.entry(&test.program).or_default().push(test);
        }
        for (program, tests) in programs {
            match together(&folder(workspace, program), program, &tests, number)? {
                Outcome::Survived => {}
                outcome => return Ok(outcome),
            }
        }
        least = most;
    }
    Ok(Outcome::Survived)
}

/// Tests of one program with one change. Processor time is limited, not time: other work on the machine does not matter.
fn together(folder: &Path, program: &Path, tests: &[&Test], number: u32) -> Result<Outcome> {
    let time: Duration = tests.iter().map(|test| test.time).sum();
    let limit = 2 + (4.0 * time.as_secs_f64()).ceil() as u64;
    let mut command = limited(limit, program);
    command.current_dir(folder).arg("--exact").args(tests.iter().map(|test| &test.name));
    command.arg("--test-threads=1").env("FLUISIM_MUTANT", number.to_string()).env("PROPTEST_RNG_SEED", "1");
    let status = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    let status = status.with_context(|| program.display().to_string())?;
    Ok(match (status.success(), status.code()) {
        (true, _) => Outcome::Survived,
        (false, Some(_)) => Outcome::Killed,
        (false, None) => match std::os::unix::process::ExitStatusExt::signal(&status) {
            Some(9 | 24) => Outcome::TooLong,
            _ => Outcome::Killed,
        },
    })
}

/// A program that ends after so many seconds of processor time, or with 8 GB.
fn limited(seconds: u64, program: &Path) -> Command {
    let mut command = Command::new("bash");
    command.args(["-c", "ulimit -t $0; ulimit -v 8000000; ulimit -c 0; exec \"$@\"", &seconds.to_string()]);
    command.arg(program);
    command
}

/// Does something for each index, in as many threads as there are processors.
fn in_parallel(count: usize, each: impl Fn(usize) -> Result<()> + Sync) -> Result<()> {
    let next = AtomicUsize::new(0);
    let failed = Mutex::new(None);
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Relaxed);
                    if i >= count || failed.lock().unwrap().is_some() {
                        break;
                    }
                    if let Err(error) = each(i) {
                        *failed.lock().unwrap() = Some(error);
                    }
                }
            });
        }
    });
    ensure!(next.load(Relaxed) >= count || failed.lock().unwrap().is_some());
    failed.into_inner().unwrap().map_or(Ok(()), Err)
}
