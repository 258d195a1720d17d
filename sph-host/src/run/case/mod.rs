//! The cases: how each begins, what is measured, and against what.

mod dam_break;
mod drop;
mod hydrostatic;
mod poiseuille;
mod taylor_green;
mod tilt;

pub(super) use dam_break::DamBreak;
pub(super) use drop::Drop;
pub(super) use hydrostatic::Hydrostatic;
pub(super) use poiseuille::Poiseuille;
pub(super) use taylor_green::TaylorGreen;
pub(super) use tilt::Tilt;

use serde_json::{Map, Value};

use super::frame;
use super::series::{Check, Series};
use crate::engine::{Setup, Snapshot};
use crate::picture::plot::Plot;
use crate::picture::{Image, PictureError};

/// The files of all plots.
pub(super) const PLOTS: [&str; 6] =
    [dam_break::PLOT, drop::PLOT, hydrostatic::PLOT, poiseuille::PLOT, taylor_green::PLOT, tilt::PLOT];

/// What pictures show.
pub(super) struct View {
    /// The box, across and up.
    pub(super) lower: [f64; 2],
    pub(super) upper: [f64; 2],
    /// The radius of a particle.
    pub(super) radius: f64,
    /// The greatest speed of the colours.
    pub(super) speed: f64,
}

/// A case in D dimensions.
pub(super) trait Case<const D: usize> {
    /// The beginning.
    fn setup(&self) -> Setup<D>;

    /// How long it is simulated, s.
    fn duration(&self) -> f64;

    /// The box that no particle may leave.
    fn inside(&self) -> [(f64, f64); D] {
        [(f64::NEG_INFINITY, f64::INFINITY); D]
    }

    /// What is measured beyond what is measured in every case.
    fn columns(&self) -> &'static [&'static str];

    /// The values of these columns.
    fn measure(&self, now: &Snapshot<D>) -> Vec<f64>;

    /// What the series and the last state are judged by.
    fn checks(&self, series: &Series, last: &Snapshot<D>) -> Vec<Check>;

    /// What summary.json says beyond what it says in every case.
    fn particulars(&self) -> Map<String, Value> {
        Map::new()
    }

    /// The plot against the reference: its file's name and rows of plots.
    fn plots(&self, series: &Series, last: &Snapshot<D>) -> (&'static str, Vec<Vec<Plot>>);

    /// What pictures show.
    fn view(&self) -> View;

    /// The picture of a frame.
    fn picture(&self, now: &Snapshot<D>, title: &str) -> Result<Image, PictureError> {
        frame::particles(now, &self.view(), title)
    }
}

/// Momentum and angular momentum, for cases without walls.
fn conservation(series: &Series, tolerance: f64, spin: bool) -> Vec<Check> {
    let worst = |name| series.column(name).iter().map(|point| point[1].abs()).fold(0.0, f64::max);
    let mut checks = vec![Check::at_most("momentum error / sum of m|v|", worst("momentum_error"), tolerance)];
    if spin {
        let name = "angular momentum error / sum of m|x||v|";
        checks.push(Check::at_most(name, worst("angular_momentum_error"), tolerance));
    }
    checks
}
