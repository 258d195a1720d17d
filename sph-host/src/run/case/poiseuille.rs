//! Flow between plates at rest, started by a body force F along them.
//!
//! ```text
//! v(y, t) = F/(2ν) y (L − y) − Σ_{n odd} 4 F L²/(ν π³ n³) sin(nπy/L) exp(−n²π² ν t/L²)
//! ```
//!
//! Source: J. P. Morris, P. J. Fox, Y. Zhu, *Modeling low Reynolds number incompressible flows using SPH*, J. Comput. Phys. 136
//! (1997) 214, sect. 4.1.2, eq. (45): L = 1 mm, ν = 10⁻⁶ m²/s, F = 10⁻⁴ m/s², Re = 0.0125.

use std::f64::consts::PI;

use crate::engine::{Setup, Snapshot, StateEquation, cells, centre, walls};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::run::check::Check;
use crate::run::definition::{Case, Definition, Form, Results};
use crate::run::drawing::View;
use crate::run::solver::Solver;

/// The case.
pub(super) static CASE: Definition = Definition {
    across: "the channel",
    duration: || TIMES[3],
    plot: "profile.png",
    columns: &["profile_error"],
    solvers: &[Solver::Wcsph],
    in_2d: Some(Form {
        resolution: 40,
        solver: Solver::Wcsph,
        build: |resolution| Box::new(Poiseuille { resolution }),
    }),
    in_3d: None,
};

const WIDTH: f64 = 1e-3;
const VISCOSITY: f64 = 1e-6;
const FORCE: f64 = 1e-4;
/// The times of the paper's figure before the flow is steady.
const TIMES: [f64; 4] = [0.0225, 0.045, 0.1125, 0.225];

/// The start of a Poiseuille flow.
struct Poiseuille {
    /// Particles across the channel.
    resolution: u32,
}

fn exact(y: f64, time: f64) -> f64 {
    let transient = (0..60).map(|k| {
        let n = f64::from(2 * k + 1);
        let decay = (-n * n * PI * PI * VISCOSITY * time / (WIDTH * WIDTH)).exp();
        (n * PI * y / WIDTH).sin() * decay / n.powi(3)
    });
    let steady = FORCE / (2.0 * VISCOSITY) * y * (WIDTH - y);
    steady - 4.0 * FORCE * WIDTH * WIDTH / (VISCOSITY * PI.powi(3)) * transient.sum::<f64>()
}

/// The greatest |v − exact| over the greatest exact v.
fn profile_error(now: &Snapshot<2>) -> f64 {
    let greatest = exact(WIDTH / 2.0, now.time);
    if now.time == 0.0 {
        return 0.0;
    }
    let errors = now.positions.iter().zip(&now.velocities).map(|(x, v)| (v[0] - exact(x[1], now.time)).abs());
    errors.fold(0.0, f64::max) / greatest
}

impl Case<2> for Poiseuille {
    fn setup(&self) -> Setup<2> {
        let (n, reach) = (i64::from(self.resolution), 3.0);
        let spacing = WIDTH / f64::from(self.resolution);
        let along = (n / 2).max(8);
        let positions: Vec<_> = cells([0; 2], [along, n]).iter().map(|cell| centre(cell, spacing)).collect();
        let margin = 3.0 * spacing;
        Setup {
            spacing,
            reach,
            state_equation: StateEquation::Linear,
            rest_density: 1000.0,
            sound_speed: 10.0 * FORCE * WIDTH * WIDTH / (8.0 * VISCOSITY),
            gravity: [FORCE, 0.0],
            gravity_at: |_| [FORCE, 0.0],
            artificial_viscosity: 0.0,
            kinematic_viscosity: VISCOSITY,
            density_diffusion: 0.1,
            shift_speed: FORCE * WIDTH * WIDTH / (8.0 * VISCOSITY),
            velocities: vec![[0.0; 2]; positions.len()],
            pressures: vec![0.0; positions.len()],
            positions,
            walls: walls([along, n], reach as i64, [(false, false), (true, true)], spacing),
            lower: [0.0, -margin],
            upper: [along as f64 * spacing, WIDTH + margin],
            periodic: [true, false],
        }
    }

    fn inside(&self) -> [(f64, f64); 2] {
        [(f64::NEG_INFINITY, f64::INFINITY), (0.0, WIDTH)]
    }

    fn measure(&self, now: &Snapshot<2>) -> Vec<f64> {
        vec![profile_error(now)]
    }

    fn checks(&self, results: &Results<2>) -> Vec<Check> {
        let at = |time: f64| {
            let error = results.series.at("profile_error", time);
            Check::at_most(format!("velocity profile at {time} s, worst / greatest"), error, 0.02)
        };
        TIMES.map(at).to_vec()
    }

    fn plots(&self, results: &Results<2>) -> Vec<Vec<Plot>> {
        let last = results.last;
        let mut curves = Vec::new();
        for time in TIMES.into_iter().chain([last.time]) {
            let points = (0..=50).map(|k| f64::from(k) / 50.0).map(|y| [exact(y * WIDTH, time) * 1e6, y]);
            let name = format!("exact, {time:.4} s");
            curves.push(Curve { name, points: points.collect(), mark: Mark::Line });
        }
        curves.dedup_by(|a, b| a.name == b.name);
        let ours = last.positions.iter().zip(&last.velocities).map(|(x, v)| [v[0] * 1e6, x[1] / WIDTH]);
        let name = format!("fluisim, {:.4} s", last.time);
        curves.push(Curve { name, points: ours.collect(), mark: Mark::Points });
        let profile = Plot {
            title: "Velocity of every particle at the end".into(),
            x_title: "v / (µm/s)".into(),
            y_title: "y / L".into(),
            series: curves,
            ..Plot::default()
        };
        let error = Plot {
            title: "Worst error of the profile over its greatest velocity".into(),
            x_title: "t / s".into(),
            y_title: "error".into(),
            series: vec![Curve {
                name: "error".into(),
                points: results.series.column("profile_error"),
                mark: Mark::Line,
            }],
            ..Plot::default()
        };
        vec![vec![profile, error]]
    }

    fn view(&self) -> View {
        let along = (f64::from(self.resolution) / 2.0).max(8.0) / f64::from(self.resolution);
        View {
            radius: 0.5 * WIDTH / f64::from(self.resolution),
            lower: [0.0; 2],
            upper: [along * WIDTH, WIDTH],
            speed: FORCE * WIDTH * WIDTH / (8.0 * VISCOSITY),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::CaseName;
    use crate::run::tests::{assert_within, values};
    use crate::scalar_choice::ScalarName;

    #[test]
    fn the_flow_starts_as_the_series_says() {
        let found = values(CaseName::Poiseuille, 16, ScalarName::F64, Some(0.225));
        assert_within(&found, &[[1e-4, 0.04]; 4]);
    }

    #[test]
    fn the_series_starts_at_rest_and_ends_as_a_parabola() {
        let greatest = FORCE * WIDTH * WIDTH / (8.0 * VISCOSITY);
        for part in [0.1, 0.3, 0.5] {
            assert!(exact(part * WIDTH, 0.0).abs() < 1e-4 * greatest);
            let parabola = 4.0 * part * (1.0 - part) * greatest;
            assert!((exact(part * WIDTH, 3.0) / parabola - 1.0).abs() < 1e-9);
        }
        // ν v″ + F = ∂v/∂t
        let (y, t, dy, dt) = (0.3 * WIDTH, 0.05, 1e-3 * WIDTH, 1e-5);
        let curvature = (exact(y + dy, t) - 2.0 * exact(y, t) + exact(y - dy, t)) / (dy * dy);
        let rate = (exact(y, t + dt) - exact(y, t - dt)) / (2.0 * dt);
        assert!((VISCOSITY * curvature + FORCE - rate).abs() < 1e-4 * FORCE);
    }
}
