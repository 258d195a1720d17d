//! How a file's rows are called in messages.

/// The numbers by which a file's rows are known: lines of a text table, else points from 0.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    /// The line of the header of a text table.
    header: Option<usize>,
    /// Pairs of a row and its number, from where on both go in step.
    steps: Vec<(usize, usize)>,
}

impl Rows {
    /// Rows of a text table, called by their lines.
    pub(super) fn lines(header: usize) -> Self {
        Self { header: Some(header), steps: Vec::new() }
    }

    /// Rows called by number, from 0.
    pub(super) fn points() -> Self {
        Self { header: None, steps: Vec::new() }
    }

    /// The line of the header of a text table.
    pub(super) fn header(&self) -> Option<usize> {
        self.header
    }

    /// Notes the number of the next row.
    pub(super) fn push(&mut self, row: usize, number: usize) {
        if self.steps.last().is_none_or(|&(first, start)| start + (row - first) != number) {
            self.steps.push((row, number));
        }
    }

    /// Such as `line 17` or `point 12`.
    pub(super) fn locate(&self, row: usize) -> String {
        let word = if self.header.is_some() { "line" } else { "point" };
        format!("{word} {}", self.number(row))
    }

    /// Where the file has the value of `array` in a row.
    pub(super) fn place(&self, row: usize, array: &str) -> String {
        match self.header {
            Some(_) => format!("{}, column `{array}`", self.locate(row)),
            None => format!("{} of array `{array}`", self.locate(row)),
        }
    }

    /// These of the rows, in ascending order.
    pub(super) fn select(&self, chosen: &[usize]) -> Self {
        let mut rows = Self { header: self.header, steps: Vec::new() };
        chosen.iter().enumerate().for_each(|(row, &old)| rows.push(row, self.number(old)));
        rows
    }

    fn number(&self, row: usize) -> usize {
        let after = self.steps.partition_point(|&(first, _)| first <= row);
        let before = after.checked_sub(1).map(|step| self.steps[step]);
        let (first, start) = before.unwrap_or((0, if self.header.is_some() { 2 } else { 0 }));
        start + (row - first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_rows_keep_their_numbers() {
        let mut lines = Rows::lines(3);
        for (row, line) in [(0, 4), (1, 5), (2, 9)] {
            lines.push(row, line);
        }
        let chosen = lines.select(&[1, 2]);
        assert_eq!((chosen.locate(0), chosen.locate(1)), ("line 5".into(), "line 9".into()));
        let twice = Rows::points().select(&[3, 4, 7]).select(&[0, 2]);
        assert_eq!((twice.locate(0), twice.place(1, "m")), ("point 3".into(), "point 7 of array `m`".into()));
    }
}
