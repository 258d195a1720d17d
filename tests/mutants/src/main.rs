//! Which changes of the arithmetic no test notices: every operator, number and body of the sources is changed, one at a time, and the
//! tests are run.
//!
//! All changes are compiled at once, each behind its number, so that there is one build. Each test is run once to see which changes it
//! reaches; for a change only those tests are run, the quickest first, until one fails.
//!
//!     cargo run -- core               all of sph-core; writes core.md and fails below 97 % of those that differ
//!     cargo run -- core disc.rs       the changes whose file, function or text has these letters; prints what survives

mod change;
mod compile;
mod copy;
mod find;
mod report;
mod rules;
mod run;

use anyhow::{Context, Result, bail};
use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::time::Instant;

use change::Change;
use copy::{Subject, Workspace};
use run::Outcome;

/// Of the changes that compute something else, so many must be noticed, in percent.
const GOAL: f64 = 97.0;

fn subject(name: &str) -> Result<&'static Subject> {
    match name {
        "core" => Ok(&copy::CORE),
        _ => bail!("there is nothing called {name}; expected core"),
    }
}

/// All changes of the subject, numbered.
fn find(workspace: &Workspace) -> Result<Vec<Change>> {
    let mut changes = Vec::new();
    for (file, is_changed) in workspace.files()? {
        if is_changed {
            let source = std::fs::read_to_string(workspace.root.join(workspace.sources()).join(&file))?;
            changes.extend(find::changes(&file.to_string_lossy(), &source)?);
        }
    }
    for (number, change) in (1..).zip(&mut changes) {
        change.number = number;
    }
    Ok(changes)
}

/// What the lists call the changes: where one function has the same change twice, with its place among them.
fn names(changes: &[Change]) -> Vec<String> {
    let mut seen = HashMap::new();
    let name = |change: &Change| {
        let name = change.name();
        let count = seen.entry(name.clone()).or_insert(0);
        *count += 1;
        if *count == 1 { name } else { format!("{name} ({count})") }
    };
    changes.iter().map(name).collect()
}

fn measure(name: &str, letters: Option<&str>) -> Result<bool> {
    let start = Instant::now();
    let workspace = Workspace::new(subject(name)?)?;
    let changes = find(&workspace)?;
    let names = names(&changes);
    let mut kept = changes.clone();
    let dropped = compile::drop_what_does_not_compile(&workspace, &mut kept)?;
    println!(
        "{} changes, of which {} do not compile; {} s",
        changes.len(),
        dropped.len(),
        start.elapsed().as_secs()
    );
    let programs = compile::tests(&workspace)?;
    let tests = run::watch(&workspace, &programs)?;
    println!("{} tests of {} programs; {} s", tests.len(), programs.len(), start.elapsed().as_secs());
    let name_of = |number: u32| &names[number as usize - 1];
    let numbers: Vec<u32> = kept.iter().map(|change| change.number).collect();
    let numbers: Vec<u32> = numbers
        .into_iter()
        .filter(|&number| letters.is_none_or(|letters| name_of(number).contains(letters)))
        .collect();
    let done = AtomicUsize::new(0);
    let outcomes = run::outcomes(&workspace, &tests, &numbers, |number, outcome| {
        let done = 1 + done.fetch_add(1, Relaxed);
        if matches!(outcome, Outcome::Survived | Outcome::NotReached) {
            println!("{outcome:?}, line {}: {}", changes[number as usize - 1].line, name_of(number));
        }
        if done.is_multiple_of(100) {
            println!("{done} of {}; {} s", numbers.len(), start.elapsed().as_secs());
        }
    })?;
    let outcomes: BTreeMap<u32, Outcome> = numbers.into_iter().zip(outcomes).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let equivalent = report::Equivalent::read(&folder.join(format!("{name}.equivalent")))?;
    let page = report::page(&changes, &names, &outcomes, &equivalent);
    println!("{page}\n{} s", start.elapsed().as_secs());
    if letters.is_some() {
        return Ok(true);
    }
    std::fs::write(folder.join(format!("{name}.md")), &page)?;
    let all: Vec<_> = changes
        .iter()
        .zip(names)
        .map(|(change, name)| (name, outcomes.get(&change.number).copied()))
        .collect();
    let faults = equivalent.faults(&all);
    faults.iter().for_each(|fault| println!("{name}.equivalent: {fault}"));
    let killed =
        outcomes.values().filter(|outcome| matches!(outcome, Outcome::Killed | Outcome::TooLong)).count();
    let same = all.iter().filter(|(name, _)| equivalent.has(name)).count();
    Ok(faults.is_empty() && 100.0 * killed as f64 >= GOAL * (outcomes.len() - same) as f64)
}

fn main() -> Result<ExitCode> {
    let mut words = std::env::args().skip(1);
    let name = words.next().context("expected what to change: core")?;
    let is_reached = measure(&name, words.next().as_deref())?;
    Ok(if is_reached { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
