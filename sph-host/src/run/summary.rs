//! The result of a run: `summary.json` and the table on the screen.

use std::fmt::Write;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use super::case_run::CaseRun;
use super::check::Check;
use super::parameters::Parameters;
use crate::engine::Snapshot;

/// The result of a run.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The content of `summary.json`.
    pub json: Value,
    /// What the case is measured against.
    pub checks: Vec<Check>,
    /// The greatest number of particles that were beyond the walls at one time.
    pub escaped: usize,
    /// The files to look at: what each is, and its path.
    pub files: Vec<(&'static str, PathBuf)>,
}

impl Summary {
    pub(super) fn new<const D: usize>(
        run: &CaseRun<D>,
        last: &Snapshot<D>,
        parameters: &Parameters,
        wall: f64,
    ) -> Self {
        let checks = run.checks(last);
        let mut json = parameters.to_json();
        json.extend(run.case.particulars());
        json.extend(measured(run, last, wall));
        json.insert("checks".into(), checks.iter().map(check_json).collect());
        Self { json: Value::Object(json), checks, escaped: run.most_outside() as usize, files: Vec::new() }
    }

    /// The checks that fall short of their goals.
    pub fn short(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| check.holds() == Some(false))
    }

    /// The run in a few lines, and a line for each check.
    #[must_use]
    pub fn table(&self) -> String {
        let mut text = String::new();
        let line = |name: &str| {
            let value = &self.json[name];
            value.as_str().map_or_else(|| number(value.as_f64().unwrap_or(f64::NAN)), str::to_owned)
        };
        for (title, name) in [
            ("case", "case"),
            ("solver", "solver"),
            ("particles", "particles"),
            ("steps", "steps"),
            ("simulated / s", "simulated_s"),
            ("wall time / s", "wall_s"),
            ("particle-steps / s", "particle_steps_per_s"),
            ("µs / particle-step", "us_per_particle_step"),
            ("mean time step / s", "mean_dt_s"),
            ("mass drift", "mass_drift"),
            ("momentum drift", "momentum_drift"),
            ("energy drift", "energy_drift"),
        ] {
            let _ = writeln!(text, "{title:<20}{}", line(name));
        }
        let wide = self.checks.iter().map(|check| check.name.chars().count()).max().unwrap_or(0);
        let _ = writeln!(text, "\n{:<wide$}  {:>10}  {:>8}", "against what is known", "found", "at most");
        for check in &self.checks {
            let verdict = match check.holds() {
                Some(true) => "holds",
                Some(false) => "FALLS SHORT",
                None => "not measured: the run ended before",
            };
            let value = check.value.map_or_else(|| String::from("-"), number);
            let goal = number(check.goal);
            let _ = writeln!(text, "{:<wide$}  {value:>10}  {goal:>8}  {verdict}", check.name);
        }
        let _ = writeln!(text);
        for (what, path) in &self.files {
            let _ = writeln!(text, "{what:<20}{}", path.display());
        }
        text
    }
}

/// What every run measures.
fn measured<const D: usize>(run: &CaseRun<D>, last: &Snapshot<D>, wall: f64) -> Map<String, Value> {
    let (particles, steps) = (last.positions.len(), run.tally().steps);
    let energy = run.series.energy();
    let [first, end] = [energy.first(), energy.last()].map(|energy| energy.map_or(0.0, |energy| energy[1]));
    let scale = if first == 0.0 { 1.0 } else { first.abs() };
    let outside = run.series.last("outside").unwrap_or(0.0);
    let work = particles as f64 * steps as f64;
    let pairs = [
        ("particles", json!(particles)),
        ("wall_particles", json!(run.setup.walls.len())),
        ("steps", json!(steps)),
        ("put_back", json!(run.tally().put_back)),
        ("iterations", json!(run.tally().iterations)),
        ("simulated_s", json!(last.time)),
        ("wall_s", json!(wall)),
        ("particle_steps_per_s", json!(work / wall.max(1e-9))),
        ("stepping_s", json!(run.stepping)),
        ("us_per_particle_step", json!(1e6 * run.stepping / work.max(1.0))),
        ("mean_dt_s", json!(last.time / (steps as f64).max(1.0))),
        ("stepping_s_per_simulated_s", json!(run.stepping / last.time.max(f64::MIN_POSITIVE))),
        ("mass_drift", json!(if outside > 0.0 { -outside / particles as f64 } else { 0.0 })),
        ("momentum_drift", json!(run.series.last("momentum_error"))),
        ("energy_drift", json!((end - first) / scale)),
    ];
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// A check as `summary.json` has it: `value` and `holds` are null where nothing was measured.
fn check_json(check: &Check) -> Value {
    json!({"name": check.name, "value": check.value, "goal": check.goal, "holds": check.holds()})
}

/// Four digits, whole numbers in full.
fn number(value: f64) -> String {
    if value.is_nan() {
        String::from("-")
    } else if value == value.trunc() && value.abs() < 1e15 {
        format!("{value}")
    } else if (1e-3..1e6).contains(&value.abs()) {
        let digits = (3 - value.abs().log10().floor() as i32).clamp(0, 6) as usize;
        format!("{value:.digits$}")
    } else {
        format!("{value:.2e}")
    }
}
