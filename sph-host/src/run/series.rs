//! The time series of a run, and what is judged by it.

/// Rows of named columns, the first of which is the time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Series {
    pub(super) columns: Vec<String>,
    pub(super) rows: Vec<Vec<f64>>,
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
    pub(super) fn column(&self, name: &str) -> Vec<[f64; 2]> {
        let Some(index) = self.columns.iter().position(|column| column == name) else { return Vec::new() };
        self.rows.iter().map(|row| [row[0], row[index]]).collect()
    }

    /// The value of a column at a time, between rows by a straight line; `None` beyond the rows.
    pub(super) fn at(&self, name: &str, time: f64) -> Option<f64> {
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
    pub(super) fn last(&self, name: &str) -> Option<f64> {
        self.column(name).last().map(|point| point[1])
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

/// One thing that a case is measured against.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What is measured, and in what.
    pub name: String,
    /// What was found; NaN where the run did not come so far.
    pub value: f64,
    /// The most that is allowed.
    pub goal: f64,
}

impl Check {
    /// A value whose size must not be above a goal.
    pub(super) fn at_most(name: impl Into<String>, value: f64, goal: f64) -> Self {
        Self { name: name.into(), value, goal }
    }

    /// Whether the goal is met.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.value.abs() <= self.goal
    }
}
