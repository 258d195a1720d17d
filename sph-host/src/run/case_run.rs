//! A case under way: steps, rows of the series, frames. Nothing is written here.

use std::time::Instant;

use super::check::Check;
use super::definition::{Case, Results};
use super::diagnostics::{COLUMNS, Diagnostics, LAST_COLUMNS};
use super::error::Error;
use super::method::Method;
use super::parameters::Parameters;
use super::series::{ROWS_A_FRAME, Series, time_of_row};
use super::solver::Solver;
use crate::engine::{RunError, Setup, Simulate, Snapshot, Tally};
use crate::progress::Progress;

/// The last columns of the series: what was counted so far.
pub(super) const COUNTS: [&str; 3] = ["put_back", "iterations", "steps"];

/// A case under way.
pub(super) struct CaseRun<'a, const D: usize> {
    pub(super) case: &'a dyn Case<D>,
    pub(super) setup: Setup<D>,
    pub(super) method: Method,
    pub(super) series: Series,
    /// Frames so far, the one at the start included.
    pub(super) frames: u64,
    /// Seconds that steps took, without what is measured and written.
    pub(super) stepping: f64,
    diagnostics: Diagnostics<D>,
    simulation: Box<dyn Simulate<D>>,
    /// Seconds from frame to frame.
    every: f64,
    /// Seconds to simulate.
    time: f64,
}

impl<'a, const D: usize> CaseRun<'a, D> {
    /// A case at its beginning.
    pub(super) fn new(case: &'a dyn Case<D>, parameters: &Parameters) -> Result<Self, Error> {
        let Parameters { case: name, solver, scalar, kernel, every, time, .. } = *parameters;
        let method = Method { solver, scalar, kernel };
        let mut setup = case.setup();
        let simulation = method.simulation(&setup, case.inside(), every / ROWS_A_FRAME as f64)?;
        if method.solver == Solver::Incompressible {
            // what it keeps is counted from where its particles have settled
            setup.positions = simulation.snapshot().positions;
        }
        let diagnostics = Diagnostics::new(&setup, case.inside(), method.has_equation_of_state());
        let columns = COLUMNS.iter().chain(name.columns()).chain(&LAST_COLUMNS).chain(&COUNTS);
        Ok(Self {
            case,
            setup,
            method,
            series: Series::new(columns.copied()),
            frames: 0,
            stepping: 0.0,
            diagnostics: diagnostics.map_err(Error::Begin)?,
            simulation,
            every,
            time,
        })
    }

    /// How many frames the whole run has: the one at the start, and one at the end where the end is between two.
    fn all_frames(&self) -> u64 {
        (self.time / self.every * (1.0 - 1e-12)).ceil() as u64 + 1
    }

    /// Goes on to the last frame, and gives each new frame to `add`; `now` is the fluid where the run stands, if it has begun. Returns
    /// the fluid at the end.
    pub(super) fn go_on(
        &mut self,
        now: Option<Snapshot<D>>,
        progress: &dyn Progress,
        mut add: impl FnMut(&Self, &Snapshot<D>) -> Result<(), Error>,
    ) -> Result<Snapshot<D>, Error> {
        let frames = self.all_frames();
        let rows = |frames: u64| frames.saturating_sub(1) * ROWS_A_FRAME;
        progress.begin(rows(frames), rows(self.frames.min(frames)));
        let mut last = match now {
            Some(now) => now,
            None => {
                let first = self.next_frame(progress)?;
                add(self, &first)?;
                first
            }
        };
        while self.frames < frames {
            last = self.next_frame(progress)?;
            add(self, &last)?;
        }
        progress.end();
        Ok(last)
    }

    /// Goes on to the next frame; the first is the start. Forces are worked out anew at each frame, as a resumed run has them.
    fn next_frame(&mut self, progress: &dyn Progress) -> Result<Snapshot<D>, Error> {
        if self.frames == 0 {
            self.frames = 1;
            return self.measure();
        }
        let mut snapshot = None;
        for time in self.times_to_next_frame() {
            let start = Instant::now();
            self.simulation.advance(time).map_err(|error| self.failed(error))?;
            self.stepping += start.elapsed().as_secs_f64();
            snapshot = Some(self.measure()?);
            progress.advance(1);
        }
        self.simulation.prepare().map_err(|error| self.failed(error.into()))?;
        self.frames += 1;
        snapshot.map_or_else(|| self.measure(), Ok)
    }

    /// The times of the rows up to the next frame, none of them later than the end.
    fn times_to_next_frame(&self) -> Vec<f64> {
        let first = (self.frames - 1) * ROWS_A_FRAME;
        let mut times: Vec<f64> =
            (1..=ROWS_A_FRAME).map(|row| time_of_row(self.every, first + row)).collect();
        if times.last().is_some_and(|&last| last > self.time * (1.0 + 1e-12)) {
            times.retain(|&time| time < self.time * (1.0 - 1e-12));
            times.push(self.time);
        }
        times
    }

    /// Goes on from the last of so many frames of an earlier run, with the rows up to there.
    pub(super) fn go_on_from(
        &mut self,
        last: &Snapshot<D>,
        frames: u64,
        rows: Vec<Vec<f64>>,
    ) -> Result<(), Error> {
        // The last columns have whole numbers.
        let counts = rows.last().and_then(|row| row.last_chunk());
        let [put_back, iterations, steps] =
            counts.map_or([0; 3], |counts| counts.map(|count: f64| count as u64));
        self.simulation.restore(last, Tally { steps, put_back, iterations });
        self.simulation.prepare().map_err(Error::Begin)?;
        self.series.rows = rows;
        self.frames = frames;
        Ok(())
    }

    /// What was counted so far.
    pub(super) fn tally(&self) -> Tally {
        self.simulation.tally()
    }

    /// Seconds simulated so far.
    pub(super) fn time(&self) -> f64 {
        self.series.rows.last().map_or(0.0, |row| row[0])
    }

    /// What checks and plots are made from.
    pub(super) fn results<'b>(&'b self, last: &'b Snapshot<D>) -> Results<'b, D> {
        Results { series: &self.series, last, solver: self.method.solver, rounding: self.method.rounding() }
    }

    /// What the run is measured against.
    pub(super) fn checks(&self, last: &Snapshot<D>) -> Vec<Check> {
        let mut checks = self.case.checks(&self.results(last));
        let mean = "mean_density_error";
        match self.method.solver {
            Solver::Wcsph => {}
            Solver::Incompressible => {
                // without the first row: a lattice that was moved about is not the solver's
                let after = |name| self.series.column(name).into_iter().skip(1).map(|point| point[1]);
                let rows = self.series.rows.len().saturating_sub(1);
                let average = (rows > 0).then(|| after(mean).sum::<f64>() / rows as f64);
                let worst = after("max_density_error").reduce(f64::max);
                checks.push(Check::at_most("compression, mean over particles and time", average, 1e-3));
                checks.push(Check::at_most("compression, worst at any time", worst, 0.1));
            }
            Solver::Pbf => {
                let near = self.diagnostics.share_of_near(last);
                checks.push(Check::at_most("particles nearer than 0.6 spacings, share", near, 0.01));
                checks.push(Check::at_most("compression at the end, mean", self.series.last(mean), 0.03));
            }
        }
        checks.push(Check::at_most("particles that escaped", self.most_outside(), 0.0));
        checks
    }

    /// The greatest number of particles that were outside at one time.
    pub(super) fn most_outside(&self) -> f64 {
        self.series.greatest("outside")
    }

    /// Measures the fluid now: a row of the series.
    fn measure(&mut self) -> Result<Snapshot<D>, Error> {
        let now = self.simulation.snapshot();
        let mut row = vec![now.time];
        row.extend(self.diagnostics.measure(&now));
        row.extend(self.case.measure(&now));
        row.extend(self.diagnostics.measure_last(&now));
        let Tally { steps, put_back, iterations } = self.simulation.tally();
        row.extend([put_back, iterations, steps].map(|count| count as f64));
        if let Some(column) = row.iter().position(|value| !value.is_finite()) {
            let column = self.series.columns.get(column).cloned().unwrap_or_default();
            return Err(Error::NotFinite { time: now.time, column });
        }
        self.series.rows.push(row);
        Ok(now)
    }

    fn failed(&self, error: RunError) -> Error {
        Error::of_solver(self.time(), error)
    }
}
