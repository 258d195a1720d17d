//! Why the command stops, and with which exit status.

use std::fmt;
use std::path::Path;

use crate::io::ReadError;
use crate::output::{Content, Format, WriteError};

/// One clear message, and whether the words of the command line or the files and data are at fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// The words are wrong: exit status 2.
    Usage(String),
    /// The input or the run is at fault: exit status 1.
    Input(String),
}

impl Failure {
    /// The words are wrong.
    pub(super) fn usage(message: impl Into<String>) -> Self {
        Self::Usage(message.into())
    }

    /// Files or data are at fault.
    pub(super) fn input(message: impl Into<String>) -> Self {
        Self::Input(message.into())
    }

    /// The exit status.
    pub(super) fn status(&self) -> u8 {
        match self {
            Self::Usage(_) => 2,
            Self::Input(_) => 1,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (Self::Usage(message) | Self::Input(message)) = self;
        f.write_str(message)
    }
}

impl std::error::Error for Failure {}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::UnknownEnding { .. } => Self::Usage(error.to_string()),
            ReadError::NoLines { .. } => Self::Usage(format!("{error}; leave out --skip-lines")),
            ReadError::NotBeside { .. } => Self::Usage(error.to_string()),
            ReadError::UnknownFormat { .. } => Self::Usage(error.to_string()),
            ReadError::NoFormat => Self::Usage(format!("{error}: say by --format, such as --format csv")),
            ReadError::Position { .. } => Self::Input(format!(
                "{error}; --position NAME (an array) or --position X,Y[,Z] (columns) says where coordinates are"
            )),
            ReadError::NoGroups { .. } => Self::Usage(format!("{error}; leave out --group")),
            ReadError::NotInPieces { .. } => Self::Usage(format!("{error}; leave out --chunk")),
            _ => Self::Input(error.to_string()),
        }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        let hint = match &error {
            WriteError::Unfit { path, content } => needed_instead(path, *content),
            WriteError::Exists(_) => "; use --force to replace it",
            _ => "",
        };
        let message = format!("{error}{hint}");
        if error.is_usage() { Self::Usage(message) } else { Self::Input(message) }
    }
}

/// The option that gives what a file can hold.
fn needed_instead(path: &Path, content: Content) -> &'static str {
    let holds = |content| Format::of(path).is_some_and(|format| format.holds.contains(&content));
    if content != Content::Surface && holds(Content::Surface) {
        "; this ending needs --surface NAME=LEVEL and a --grid of three axes"
    } else if content == Content::Points && holds(Content::Grid) {
        "; this ending needs --grid"
    } else {
        ""
    }
}
