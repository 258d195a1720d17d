//! One case from beginning to end: steps, rows, frames.

use std::time::Instant;

use sph_core::scalar::compact::Compact;

use super::Solver;
use super::case::Case;
use super::measure::{COLUMNS, LAST_COLUMNS, Meter};
use super::series::{Check, Series};
use crate::engine::{PositionBased, RunError, Setup, Simulate, Simulation, Snapshot};
use crate::failure::Failure;
use crate::kernel_choice::KernelName;
use crate::output::Precision;
use crate::progress::Progress;
use crate::scalar_choice::{ScalarName, with_scalar};

/// Rows of the series in the time of one frame.
pub(super) const ROWS_A_FRAME: u64 = 4;

/// A case under way.
pub(super) struct Drive<'a, const D: usize> {
    pub(super) case: &'a dyn Case<D>,
    pub(super) setup: Setup<D>,
    meter: Meter<D>,
    simulation: Box<dyn Simulate<D>>,
    pub(super) series: Series,
    /// The time of a frame.
    every: f64,
    /// Frames so far, the one at the start included.
    pub(super) frames: u64,
    /// Of the numbers in frames.
    pub(super) precision: Precision,
    solver: Solver,
    /// Seconds that steps took, without what is measured and written.
    pub(super) stepping: f64,
}

/// With what a case is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Method {
    pub(super) solver: Solver,
    pub(super) scalar: ScalarName,
    pub(super) kernel: KernelName,
}

impl<'a, const D: usize> Drive<'a, D> {
    /// A case at its beginning, with a frame `every` so many seconds.
    pub(super) fn new(case: &'a dyn Case<D>, method: Method, every: f64) -> Result<Self, Failure> {
        let setup = case.setup();
        let simulation: Box<dyn Simulate<D>> = match (method.solver, method.scalar) {
            (Solver::Wcsph, ScalarName::F32) => {
                Box::new(Simulation::<f32, D>::new(&setup, method.kernel).map_err(refused)?)
            }
            (Solver::Wcsph, _) => {
                Box::new(Simulation::<f64, D>::new(&setup, method.kernel).map_err(refused)?)
            }
            (Solver::Pbf, scalar) => {
                let size = case.inside().map(|(_, upper)| upper);
                let interval = every / ROWS_A_FRAME as f64;
                with_scalar!(scalar, T => position_based::<T, D>(&setup, size, interval)?)
            }
        };
        let meter = Meter::new(&setup, case.inside(), method.solver).map_err(refused)?;
        let columns = COLUMNS.iter().chain(case.columns()).chain(&LAST_COLUMNS).copied();
        let series = Series::new(columns);
        let is_single = method.solver == Solver::Wcsph && method.scalar == ScalarName::F32;
        let precision = if is_single { Precision::F32 } else { Precision::F64 };
        Ok(Self {
            case,
            setup,
            meter,
            simulation,
            series,
            every,
            frames: 0,
            stepping: 0.0,
            precision,
            solver: method.solver,
        })
    }

    /// How many frames a duration has, the one at the start included, and one at the end where it ends between two.
    pub(super) fn frames_in(&self, duration: f64) -> u64 {
        (duration / self.every * (1.0 - 1e-12)).ceil() as u64 + 1
    }

    /// The time of a frame that is not the last.
    fn time_of(&self, frame: f64) -> f64 {
        self.every * frame
    }

    /// Whether the newest frame is where every run with these options has one, however long it is.
    pub(super) fn is_whole(&self) -> bool {
        let last = self.series.rows.last().map_or(0.0, |row| row[0]);
        last == self.time_of(self.frames.saturating_sub(1) as f64)
    }

    /// On to the next frame: rows on the way, forces anew at the end, as a resumed run has them. The first frame is the start,
    /// and none is later than `end`.
    pub(super) fn next_frame(&mut self, end: f64, progress: &dyn Progress) -> Result<Snapshot<D>, Failure> {
        if self.frames == 0 {
            self.frames = 1;
            return self.row();
        }
        let rows = (1..=ROWS_A_FRAME).map(|k| k as f64 / ROWS_A_FRAME as f64);
        let mut times: Vec<f64> = rows.map(|part| self.time_of((self.frames - 1) as f64 + part)).collect();
        if times.last().is_some_and(|&last| last > end * (1.0 + 1e-12)) {
            times.retain(|&time| time < end * (1.0 - 1e-12));
            times.push(end);
        }
        let mut snapshot = None;
        for time in times {
            let start = Instant::now();
            self.simulation.advance(time).map_err(|error| self.lost(error))?;
            self.stepping += start.elapsed().as_secs_f64();
            snapshot = Some(self.row()?);
            progress.advance(1);
        }
        self.simulation.prepare().map_err(|error| self.lost(error.into()))?;
        self.frames += 1;
        snapshot.map_or_else(|| self.row(), Ok)
    }

    /// Goes on from a frame that was written before: `frames` of them, and the rows up to there.
    pub(super) fn resume(
        &mut self,
        snapshot: &Snapshot<D>,
        steps: u64,
        frames: u64,
        stepping: f64,
        rows: Vec<Vec<f64>>,
    ) -> Result<(), Failure> {
        self.simulation.restore(snapshot, steps);
        self.simulation.prepare().map_err(refused)?;
        self.series.rows = rows;
        self.frames = frames;
        self.stepping = stepping;
        Ok(())
    }

    /// Steps so far.
    pub(super) fn steps(&self) -> u64 {
        self.simulation.steps()
    }

    /// What the run is judged by.
    pub(super) fn checks(&self, last: &Snapshot<D>) -> Vec<Check> {
        let outside = self.series.column("outside").iter().map(|point| point[1]).fold(0.0, f64::max);
        let mut checks = self.case.checks(&self.series, last);
        if self.solver == Solver::Pbf {
            let near = self.meter.share_nearer_than(0.6, last);
            checks.push(Check::at_most("particles nearer than 0.6 spacings, share", near, 0.01));
            let error = self.series.last("mean_density_error").unwrap_or(f64::NAN);
            checks.push(Check::at_most("compression at the end, mean", error, 0.03));
        }
        checks.push(Check::at_most("particles that escaped", outside, 0.0));
        checks
    }

    /// Measures the fluid now.
    fn row(&mut self) -> Result<Snapshot<D>, Failure> {
        let now = self.simulation.snapshot();
        let mut row = vec![now.time];
        row.extend(self.meter.measure(&now));
        row.extend(self.case.measure(&now));
        row.extend(self.meter.measure_last(&now));
        if let Some(column) = row.iter().position(|value| !value.is_finite()) {
            let name = &self.series.columns[column];
            let time = now.time;
            return Err(Failure::input(format!("the run failed at {time} s: {name} is not finite")));
        }
        self.series.rows.push(row);
        Ok(now)
    }

    fn lost(&self, error: RunError) -> Failure {
        let time = self.series.rows.last().map_or(0.0, |row| row[0]);
        Failure::input(format!("the run failed after {time} s: {error}"))
    }
}

fn position_based<T: Compact, const D: usize>(
    setup: &Setup<D>,
    size: [f64; D],
    interval: f64,
) -> Result<Box<dyn Simulate<D>>, Failure> {
    match PositionBased::<T, D>::new(setup, size, interval) {
        Ok(fluid) => Ok(Box::new(fluid)),
        Err(sph_core::Error::NotRepresentable { .. }) => {
            let cells = size.map(|length| length / setup.spacing / 2.0).into_iter().fold(0.0, f64::max);
            let name = T::NAME;
            let message = format!("--scalar: {name} has no room for a box of {cells} support radii");
            Err(Failure::usage(message))
        }
        Err(error) => Err(refused(error)),
    }
}

fn refused(error: sph_core::Error) -> Failure {
    Failure::input(format!("the case cannot begin: {error}"))
}
