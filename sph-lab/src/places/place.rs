//! A place of the source.

use std::fmt::{Display, Formatter};
use std::panic::Location;

/// What is done at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operation {
    /// a + b
    Add,
    /// a − b
    Subtract,
    /// a · b
    Multiply,
    /// a / b
    Divide,
    /// n a for an integer n.
    Times,
    /// √a
    Root,
    /// A literal n / d.
    Ratio,
    /// A number of a table.
    Constant,
    /// From an f64.
    Convert,
    /// What is left behind a place in a table.
    Split,
    /// A term added to a sum.
    Term,
    /// A sum rounded to the type.
    Total,
    /// a < b and its like.
    Compare,
}

impl Operation {
    /// A short word or sign for it.
    #[must_use]
    pub fn sign(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Times => "times",
            Self::Root => "sqrt",
            Self::Ratio => "ratio",
            Self::Constant => "constant",
            Self::Convert => "from_f64",
            Self::Split => "split",
            Self::Term => "term",
            Self::Total => "total",
            Self::Compare => "compare",
        }
    }
}

/// A line and column of the source, and the operation there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    location: &'static Location<'static>,
    operation: Operation,
}

impl Place {
    pub(super) fn new(location: &'static Location<'static>, operation: Operation) -> Self {
        Self { location, operation }
    }

    /// The file, from its crate's `src` on: `influence/kernel.rs`.
    #[must_use]
    pub fn file(&self) -> &'static str {
        let file = self.location.file();
        ["/src/", "\\src\\"].iter().find_map(|source| Some(file.rsplit_once(source)?.1)).unwrap_or(file)
    }

    /// The line, from 1.
    #[must_use]
    pub fn line(&self) -> u32 {
        self.location.line()
    }

    /// The column, from 1.
    #[must_use]
    pub fn column(&self) -> u32 {
        self.location.column()
    }

    /// What is done there.
    #[must_use]
    pub fn operation(&self) -> Operation {
        self.operation
    }

    /// By file, line, column and operation: the same on every run.
    pub(super) fn order(&self) -> (&'static str, u32, u32, Operation) {
        (self.location.file(), self.line(), self.column(), self.operation)
    }
}

/// `influence/kernel.rs:104 *`
impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.pad(&format!("{}:{} {}", self.file(), self.line(), self.operation.sign()))
    }
}
