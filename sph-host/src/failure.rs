//! Why the command stops, and with which exit status.

use std::fmt;

use crate::io::ReadError;
use crate::output::WriteError;

/// One clear message, and whether the words of the command line or the files and data are at fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The words are wrong: exit status 2.
    Usage(String),
    /// The input or the run is at fault: exit status 1.
    Input(String),
}

impl Failure {
    /// The words are wrong.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::Usage(message.into())
    }

    /// Files or data are at fault.
    pub fn input(message: impl Into<String>) -> Self {
        Self::Input(message.into())
    }

    /// The exit status.
    #[must_use]
    pub fn status(&self) -> u8 {
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
            ReadError::UnknownEnding { .. } | ReadError::NotInPieces { .. } => Self::Usage(error.to_string()),
            _ => Self::Input(error.to_string()),
        }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        let hint = match &error {
            WriteError::NeedsGrid(_) => ": it needs --grid",
            WriteError::Exists(_) => "; use --force to replace it",
            _ => "",
        };
        let message = format!("{error}{hint}");
        if error.is_usage() { Self::Usage(message) } else { Self::Input(message) }
    }
}
