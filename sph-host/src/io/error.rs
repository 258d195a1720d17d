//! What can be wrong with a particle file.

use std::io;

/// Why a particle file, or something asked of it, could not be had. Each message names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file's name ends in nothing that is known: the words are at fault, not the file.
    #[error("{file}: files are read by their ending, one of {}", super::ENDINGS.join(", "))]
    UnknownEnding {
        /// The file's name as given.
        file: String,
    },
    /// The file's name ends in nothing that can be read piece by piece: the words are at fault, not the file.
    #[error("{file}: a file is read in pieces by its ending, one of .csv, .tsv, .npz")]
    NotInPieces {
        /// The file's name as given.
        file: String,
    },
    /// The system would not give the file's bytes.
    #[error("{file}: {source}")]
    Io {
        /// The file's name as given.
        file: String,
        /// What the system said.
        source: io::Error,
    },
    /// The file's content is at fault, or has not what is asked of it.
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

    /// The problem, its place being `place` unless it is known better.
    pub(super) fn or_at(self, place: &str) -> Self {
        match self {
            Self::Invalid { at: None, problem } => Self::at(place, problem),
            other => other,
        }
    }

    pub(super) fn in_file(self, file: &str) -> ReadError {
        let file = file.to_owned();
        match self {
            Self::Io(source) => ReadError::Io { file, source },
            Self::Invalid { at, problem } => ReadError::Invalid { file, at, problem },
        }
    }
}

impl From<io::Error> for Problem {
    fn from(source: io::Error) -> Self {
        Self::Io(source)
    }
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
