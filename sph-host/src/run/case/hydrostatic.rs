//! Water at uniform density in a tank, gravity brought up over a second, settles until its pressure is ρ g (H − z).
//!
//! Set on at once, gravity makes the water ring up and down with 2 % of the pressure at the bed, and what damps that weakens with
//! resolution.

use crate::engine::{Setup, Snapshot, StateEquation, cells, centre};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::run::check::Check;
use crate::run::definition::{Case, Definition, Form, Results};
use crate::run::drawing::View;
use crate::run::solver::Solver;
use crate::run::tank::Tank;

/// The case.
pub(super) static CASE: Definition = Definition {
    across: "the depth",
    duration: || AT_REST,
    plot: "pressure.png",
    columns: &["pressure_error"],
    solvers: &[Solver::Wcsph],
    in_2d: Some(Form { resolution: 40, build: |resolution| Box::new(Hydrostatic { resolution }) }),
    in_3d: None,
};

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;
/// H; the tank is as wide.
const DEPTH: f64 = 1.0;

/// The seconds in which gravity comes up.
const ONSET: f64 = 1.0;

/// The time from which the water counts as at rest, s.
const AT_REST: f64 = 4.0;

/// Gravity along z at a time: a fifth-order smooth step.
fn gravity(time: f64) -> [f64; 2] {
    let s = (time / ONSET).clamp(0.0, 1.0);
    [0.0, -GRAVITY * s * s * s * (10.0 - s * (15.0 - 6.0 * s))]
}

/// The tank at rest.
struct Hydrostatic {
    /// Particles over the depth.
    resolution: u32,
}

impl Hydrostatic {
    fn spacing(&self) -> f64 {
        DEPTH / f64::from(self.resolution)
    }

    /// The tank, open at the top.
    fn tank(&self) -> Tank<2> {
        let n = i64::from(self.resolution);
        Tank {
            counts: [n, n + n / 2],
            size: [DEPTH, 1.5 * DEPTH],
            spacing: self.spacing(),
            ends: [(true, true), (true, false)],
        }
    }

    /// Root mean square of p − ρ g (H − z) over all particles, in parts of ρ g H.
    fn pressure_error(now: &Snapshot<2>) -> f64 {
        let weight = DENSITY * GRAVITY;
        let errors = now.positions.iter().zip(&now.pressures).map(|(x, p)| p - weight * (DEPTH - x[1]));
        let mean = errors.map(|error| error * error).sum::<f64>() / now.positions.len() as f64;
        mean.sqrt() / (weight * DEPTH)
    }
}

impl Case<2> for Hydrostatic {
    fn setup(&self) -> Setup<2> {
        let (spacing, tank, n) = (self.spacing(), self.tank(), i64::from(self.resolution));
        let positions: Vec<_> = cells([0; 2], [n, n]).iter().map(|cell| centre(cell, spacing)).collect();
        Setup {
            spacing,
            reach: 2.6,
            state_equation: StateEquation::Tait,
            rest_density: DENSITY,
            sound_speed: 10.0 * (2.0 * GRAVITY * DEPTH).sqrt(),
            gravity: [0.0, -GRAVITY],
            gravity_at: gravity,
            artificial_viscosity: 0.1,
            kinematic_viscosity: 0.0,
            density_diffusion: 0.1,
            shift_speed: 0.0,
            velocities: vec![[0.0; 2]; positions.len()],
            pressures: vec![0.0; positions.len()],
            positions,
            walls: tank.walls(),
            lower: tank.lower(),
            upper: tank.upper(),
            periodic: [false; 2],
        }
    }

    fn inside(&self) -> [(f64, f64); 2] {
        self.tank().inside()
    }

    fn measure(&self, now: &Snapshot<2>) -> Vec<f64> {
        vec![Self::pressure_error(now)]
    }

    fn checks(&self, results: &Results<2>) -> Vec<Check> {
        let mass = DENSITY * DEPTH * DEPTH;
        let kinetic = results.last_from("kinetic_energy", AT_REST);
        let kinetic = kinetic.map(|energy| energy / (mass * GRAVITY * DEPTH));
        let error = results.last_from("pressure_error", AT_REST);
        vec![
            Check::at_most("pressure against ρ g (H − z), RMS / ρ g H", error, 0.02),
            Check::at_most("kinetic energy / m g H at the end", kinetic, 1e-4),
            Check::at_most("growth of total energy", results.series.energy_growth(), 1e-3),
        ]
    }

    fn plots(&self, results: &Results<2>) -> Vec<Vec<Plot>> {
        let weight = DENSITY * GRAVITY * DEPTH;
        let ours = results.last.positions.iter().zip(&results.last.pressures).map(|(x, p)| [p / weight, x[1] / DEPTH]);
        let profile = Plot {
            title: "Pressure of every particle at the end".into(),
            x_title: "p / (ρ g H)".into(),
            y_title: "z / H".into(),
            series: vec![
                Curve { name: "fluisim".into(), points: ours.collect(), mark: Mark::Points },
                Curve {
                    name: "ρ g (H − z)".into(), points: vec![[1.0, 0.0], [0.0, 1.0]], mark: Mark::Line
                },
            ],
            ..Plot::default()
        };
        let energy = |[t, e]: [f64; 2]| [t, (e / (weight * DEPTH * DEPTH)).max(1e-12).log10()];
        let kinetic = Plot {
            title: "Kinetic energy".into(),
            x_title: "t / s".into(),
            y_title: "log₁₀ of kinetic energy / (m g H)".into(),
            series: vec![Curve {
                name: "fluisim".into(),
                points: results.series.column("kinetic_energy").into_iter().skip(1).map(energy).collect(),
                mark: Mark::Line,
            }],
            ..Plot::default()
        };
        vec![vec![profile, kinetic]]
    }

    fn view(&self) -> View {
        View { radius: 0.5 * self.spacing(), lower: [0.0; 2], upper: [DEPTH, 1.1 * DEPTH], speed: 0.2 }
    }
}

#[cfg(test)]
mod tests {
    use crate::run::CaseName;
    use crate::run::tests::{assert_within, values};
    use crate::scalar_choice::ScalarName;

    #[test]
    fn water_at_rest_stays_at_rest() {
        let found = values(CaseName::Hydrostatic, 12, ScalarName::F64, None);
        assert_within(&found, &[[1e-4, 0.02], [1e-12, 1e-4], [0.0, 1e-3], [0.0, 0.0]]);
    }

    #[test]
    fn nothing_is_measured_before_the_water_is_at_rest() {
        let found = values(CaseName::Hydrostatic, 8, ScalarName::F64, Some(0.05));
        assert!(found[0].is_nan() && found[1].is_nan() && found[2].is_finite(), "{found:?}");
    }
}
