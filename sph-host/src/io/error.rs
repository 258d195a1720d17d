//! What can be wrong with a particle file.

use std::io;
use std::path::Path;

/// Why a particle file cannot be read, or does not hold what is asked of it. Each message names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The ending of the file's name is not known. The file has not been looked at.
    #[error(
        "{file}: {}: one of {} is expected, each also with .gz behind",
        unknown_ending(Path::new(file)),
        list(super::ENDINGS)
    )]
    UnknownEnding {
        /// The file's name as given.
        file: String,
    },
    /// Files with this ending cannot be read some points at a time. The file has not been looked at.
    #[error(
        "{file}: a file with this ending is not read some points at a time: one of {} is expected",
        list(super::read::endings_in_pieces())
    )]
    NotInPieces {
        /// The file's name as given.
        file: String,
    },
    /// A group was named for a file that has none. The file has not been looked at.
    #[error(
        "{file}: a file with this ending has no groups; one of {} has",
        list(super::endings_that_take(super::Takes::Groups))
    )]
    NoGroups {
        /// The file's name as given.
        file: String,
    },
    /// Several groups hold particles, and none was named.
    #[error("{file}: several groups hold particles: {sets}")]
    SeveralSets {
        /// The file's name as given.
        file: String,
        /// What they are called, with commas between.
        sets: String,
    },
    /// The name belongs to a pipe or a device.
    #[error("{file}: this is {found}; {expected}")]
    NotAFile {
        /// The file's name as given.
        file: String,
        /// What is there.
        found: &'static str,
        /// What can be read, and why only that.
        expected: &'static str,
    },
    /// The system does not give the file's bytes.
    #[error("{file}: {source}")]
    Io {
        /// The file's name as given.
        file: String,
        /// What the system said.
        source: io::Error,
    },
    /// It is not clear where the coordinates are.
    #[error("{file}: {}{problem}", .at.as_ref().map(|at| format!("{at}: ")).unwrap_or_default())]
    Position {
        /// The file's name as given.
        file: String,
        /// Where in the file: the line of the header.
        at: Option<String>,
        /// What is there, and what was expected.
        problem: String,
    },
    /// Lines are to be skipped in a file that is no text table. The file has not been looked at.
    #[error(
        "{file}: lines are skipped in text tables alone: {}",
        list(super::endings_that_take(super::Takes::Lines))
    )]
    NoLines {
        /// The file's name as given.
        file: String,
    },
    /// A file that names pieces beside it is packed or standard input.
    #[error("{file}: a file that names pieces is read where it stands, beside them, and not packed")]
    NotBeside {
        /// The file's name as given.
        file: String,
    },
    /// The format that was named is not known.
    #[error(
        "the format {format} is not known: one of {} is expected, each also with .gz behind",
        list(super::ENDINGS)
    )]
    UnknownFormat {
        /// The format as given.
        format: String,
    },
    /// Standard input has no name whose ending would say what it holds.
    #[error("standard input: its format is not known")]
    NoFormat,
    /// The file's content is wrong, or does not hold what is asked of it.
    #[error("{file}: {}{problem}", .at.as_ref().map(|at| format!("{at}: ")).unwrap_or_default())]
    Invalid {
        /// The file's name as given.
        file: String,
        /// Where in the file: a line and column, a point and array.
        at: Option<String>,
        /// What is wrong there, and what was expected.
        problem: String,
    },
}

/// A [`ReadError`] before the file's name is known.
#[derive(Debug)]
pub(super) enum Problem {
    Io(io::Error),
    NotAFile { found: &'static str, expected: &'static str },
    Position { at: Option<String>, problem: String },
    SeveralSets { sets: String },
    Invalid { at: Option<String>, problem: String },
}

/// What the parsers return.
pub(super) type Parsed<T> = Result<T, Problem>;

impl Problem {
    /// A problem of the file as a whole.
    pub(super) fn new(problem: impl Into<String>) -> Self {
        Self::Invalid { at: None, problem: problem.into() }
    }

    /// A problem of one place of the file.
    pub(super) fn at(at: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Invalid { at: Some(at.into()), problem: problem.into() }
    }

    /// It is not clear where the coordinates are.
    pub(super) fn position(problem: impl Into<String>) -> Self {
        Self::Position { at: None, problem: problem.into() }
    }

    /// The problem, its place being `place` unless it is known better.
    pub(super) fn or_at(self, place: &str) -> Self {
        match self {
            Self::Invalid { at: None, problem } => Self::at(place, problem),
            Self::Position { at: None, problem } => Self::Position { at: Some(place.to_owned()), problem },
            other => other,
        }
    }

    pub(super) fn in_file(self, file: &str) -> ReadError {
        let file = file.to_owned();
        match self {
            Self::Io(source) => ReadError::Io { file, source },
            Self::NotAFile { found, expected } => ReadError::NotAFile { file, found, expected },
            Self::Position { at, problem } => ReadError::Position { file, at, problem },
            Self::SeveralSets { sets } => ReadError::SeveralSets { file, sets },
            Self::Invalid { at, problem } => ReadError::Invalid { file, at, problem },
        }
    }
}

impl From<io::Error> for Problem {
    fn from(source: io::Error) -> Self {
        Self::Io(source)
    }
}

/// Says that the ending of a path is not known.
pub(crate) fn unknown_ending(path: &Path) -> String {
    let inner = path.file_stem().map(Path::new).and_then(Path::extension);
    match (path.extension(), inner) {
        (Some(ending), Some(inner)) if ending.eq_ignore_ascii_case("gz") => {
            format!("the ending .{}.{} is not known", inner.display(), ending.display())
        }
        (Some(ending), _) => format!("the ending .{} is not known", ending.display()),
        (None, _) => "the name has no ending".to_owned(),
    }
}

/// Names with commas between.
fn list<'a>(names: impl IntoIterator<Item = &'a &'a str>) -> String {
    names.into_iter().copied().collect::<Vec<_>>().join(", ")
}

/// A number of things, in the singular for one.
pub(super) fn counted(count: usize, thing: &str) -> String {
    if count == 1 { format!("1 {thing}") } else { format!("{count} {thing}s") }
}

/// Text of a file for a message: what is no UTF-8 replaced, control characters escaped, cut after 40 characters.
pub(super) fn shown(text: &[u8]) -> String {
    const MOST: usize = 40;
    let text = String::from_utf8_lossy(&text[..text.len().min(4 * MOST)]);
    let cut = if text.chars().nth(MOST).is_some() { "…" } else { "" };
    let mut start = String::new();
    for c in text.chars().take(MOST) {
        if c.is_control() { start.extend(c.escape_default()) } else { start.push(c) }
    }
    format!("`{start}{cut}`")
}
