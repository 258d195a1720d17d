//! Runs the command in a folder of its own and looks at what it leaves there.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// A folder in which the command runs.
pub(crate) struct Folder(tempfile::TempDir);

/// What a run had to say.
#[derive(Debug)]
pub(crate) struct Said {
    pub(crate) status: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// A CSV result: the header and the numbers below it, NaN for an empty cell.
#[derive(Debug, PartialEq)]
pub(crate) struct Columns {
    pub(crate) names: Vec<String>,
    pub(crate) values: Vec<Vec<f64>>,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// A folder with one file in it.
    pub(crate) fn with(name: &str, content: impl AsRef<[u8]>) -> Self {
        let folder = Self::new();
        folder.write(name, content);
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    /// The names of all files, hidden ones too.
    pub(crate) fn names(&self) -> BTreeSet<String> {
        self.names_in("")
    }

    /// The names of all files of a folder in it.
    pub(crate) fn names_in(&self, place: &str) -> BTreeSet<String> {
        let entries = fs::read_dir(self.path(place)).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    /// The command with words that are separated by blanks.
    pub(crate) fn command(&self, words: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_fluisim"));
        command.current_dir(self.0.path()).args(words.split_whitespace());
        command
    }

    pub(crate) fn run(&self, words: &str) -> Said {
        Said::from(self.command(words).output().unwrap())
    }

    /// A run that succeeds.
    pub(crate) fn succeed(&self, words: &str) -> Said {
        let said = self.run(words);
        assert_eq!(said.status, Some(0), "{words}: {}", said.stderr);
        said
    }

    /// The columns that a run prints.
    pub(crate) fn columns(&self, words: &str) -> Columns {
        Columns::parse(&self.succeed(words).stdout)
    }

    /// The message of a run that fails with `status`, prints nothing, and leaves the folder as it is.
    pub(crate) fn fail(&self, status: i32, words: &str) -> String {
        let before = self.names();
        let said = self.run(words);
        assert_eq!(said.status, Some(status), "{words}: {}", said.stderr);
        assert_eq!(said.stdout, "", "{words}");
        assert!(said.stderr.starts_with("error: "), "{words}: {}", said.stderr);
        assert_eq!(self.names(), before, "{words}");
        said.stderr
    }

    /// As [`fail`](Self::fail), and the message has all of `parts`.
    pub(crate) fn fail_with(&self, status: i32, words: &str, parts: &[&str]) {
        let message = self.fail(status, words);
        for part in parts {
            assert!(message.contains(part), "{words}: `{part}` is missing in {message}");
        }
    }
}

impl From<Output> for Said {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { status: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}

impl Columns {
    pub(crate) fn parse(text: &str) -> Self {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
        let mut values = vec![Vec::new(); names.len()];
        for record in reader.records() {
            for (column, cell) in values.iter_mut().zip(record.unwrap().iter()) {
                column.push(if cell.is_empty() { f64::NAN } else { cell.parse().unwrap() });
            }
        }
        Self { names, values }
    }

    /// The column of this name.
    pub(crate) fn get(&self, name: &str) -> &[f64] {
        let index = self.names.iter().position(|known| known == name);
        &self.values[index.unwrap_or_else(|| panic!("no `{name}` among {:?}", self.names))]
    }
}

/// |a − b| ≤ `relative` · max(|a|, |b|, `scale`), or both are NaN.
pub(crate) fn is_close(a: f64, b: f64, relative: f64, scale: f64) -> bool {
    (a.is_nan() && b.is_nan()) || (a - b).abs() <= relative * a.abs().max(b.abs()).max(scale)
}

/// The largest magnitude among finite values.
pub(crate) fn magnitude(values: &[f64]) -> f64 {
    values.iter().filter(|value| value.is_finite()).fold(0.0, |most, value| most.max(value.abs()))
}

/// Numbers in [0, 1), the same every time (a multiplicative congruential sequence).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
