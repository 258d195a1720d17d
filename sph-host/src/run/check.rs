//! What a case is measured against.

/// One thing that a case is measured against.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What is measured, and in what.
    pub name: String,
    /// What was found; `None` where the run ended before the time at which it is measured.
    pub value: Option<f64>,
    /// The greatest size allowed.
    pub goal: f64,
}

impl Check {
    /// A value whose size must not be above a goal.
    pub(super) fn at_most(name: impl Into<String>, value: impl Into<Option<f64>>, goal: f64) -> Self {
        Self { name: name.into(), value: value.into().filter(|value| !value.is_nan()), goal }
    }

    /// Whether the goal is met; `None` where nothing was measured.
    #[must_use]
    pub fn holds(&self) -> Option<bool> {
        self.value.map(|value| value.abs() <= self.goal)
    }
}
