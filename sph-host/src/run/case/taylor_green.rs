//! Decaying vortices, periodic on both axes: u = −U cos(2πx/L) sin(2πy/L), v = U sin(2πx/L) cos(2πy/L), Re = U L/ν = 100.
//!
//! Kinetic energy falls as exp(−16π² t/Re) with L = U = 1.

use std::f64::consts::PI;

use sph_core::vector::{norm_squared, scale, sub};

use crate::engine::{Setup, Snapshot, StateEquation, cells, centre, jittered};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::run::check::Check;
use crate::run::definition::{Case, Definition, Form, Results};
use crate::run::drawing::View;
use crate::run::solver::Solver;

/// The case.
pub(super) static CASE: Definition = Definition {
    across: "the period",
    duration: || 1.0,
    plot: "decay.png",
    columns: &["decay_error", "velocity_error"],
    solvers: &[Solver::Wcsph],
    in_2d: Some(Form {
        resolution: 50,
        solver: Solver::Wcsph,
        build: |resolution| Box::new(TaylorGreen { resolution }),
    }),
    in_3d: None,
};

const REYNOLDS: f64 = 100.0;

/// The Taylor-Green vortices.
struct TaylorGreen {
    /// Particles over the period.
    resolution: u32,
}

/// Kinetic energy over that at the start.
fn exact(time: f64) -> f64 {
    (-16.0 * PI * PI * time / REYNOLDS).exp()
}

/// The velocity at the start.
fn vortices([x, y]: &[f64; 2]) -> [f64; 2] {
    let k = 2.0 * PI;
    [-(k * x).cos() * (k * y).sin(), (k * x).sin() * (k * y).cos()]
}

impl Case<2> for TaylorGreen {
    fn setup(&self) -> Setup<2> {
        let n = i64::from(self.resolution);
        let spacing = 1.0 / f64::from(self.resolution);
        let positions: Vec<_> = cells([0; 2], [n; 2])
            .iter()
            .enumerate()
            .map(|(i, cell)| jittered(i, centre(cell, spacing), 0.2 * spacing))
            .collect();
        let k = 2.0 * PI;
        Setup {
            spacing,
            reach: 4.0,
            state_equation: StateEquation::Linear,
            rest_density: 1.0,
            sound_speed: 10.0,
            gravity: [0.0; 2],
            gravity_at: |_| [0.0; 2],
            artificial_viscosity: 0.0,
            kinematic_viscosity: 1.0 / REYNOLDS,
            density_diffusion: 0.1,
            shift_speed: 1.0,
            velocities: positions.iter().map(vortices).collect(),
            pressures: positions
                .iter()
                .map(|[x, y]| -0.25 * ((2.0 * k * x).cos() + (2.0 * k * y).cos()))
                .collect(),
            positions,
            walls: Vec::new(),
            lower: [0.0; 2],
            upper: [1.0; 2],
            periodic: [true; 2],
        }
    }

    fn measure(&self, now: &Snapshot<2>) -> Vec<f64> {
        let count = now.velocities.len() as f64;
        let squares: f64 = now.velocities.iter().map(norm_squared).sum();
        let decay = exact(now.time).sqrt();
        let error = |(x, v): (&[f64; 2], &[f64; 2])| norm_squared(&sub(v, &scale(&vortices(x), decay)));
        let errors: f64 = now.positions.iter().zip(&now.velocities).map(error).sum();
        // ⟨u² + v²⟩ is U²/2 at the start
        let energy = 0.5 * exact(now.time);
        vec![squares / count / energy - 1.0, (errors / count / energy).sqrt()]
    }

    fn checks(&self, results: &Results<2>) -> Vec<Check> {
        let error = results.series.at("decay_error", 1.0);
        let mut checks = vec![Check::at_most("kinetic energy at t = 1 against the exact one", error, 0.03)];
        checks.extend(results.conservation(false));
        checks
    }

    fn plots(&self, results: &Results<2>) -> Vec<Vec<Plot>> {
        let errors = results.series.column("decay_error");
        let log = |t: f64, factor: f64| [t, (factor * exact(t)).log10()];
        let ours = errors.iter().map(|&[t, error]| log(t, 1.0 + error)).collect();
        let theirs = errors.iter().map(|&[t, _]| log(t, 1.0)).collect();
        let plot = Plot {
            title: "Decay of the vortices at Re = 100".into(),
            x_title: "t U / L".into(),
            y_title: "log₁₀ of kinetic energy / that at the start".into(),
            series: vec![
                Curve { name: "exp(−16π² t/Re)".into(), points: theirs, mark: Mark::Line },
                Curve { name: "fluisim".into(), points: ours, mark: Mark::Points },
            ],
            ..Plot::default()
        };
        vec![vec![plot]]
    }

    fn view(&self) -> View {
        View { radius: 0.5 / f64::from(self.resolution), lower: [0.0; 2], upper: [1.0; 2], speed: 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use crate::run::CaseName;
    use crate::run::tests::{assert_within, values};
    use crate::scalar_choice::ScalarName;

    #[test]
    fn vortices_decay_as_they_must() {
        let found = values(CaseName::TaylorGreen, 20, ScalarName::F64, Some(1.0));
        assert_within(&found, &[[-0.1, 0.1], [0.0, 1e-12]]);
    }
}
