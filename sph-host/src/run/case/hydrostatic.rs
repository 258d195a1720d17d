//! Water at uniform density in a tank, gravity brought up over a second, settles until its pressure is ρ g (H − z).
//!
//! Set on at once, gravity makes the water ring up and down with 2 % of the pressure at the bed, and what damps that weakens with
//! resolution.

use super::{Case, View};
use crate::engine::{Setup, Snapshot, StateEquation, cells, centre, walls};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::run::series::{Check, Series};

/// The file of the plot.
pub(super) const PLOT: &str = "pressure.png";
const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;
/// H; the tank is as wide.
const DEPTH: f64 = 1.0;

/// The seconds in which gravity comes up.
const ONSET: f64 = 1.0;

/// Gravity along z at a time: a fifth-order smooth step.
fn gravity(time: f64) -> [f64; 2] {
    let s = (time / ONSET).clamp(0.0, 1.0);
    [0.0, -GRAVITY * s * s * s * (10.0 - s * (15.0 - 6.0 * s))]
}

/// The tank at rest.
pub(in crate::run) struct Hydrostatic {
    /// Particles over the depth.
    pub(in crate::run) resolution: u32,
}

impl Hydrostatic {
    fn spacing(&self) -> f64 {
        DEPTH / f64::from(self.resolution)
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
        let (spacing, reach, n) = (self.spacing(), 2.6, i64::from(self.resolution));
        let positions: Vec<_> = cells([0; 2], [n, n]).iter().map(|cell| centre(cell, spacing)).collect();
        let margin = 3.0 * spacing;
        Setup {
            spacing,
            reach,
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
            walls: walls([n, n + n / 2], reach.ceil() as i64, [(true, true), (true, false)], spacing),
            lower: [-margin; 2],
            upper: [DEPTH + margin, 1.5 * DEPTH + margin],
            periodic: [false; 2],
        }
    }

    fn duration(&self) -> f64 {
        4.0
    }

    fn inside(&self) -> [(f64, f64); 2] {
        [(0.0, DEPTH), (0.0, 1.5 * DEPTH)]
    }

    fn columns(&self) -> &'static [&'static str] {
        &["pressure_error"]
    }

    fn measure(&self, now: &Snapshot<2>) -> Vec<f64> {
        vec![Self::pressure_error(now)]
    }

    fn checks(&self, series: &Series, _: &Snapshot<2>) -> Vec<Check> {
        let mass = DENSITY * DEPTH * DEPTH;
        let kinetic = series.last("kinetic_energy").unwrap_or(f64::NAN) / (mass * GRAVITY * DEPTH);
        let error = series.last("pressure_error").unwrap_or(f64::NAN);
        vec![
            Check::at_most("pressure against ρ g (H − z), RMS / ρ g H", error, 0.02),
            Check::at_most("kinetic energy / m g H at the end", kinetic, 1e-4),
            Check::at_most("growth of total energy", series.energy_growth(), 1e-3),
        ]
    }

    fn plots(&self, series: &Series, last: &Snapshot<2>) -> (&'static str, Vec<Vec<Plot>>) {
        let weight = DENSITY * GRAVITY * DEPTH;
        let ours = last.positions.iter().zip(&last.pressures).map(|(x, p)| [p / weight, x[1] / DEPTH]);
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
                points: series.column("kinetic_energy").into_iter().skip(1).map(energy).collect(),
                mark: Mark::Line,
            }],
            ..Plot::default()
        };
        (PLOT, vec![vec![profile, kinetic]])
    }

    fn view(&self) -> View {
        View { radius: 0.5 * self.spacing(), lower: [0.0; 2], upper: [DEPTH, 1.1 * DEPTH], speed: 0.2 }
    }
}
