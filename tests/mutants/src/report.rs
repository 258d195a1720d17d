//! The table by module and the list of survivors.

use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use crate::change::{Change, one_line};
use crate::run::Outcome;

/// Changes that compute the same, each with the reason.
pub(crate) struct Equivalent(BTreeMap<String, String>);

impl Equivalent {
    /// Reads the list: file, function, change and reason, separated by tabs. Lines that begin with `#` are for readers.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
        let mut reasons = BTreeMap::new();
        for (line, text) in (1..).zip(text.lines()) {
            if text.starts_with('#') {
                continue;
            }
            let Some((name, reason)) = text.rsplit_once('\t').filter(|(_, reason)| !reason.is_empty()) else {
                bail!(
                    "{}:{line}: expected file, function, change and reason with tabs between",
                    path.display()
                );
            };
            reasons.insert(name.to_owned(), reason.to_owned());
        }
        Ok(Self(reasons))
    }

    /// Whether it is in the list.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// What is wrong with the list: entries of nothing, and those that a test kills.
    pub(crate) fn faults(&self, changes: &[(String, Option<Outcome>)]) -> Vec<String> {
        let mut faults = Vec::new();
        for name in self.0.keys() {
            let outcomes: Vec<_> =
                changes.iter().filter(|(other, _)| other == name).map(|(_, outcome)| *outcome).collect();
            if outcomes.is_empty() {
                faults.push(format!("there is no such change: {name}"));
            } else if outcomes
                .iter()
                .any(|outcome| matches!(outcome, Some(Outcome::Killed | Outcome::TooLong)))
            {
                faults.push(format!("a test kills it: {name}"));
            }
        }
        faults
    }
}

#[derive(Default)]
struct Row {
    changes: usize,
    killed: usize,
    equivalent: usize,
    survived: usize,
}

/// The results as a page: a table by module, and the survivors.
pub(crate) fn page(
    changes: &[Change],
    names: &[String],
    outcomes: &BTreeMap<u32, Outcome>,
    equivalent: &Equivalent,
) -> String {
    let mut rows = BTreeMap::<String, Row>::new();
    let mut survivors = String::new();
    for (change, name) in changes.iter().zip(names) {
        let Some(outcome) = outcomes.get(&change.number) else {
            rows.entry(module(&change.file)).or_default().changes += 1;
            continue;
        };
        let row = rows.entry(module(&change.file)).or_default();
        row.changes += 1;
        match outcome {
            Outcome::Killed | Outcome::TooLong => row.killed += 1,
            _ if equivalent.has(name) => row.equivalent += 1,
            _ => {
                row.survived += 1;
                let seen = if *outcome == Outcome::NotReached { ", reached by no test" } else { "" };
                let Change { file, line, function, before, text, .. } = change;
                writeln!(
                    survivors,
                    "- `{file}:{line}` `{function}`: `{before}` → `{}`{seen}",
                    one_line(text)
                )
                .unwrap();
            }
        }
    }
    let mut page = String::from(
        "| module | changes | do not compile | killed | equivalent | survive | killed of those that differ |\n|---|---|---|---|---|---|---|\n",
    );
    let mut all = Row::default();
    for (module, row) in &rows {
        write_row(&mut page, module, row);
        all.changes += row.changes;
        all.killed += row.killed;
        all.equivalent += row.equivalent;
        all.survived += row.survived;
    }
    write_row(&mut page, "all", &all);
    if !survivors.is_empty() {
        write!(page, "\nWhat survives:\n\n{survivors}").unwrap();
    }
    page
}

fn write_row(page: &mut String, module: &str, row: &Row) {
    let Row { changes, killed, equivalent, survived } = row;
    let differ = killed + survived;
    let part = if differ == 0 { 100.0 } else { 100.0 * *killed as f64 / differ as f64 };
    let refused = changes - differ - equivalent;
    writeln!(
        page,
        "| {module} | {changes} | {refused} | {killed} | {equivalent} | {survived} | {part:.1} % |"
    )
    .unwrap();
}

/// The folder of a file; of those in no folder, the file.
fn module(file: &str) -> String {
    let path = Path::new(file);
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    folder.unwrap_or(path).display().to_string()
}
