//! What a run comes to.

use std::fmt::Write;

use std::path::PathBuf;

use serde_json::{Map, Value, json};

use super::drive::Drive;
use super::series::Check;
use crate::engine::Snapshot;

/// The end of a run, as `summary.json` has it.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The content of `summary.json`.
    pub json: Value,
    /// What the case is measured against.
    pub checks: Vec<Check>,
    /// Particles that are, or were, beyond the walls.
    pub escaped: usize,
    /// What there is to look at: what it is, and where.
    pub files: Vec<(&'static str, PathBuf)>,
}

impl Summary {
    pub(super) fn new<const D: usize>(
        drive: &Drive<D>,
        last: &Snapshot<D>,
        particulars: Value,
        wall_seconds: f64,
    ) -> Self {
        let checks = drive.checks(last);
        let particles = last.positions.len();
        let energy = drive.series.energy();
        let (first, final_energy) =
            (energy.first().map_or(0.0, |e| e[1]), energy.last().map_or(0.0, |e| e[1]));
        let scale = if first == 0.0 { 1.0 } else { first.abs() };
        let escaped = drive.series.last("outside").unwrap_or(0.0);
        let most = drive.series.column("outside").iter().map(|point| point[1]).fold(0.0, f64::max);
        let work = particles as f64 * drive.steps() as f64;
        let measured = json!({
            "particles": particles,
            "wall_particles": drive.setup.walls.len(),
            "steps": drive.steps(),
            "simulated_s": last.time,
            "wall_s": wall_seconds,
            "particle_steps_per_s": work / wall_seconds.max(1e-9),
            "stepping_s": drive.stepping,
            "us_per_particle_step": 1e6 * drive.stepping / work.max(1.0),
            "mean_dt_s": last.time / (drive.steps() as f64).max(1.0),
            "stepping_s_per_simulated_s": drive.stepping / last.time.max(f64::MIN_POSITIVE),
            "mass_drift": if escaped > 0.0 { -escaped / particles as f64 } else { 0.0 },
            "momentum_drift": drive.series.last("momentum_error"),
            "energy_drift": (final_energy - first) / scale,
            "checks": checks.iter().map(check_json).collect::<Vec<_>>(),
        });
        let mut json = Map::new();
        for part in [particulars, Value::Object(drive.case.particulars()), measured] {
            if let Value::Object(part) = part {
                json.extend(part);
            }
        }
        Self { json: Value::Object(json), checks, escaped: most as usize, files: Vec::new() }
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
            let verdict = if check.holds() { "holds" } else { "FALLS SHORT" };
            let (value, goal) = (number(check.value), number(check.goal));
            let _ = writeln!(text, "{:<wide$}  {value:>10}  {goal:>8}  {verdict}", check.name);
        }
        let _ = writeln!(text);
        for (what, path) in &self.files {
            let _ = writeln!(text, "{what:<20}{}", path.display());
        }
        text
    }
}

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
