//! What a case has to say of itself: [`Definition`] once, [`Case`] for each number of dimensions.

use serde_json::{Map, Value};

use super::check::Check;
use super::drawing::{self, View};
use super::series::Series;
use super::solver::Solver;
use crate::engine::{Setup, Snapshot};
use crate::picture::plot::Plot;
use crate::picture::{Image, PictureError};

/// What is known of a case before it is built.
pub(super) struct Definition {
    /// The length that the resolution counts particles across.
    pub(super) across: &'static str,
    /// How long it is simulated unless another time is asked for, s.
    pub(super) duration: fn() -> f64,
    /// The file of the plot against the reference.
    pub(super) plot: &'static str,
    /// The columns of the series that only this case has.
    pub(super) columns: &'static [&'static str],
    /// The solvers that can simulate it.
    pub(super) solvers: &'static [Solver],
    /// The case in two dimensions.
    pub(super) in_2d: Option<Form<2>>,
    /// The case in three dimensions.
    pub(super) in_3d: Option<Form<3>>,
}

/// A case in D dimensions, before its resolution is known.
pub(super) struct Form<const D: usize> {
    /// The resolution unless another is asked for.
    pub(super) resolution: u32,
    /// The solver unless another is asked for.
    pub(super) solver: Solver,
    /// Builds the case with this many particles across.
    pub(super) build: fn(u32) -> Box<dyn Case<D>>,
}

/// What checks and plots are made from.
pub(super) struct Results<'a, const D: usize> {
    /// The time series.
    pub(super) series: &'a Series,
    /// The fluid at the end.
    pub(super) last: &'a Snapshot<D>,
    /// The solver.
    pub(super) solver: Solver,
    /// Relative rounding of a sum over the particles, which momentum is kept to.
    pub(super) rounding: f64,
}

/// A case in D dimensions.
pub(super) trait Case<const D: usize>: Sync {
    /// The fluid before its first step.
    fn setup(&self) -> Setup<D>;

    /// The box that no particle may leave, from where to where along each axis.
    fn inside(&self) -> [(f64, f64); D] {
        [(f64::NEG_INFINITY, f64::INFINITY); D]
    }

    /// The values of the columns of [`Definition::columns`].
    fn measure(&self, now: &Snapshot<D>) -> Vec<f64>;

    /// What the case is measured against.
    fn checks(&self, results: &Results<D>) -> Vec<Check>;

    /// What `summary.json` says of this case alone.
    fn particulars(&self) -> Map<String, Value> {
        Map::new()
    }

    /// The plot against the reference: rows of plots.
    fn plots(&self, results: &Results<D>) -> Vec<Vec<Plot>>;

    /// What pictures show.
    fn view(&self) -> View;

    /// The picture of a frame. It depends on the frame alone.
    fn picture(&self, now: &Snapshot<D>, title: &str) -> Result<Image, PictureError> {
        drawing::particles(now, &self.view(), title)
    }
}

impl<const D: usize> Results<'_, D> {
    /// Momentum, and angular momentum if `angular`, for cases without walls.
    pub(super) fn conservation(&self, angular: bool) -> Vec<Check> {
        let worst = |name| self.series.column(name).iter().map(|point| point[1].abs()).fold(0.0, f64::max);
        let check = |name: &str, column| Check::at_most(name, worst(column), self.rounding);
        let mut checks = vec![check("momentum error / sum of m|v|", "momentum_error")];
        if angular {
            checks.push(check("angular momentum error / sum of m|x||v|", "angular_momentum_error"));
        }
        checks
    }

    /// The last value of a column, once the run has come to a time.
    pub(super) fn last_from(&self, column: &str, time: f64) -> Option<f64> {
        self.series.last(column).filter(|_| self.series.has_reached(time))
    }
}
