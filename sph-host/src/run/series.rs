//! The time series of a run.

/// Rows of the series in the time of one frame.
pub(super) const ROWS_A_FRAME: u64 = 4;

/// The time of a row of the series, counted from 0, that is not of a last frame between two others. Every run with the same
/// spacing of frames has these times, however long it is.
pub(super) fn time_of_row(every: f64, row: u64) -> f64 {
    every * (row as f64 / ROWS_A_FRAME as f64)
}

/// Rows of named columns, the first of which is the time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// The names of the columns, `time` first.
    pub columns: Vec<String>,
    /// One value a column in each row, in the order of time.
    pub rows: Vec<Vec<f64>>,
}

impl Series {
    /// A series without rows.
    pub(super) fn new<'a>(columns: impl Iterator<Item = &'a str>) -> Self {
        Self {
            columns: std::iter::once("time").chain(columns).map(str::to_owned).collect(),
            rows: Vec::new(),
        }
    }

    /// The pairs (time, value) of a column; none where there is no such column.
    #[must_use]
    pub fn column(&self, name: &str) -> Vec<[f64; 2]> {
        let Some(index) = self.columns.iter().position(|column| column == name) else { return Vec::new() };
        self.rows.iter().map(|row| [row[0], row[index]]).collect()
    }

    /// The value of a column at a time, between rows by a straight line; `None` beyond the rows.
    #[must_use]
    pub fn at(&self, name: &str, time: f64) -> Option<f64> {
        let points = self.column(name);
        let slack = 1e-9 * points.last()?[0];
        let after = points.iter().position(|point| point[0] >= time - slack)?;
        let [t1, v1] = points[after];
        let Some(&[t0, v0]) = after.checked_sub(1).and_then(|before| points.get(before)) else {
            return (time >= t1 - slack).then_some(v1);
        };
        Some(v1 + (v0 - v1) * ((t1 - time) / (t1 - t0)).max(0.0))
    }

    /// The last value of a column.
    #[must_use]
    pub fn last(&self, name: &str) -> Option<f64> {
        self.column(name).last().map(|point| point[1])
    }

    /// The greatest value of a column at any time, and zero.
    pub(super) fn greatest(&self, name: &str) -> f64 {
        self.column(name).iter().map(|point| point[1]).fold(0.0, f64::max)
    }

    /// Whether the rows go on to a time.
    pub(super) fn has_reached(&self, time: f64) -> bool {
        self.rows.last().is_some_and(|row| row[0] >= time * (1.0 - 1e-9))
    }

    /// Kinetic, potential and compression energy together, over time.
    pub(super) fn energy(&self) -> Vec<[f64; 2]> {
        let parts =
            ["kinetic_energy", "potential_energy", "compression_energy"].map(|name| self.column(name));
        let [kinetic, potential, compression] = &parts;
        let sum = kinetic.iter().zip(potential).zip(compression);
        sum.map(|((k, p), c)| [k[0], k[1] + p[1] + c[1]]).collect()
    }

    /// The most that the energy ever rises above an earlier value, in parts of the first.
    pub(super) fn energy_growth(&self) -> f64 {
        let energy = self.energy();
        let first = energy.first().map_or(1.0, |point| point[1]);
        let mut lowest = f64::INFINITY;
        let mut growth = 0.0_f64;
        for [_, value] in energy {
            lowest = lowest.min(value);
            growth = growth.max(value - lowest);
        }
        growth / first.abs()
    }
}
