//! Choosing some of the particles of a file.

use std::fmt;

use super::error::SampleError;
use crate::io::PointTable;

/// Particles are taken where a column has a wanted value.
#[derive(Clone, Debug, PartialEq)]
pub struct Only {
    /// The column: an array of one number a point, a component, or a coordinate.
    pub name: String,
    /// The values.
    pub wanted: Wanted,
}

/// Values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// One of these. A number of a file that holds 32-bit floats is the same as one that rounds to it.
    Values(Vec<f64>),
    /// From the first to the second, both among them.
    Range(f64, f64),
}

impl Wanted {
    fn holds(&self, value: f64) -> bool {
        let is_single = f64::from(value as f32) == value;
        match self {
            Self::Values(values) => {
                values.iter().any(|&wanted| wanted == value || is_single && wanted as f32 == value as f32)
            }
            Self::Range(low, high) => (*low..=*high).contains(&value),
        }
    }
}

impl fmt::Display for Only {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}=", self.name)?;
        match &self.wanted {
            Wanted::Values(values) => {
                f.write_str(&values.iter().map(f64::to_string).collect::<Vec<_>>().join(","))
            }
            Wanted::Range(low, high) => write!(f, "{low}..{high}"),
        }
    }
}

/// How many particles of a file were taken, of how many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Taken {
    /// Taken.
    pub taken: usize,
    /// Of so many.
    pub of: usize,
}

impl Taken {
    /// Chooses the particles of a table, or of a piece of one, that meet all conditions, and counts them.
    pub(super) fn choose(&mut self, table: PointTable, only: &[Only]) -> Result<PointTable, SampleError> {
        self.of += table.len();
        let mut keep = vec![true; table.len()];
        for one in only {
            let values = table.column(&one.name)?;
            keep.iter_mut().zip(values.iter()).for_each(|(keep, &value)| *keep &= one.wanted.holds(value));
        }
        let chosen: Vec<usize> = (0..table.len()).filter(|&row| keep[row]).collect();
        self.taken += chosen.len();
        Ok(table.select(&chosen))
    }

    /// That some were taken of a file that has some.
    pub(super) fn require_some(self, file: &str, only: &[Only]) -> Result<(), SampleError> {
        if self.taken > 0 || self.of == 0 {
            return Ok(());
        }
        let only = only.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and ");
        Err(SampleError::NoneTaken { file: file.to_owned(), of: self.of, only })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_equal_or_round_to_the_same_single() {
        let wanted = Wanted::Values(vec![0.1, 3.0]);
        assert!(wanted.holds(0.1) && wanted.holds(f64::from(0.1_f32)) && wanted.holds(3.0));
        assert!(!wanted.holds(0.1 + 1e-12) && !wanted.holds(f64::NAN));
        let range = Wanted::Range(-1.0, 2.0);
        assert!(range.holds(-1.0) && range.holds(2.0) && !range.holds(2.1) && !range.holds(f64::NAN));
    }
}
