//! The copy of the workspace in which the changes are made.

use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::change::{Change, with_switches};

/// What is measured: a package, the part of its sources that is changed, and the packages whose tests are run.
pub(crate) struct Subject {
    /// The package that is changed.
    pub(crate) package: &'static str,
    /// Folders or files below its `src`; empty for all.
    pub(crate) parts: &'static [&'static str],
    /// Folders and files of the repository that are needed.
    pub(crate) needed: &'static [&'static str],
    /// The packages that stay members of the workspace, by their folders.
    pub(crate) members: &'static [&'static str],
    /// The packages whose tests are run.
    pub(crate) tested: &'static [&'static str],
}

/// sph-core and all tests that need nothing of the host.
pub(crate) const CORE: Subject = Subject {
    package: "sph-core",
    parts: &[],
    needed: &[
        "Cargo.toml",
        "Cargo.lock",
        "sph-core",
        "sph-lab",
        "tests/Cargo.toml",
        "tests/tests/bit_identity.rs",
        "tests/tests/mathematics",
        "tests/tests/neighbours",
        "tests/on-target/digest",
    ],
    members: &["sph-core", "sph-lab", "tests"],
    // sph-lab holds its numbers against these at hundreds of formats: half of the time, and no other arithmetic
    tested: &["sph-core", "fluisim-tests"],
};

/// The copy: where it is, and what is in it.
pub(crate) struct Workspace {
    /// The repository.
    pub(crate) root: PathBuf,
    /// The copy.
    pub(crate) copy: PathBuf,
    /// What is measured.
    pub(crate) subject: &'static Subject,
}

impl Workspace {
    /// Copies what is needed; files that are as they were stay, so that nothing is built twice.
    pub(crate) fn new(subject: &'static Subject) -> Result<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
        let copy = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/copy").join(subject.package);
        let workspace = Self { root, copy, subject };
        for path in subject.needed {
            workspace.take(Path::new(path))?;
        }
        workspace.without_the_rest()?;
        Ok(workspace)
    }

    fn take(&self, path: &Path) -> Result<()> {
        let from = self.root.join(path);
        if !from.is_dir() {
            let is_source = path.starts_with(self.sources());
            return if is_source { Ok(()) } else { write(&self.copy.join(path), &fs::read(&from)?) };
        }
        for entry in fs::read_dir(&from).with_context(|| from.display().to_string())? {
            let name = entry?.file_name();
            if name != "target" && name != "web" && name != "c" {
                self.take(&path.join(name))?;
            }
        }
        Ok(())
    }

    /// The manifests without the packages that are left out.
    fn without_the_rest(&self) -> Result<()> {
        let path = self.copy.join("Cargo.toml");
        let text = fs::read_to_string(&path)?;
        let members = format!("members = {:?}", self.subject.members);
        let text: String = text
            .lines()
            .map(|line| if line.starts_with("members = ") { &members } else { line })
            .flat_map(|line| [line, "\n"])
            .collect();
        write(&path, text.replace("line-tables-only", "none").as_bytes())?;
        let path = self.copy.join("tests/Cargo.toml");
        let text = fs::read_to_string(&path)?;
        let is_kept = |line: &&str| self.subject.package == "sph-host" || !line.starts_with("sph-host");
        let text: String = text.lines().filter(is_kept).flat_map(|line| [line, "\n"]).collect();
        write(&path, text.as_bytes())?;
        // its own text is the READMEs'
        write(&self.copy.join("tests/src/lib.rs"), b"//! Nothing but tests.\n")
    }

    /// The folder of the sources that are changed, below the repository and below the copy.
    pub(crate) fn sources(&self) -> PathBuf {
        Path::new(self.subject.package).join("src")
    }

    /// The source files that are changed and those that are not, below the folder of the sources, in the order of their names.
    pub(crate) fn files(&self) -> Result<Vec<(PathBuf, bool)>> {
        let mut files = Vec::new();
        list(&self.root.join(self.sources()), Path::new(""), &mut files)?;
        files.sort();
        let parts = self.subject.parts;
        let is_changed = |path: &Path| {
            let is_of_tests = path.iter().any(|name| name == "tests" || name == "tests.rs");
            !is_of_tests && (parts.is_empty() || parts.iter().any(|part| path.starts_with(part)))
        };
        Ok(files
            .into_iter()
            .map(|file| {
                let changed = is_changed(&file) && file.extension().is_some_and(|ending| ending == "rs");
                (file, changed)
            })
            .collect())
    }

    /// Writes the sources with these changes.
    pub(crate) fn write(&self, changes: &[Change], count: usize) -> Result<()> {
        for (file, _) in self.files()? {
            let bytes = fs::read(self.root.join(self.sources()).join(&file))?;
            let name = file.to_string_lossy();
            let of_file: Vec<Change> = changes.iter().filter(|change| change.file == name).cloned().collect();
            let mut bytes = match of_file.is_empty() {
                true => bytes,
                false => small(&with_switches(&String::from_utf8(bytes)?, &of_file)).into_bytes(),
            };
            if name == "lib.rs" {
                let switch = include_str!("switch.txt").replace("COUNT", &(count + 1).to_string());
                bytes.extend(switch.bytes());
            }
            write(&self.copy.join(self.sources()).join(&file), &bytes)?;
        }
        Ok(())
    }

    /// cargo in the copy, with its own target folder; what a change makes doubtful is not an error there.
    pub(crate) fn cargo(&self) -> Command {
        let mut cargo = Command::new("cargo");
        cargo.current_dir(&self.copy).env("CARGO_TARGET_DIR", self.copy.join("../target"));
        cargo.env("CARGO_INCREMENTAL", "0");
        cargo.env("RUSTFLAGS", "-Awarnings -Aarithmetic_overflow -Aunconditional_panic");
        cargo
    }
}

fn list(root: &Path, below: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    for entry in fs::read_dir(root.join(below))? {
        let entry = entry?;
        let path = below.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            list(root, &path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}

/// With functions that stay functions: where each is put into each of its callers, with all its switches, the compiler has no end.
fn small(text: &str) -> String {
    text.replace("inline(always)", "inline")
}

/// Writes a file where its bytes are others.
fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    fs::create_dir_all(path.parent().unwrap())?;
    fs::write(path, bytes).with_context(|| path.display().to_string())
}
