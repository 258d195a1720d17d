//! What a watch has seen.

use std::fmt::{Display, Formatter};

use super::record::Record;

/// What happened, place by place, in the order of files and lines. Its table has a line for each place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    records: Vec<Record>,
}

/// How often results left the range of their type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Saturations {
    all: u64,
    consequential: u64,
}

impl Saturations {
    /// Those that changed a comparison, or reached a sum or a result.
    #[must_use]
    pub fn consequential(self) -> u64 {
        self.consequential
    }

    /// Those after which everything is as if the type had no end.
    #[must_use]
    pub fn harmless(self) -> u64 {
        self.all - self.consequential
    }
}

impl Log {
    pub(super) fn new(mut records: Vec<Record>) -> Self {
        records.sort_by_key(|record| record.place.order());
        // one place of the source may have several addresses
        records.dedup_by(|later, first| {
            let is_same = later.place.order() == first.place.order();
            if is_same {
                first.merge(later);
            }
            is_same
        });
        Self { records }
    }

    /// The places, by file, line and column.
    #[must_use]
    pub fn places(&self) -> &[Record] {
        &self.records
    }

    /// The saturations of all places.
    #[must_use]
    pub fn saturations(&self) -> Saturations {
        Saturations {
            all: self.records.iter().map(|record| record.saturated).sum(),
            consequential: self.records.iter().map(|record| record.consequential).sum(),
        }
    }

    /// Comparisons that the truth decides otherwise, and all comparisons.
    #[must_use]
    pub fn comparisons(&self) -> (u64, u64) {
        let compared =
            self.records.iter().filter(|record| record.place.operation() == super::Operation::Compare);
        compared.fold((0, 0), |(otherwise, all), record| {
            (otherwise + record.decided_otherwise, all + record.count)
        })
    }

    /// The place of the largest magnitude.
    #[must_use]
    pub fn widest(&self) -> Option<&Record> {
        self.records.iter().max_by(|a, b| a.largest().total_cmp(&b.largest()))
    }

    /// Adds what another thread's watch has seen.
    pub fn merge(&mut self, more: Self) {
        let mut records = std::mem::take(&mut self.records);
        records.extend(more.records);
        *self = Self::new(records);
    }
}

impl Display for Log {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let widest = self.records.iter().map(|record| record.place.to_string().chars().count());
        let width = widest.max().unwrap_or(0).max(5);
        let head =
            ["count", "least", "largest", "bits", "vanished", "cancelled", "saturated", "consequential"];
        write!(f, "{:width$}", "place")?;
        head.iter().try_for_each(|title| write!(f, " {title:>13}"))?;
        writeln!(f)?;
        for record in &self.records {
            let least =
                if record.least.is_finite() { format!("{:.3e}", record.least) } else { String::from("-") };
            write!(f, "{:width$} {:>13} {least:>13}", record.place, record.count)?;
            write!(f, " {:>13} {:>13}", format!("{:.3e}", record.largest()), record.bits())?;
            let rest = [record.vanished, record.cancelled, record.saturated, record.consequential];
            rest.iter().try_for_each(|count| write!(f, " {count:>13}"))?;
            writeln!(f)?;
        }
        Ok(())
    }
}
