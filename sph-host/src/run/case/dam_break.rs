//! A column of water, a wide and 2a high, collapses on a dry bed in a tank 4a wide.
//!
//! The pressure to begin with is that of an incompressible column at the moment the gate is gone, the solution of ∇²p = 0 with
//! p = 0 at the free sides: p/(ρ g) = H − z − 8H/π² Σ_{n odd} cosh(nπx/2H)/cosh(nπa/2H) cos(nπz/2H)/n². Walls are smooth.

use std::f64::consts::PI;

use serde_json::{Map, Value, json};

use crate::engine::{Setup, Snapshot, StateEquation, cells, centre};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::run::check::Check;
use crate::run::definition::{Case, Definition, Form, Results};
use crate::run::drawing::View;
use crate::run::reference;
use crate::run::series::Series;
use crate::run::solver::Solver;
use crate::run::tank::Tank;

/// The case.
pub(super) static CASE: Definition = Definition {
    across: "the column",
    duration: || 0.6,
    plot: "front.png",
    columns: &["front_x"],
    solvers: &[Solver::Wcsph, Solver::Incompressible, Solver::Pbf],
    in_2d: Some(Form {
        resolution: 40,
        solver: Solver::Incompressible,
        build: |resolution| Box::new(DamBreak { resolution }),
    }),
    in_3d: Some(Form {
        resolution: 20,
        solver: Solver::Wcsph,
        build: |resolution| Box::new(DamBreak { resolution }),
    }),
};

/// a of Koshizuka and Oka's experiment.
const WIDTH: f64 = 0.146;
const GRAVITY: f64 = 9.81;
/// The tank's height over a; it has a roof.
const WALL_HEIGHT: i64 = 4;

/// The dam break, in two dimensions or in three, where the tank is a deep.
struct DamBreak {
    /// Particles across a.
    resolution: u32,
}

impl DamBreak {
    fn spacing(&self) -> f64 {
        WIDTH / f64::from(self.resolution)
    }

    /// T = t √(2g/a)
    fn scaled(time: f64) -> f64 {
        time * (2.0 * GRAVITY / WIDTH).sqrt()
    }

    /// Root mean square of Z/Z_reference − 1 over a reference's points with Z ≤ 4 that the run has reached.
    fn deviation(series: &Series, name: &str) -> Option<f64> {
        let front_at = |scaled: f64| series.at("front_x", scaled / Self::scaled(1.0));
        reference::deviation(&reference::front(name), |t| Some(front_at(t)? / WIDTH))
    }

    fn tank<const D: usize>(&self) -> Tank<D> {
        let counts = self.counts(4, WALL_HEIGHT);
        Tank::closed(counts, counts.map(|count| count as f64 * self.spacing()), self.spacing())
    }

    fn counts<const D: usize>(&self, across: i64, up: i64) -> [i64; D] {
        let n = i64::from(self.resolution);
        std::array::from_fn(|axis| match axis {
            0 => across * n,
            axis if axis + 1 == D => up * n,
            _ => n,
        })
    }
}

/// Gravity, along the last axis.
fn down<const D: usize>(_: f64) -> [f64; D] {
    std::array::from_fn(|axis| if axis + 1 == D { -GRAVITY } else { 0.0 })
}

/// Pressure over ρ g in a column of a width and a height, from the left wall and the bed.
pub(super) fn first_pressure([width, height]: [f64; 2], x: f64, z: f64) -> f64 {
    let terms = (0..60).map(|k| {
        let n = f64::from(2 * k + 1);
        let rate = n * PI / (2.0 * height);
        // cosh(rate x) / cosh(rate a), without overflow
        let across =
            ((rate * (x - width)).exp() + (-rate * (x + width)).exp()) / (1.0 + (-2.0 * rate * width).exp());
        across * (rate * z).cos() / (n * n)
    });
    (height - z - 8.0 * height / (PI * PI) * terms.sum::<f64>()).max(0.0)
}

impl<const D: usize> Case<D> for DamBreak {
    fn setup(&self) -> Setup<D> {
        let (spacing, tank) = (self.spacing(), self.tank());
        let positions: Vec<[f64; D]> =
            cells([0; D], self.counts(1, 2)).iter().map(|cell| centre(cell, spacing)).collect();
        let density = 1000.0;
        Setup {
            spacing,
            reach: 2.6,
            state_equation: StateEquation::Tait,
            rest_density: density,
            sound_speed: 10.0 * (2.0 * GRAVITY * 2.0 * WIDTH).sqrt(),
            gravity: down(0.0),
            gravity_at: down,
            artificial_viscosity: 0.03,
            kinematic_viscosity: 0.0,
            density_diffusion: 0.1,
            shift_speed: 0.0,
            velocities: vec![[0.0; D]; positions.len()],
            pressures: positions.iter().map(|x| density * GRAVITY * first_pressure([WIDTH, 2.0 * WIDTH], x[0], x[D - 1])).collect(),
            positions,
            walls: tank.walls(),
            lower: tank.lower(),
            upper: tank.upper(),
            periodic: [false; D],
        }
    }

    fn inside(&self) -> [(f64, f64); D] {
        self.tank().inside()
    }

    fn measure(&self, now: &Snapshot<D>) -> Vec<f64> {
        let front = now.positions.iter().map(|x| x[0]).fold(0.0, f64::max);
        vec![front + 0.5 * self.spacing()]
    }

    fn checks(&self, results: &Results<D>) -> Vec<Check> {
        let rms = |name| Self::deviation(results.series, name);
        let computed = "front against Koshizuka & Oka's computation, RMS";
        let measured = "front against Koshizuka & Oka's experiment, RMS";
        vec![
            Check::at_most(computed, rms("koshizuka_oka_mps"), 0.04),
            Check::at_most(measured, rms("koshizuka_oka"), reference::computation_against_experiment()),
            Check::at_most("growth of total energy", results.series.energy_growth(), 1e-3),
        ]
    }

    fn particulars(&self) -> Map<String, Value> {
        let pairs = [("column_width", json!(WIDTH)), ("gravity", json!(GRAVITY))];
        pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    fn plots(&self, results: &Results<D>) -> Vec<Vec<Plot>> {
        let ours = results.series.column("front_x").into_iter().map(|[t, x]| [Self::scaled(t), x / WIDTH]);
        let mut curves = vec![Curve { name: "fluisim".into(), points: ours.collect(), mark: Mark::Line }];
        for (name, title) in [
            ("koshizuka_oka_mps", "Koshizuka & Oka, computed"),
            ("koshizuka_oka", "Koshizuka & Oka, measured"),
            ("martin_moyce_1.125in", "Martin & Moyce, 1.125 in"),
            ("martin_moyce_2.25in", "Martin & Moyce, 2.25 in"),
        ] {
            curves.push(Curve { name: title.into(), points: reference::front(name), mark: Mark::Points });
        }
        let plot = Plot {
            title: format!(
                "Without gate and wall friction both computations lead: Koshizuka & Oka's by {:.1} % RMS",
                1e2 * reference::computation_against_experiment()
            ),
            x_title: "t √(2g/a)".into(),
            y_title: "front / a".into(),
            series: curves,
            x_range: Some([0.0, 4.0]),
            y_range: Some([1.0, 4.2]),
            ..Plot::default()
        };
        vec![vec![plot]]
    }

    fn view(&self) -> View {
        let speed = 2.0 * (GRAVITY * 2.0 * WIDTH).sqrt();
        View { radius: 0.5 * self.spacing(), lower: [0.0; 2], upper: [4.0 * WIDTH, 2.4 * WIDTH], speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{CaseName, Options, simulate};
    use crate::run::tests::{assert_within, values};
    use crate::scalar_choice::ScalarName;

    #[test]
    fn it_breaks_as_computed_by_others() {
        let found = values(CaseName::DamBreak, 12, ScalarName::F64, Some(0.28));
        let compression = [[0.0, 1e-3], [0.0, 0.1]];
        assert_within(&found[..3], &[[0.005, 0.06], [0.06, 0.138], [0.0, 1e-3]]);
        assert_within(&found[3..], &[compression[0], compression[1], [0.0, 0.0]]);
    }

    #[test]
    fn a_weakly_compressible_column_breaks_alike() {
        let options = Options {
            solver: Some(Solver::Wcsph),
            resolution: Some(12),
            time: Some(0.28),
            ..Options::new(CaseName::DamBreak)
        };
        let (summary, _) = simulate(&options, &()).unwrap();
        let found: Vec<f64> = summary.checks.iter().map(|check| check.value.unwrap_or(f64::NAN)).collect();
        assert_within(&found, &[[0.005, 0.06], [0.06, 0.138], [0.0, 1e-2], [0.0, 0.0]]);
    }

    #[test]
    fn it_breaks_in_three_dimensions() {
        for solver in [Solver::Wcsph, Solver::Incompressible] {
            let options = Options {
                solver: Some(solver),
                dim: Some(3),
                resolution: Some(8),
                scalar: Some(ScalarName::F32),
                time: Some(0.02),
                every: Some(0.002),
                ..Options::new(CaseName::DamBreak)
            };
            let (summary, _) = simulate(&options, &()).unwrap();
            let values: Vec<Option<f64>> = summary.checks.iter().map(|check| check.value).collect();
            assert_eq!((values[0], values[1]), (None, None), "the front has not come so far");
            assert_eq!(values.last(), Some(&Some(0.0)), "none escapes");
            assert!(values[2].is_some_and(|growth| (0.0..1e-2).contains(&growth)), "{values:?}");
        }
    }

    #[test]
    fn the_first_pressure_is_that_of_an_incompressible_column() {
        let height = 2.0 * WIDTH;
        let p = |x, z| first_pressure([WIDTH, height], x, z);
        for part in [0.1, 0.4, 0.8] {
            assert!(p(WIDTH, part * height) < 2e-3 * height, "free side");
            assert!(p(part * WIDTH, height) < 1e-9, "free surface");
        }
        let (x, z, step) = (0.4 * WIDTH, 0.3 * height, 1e-3 * height);
        let laplacian = p(x + step, z) + p(x - step, z) + p(x, z + step) + p(x, z - step) - 4.0 * p(x, z);
        assert!(laplacian.abs() < 1e-4 * p(x, z) * step / height, "{laplacian}");
        assert!((p(step, z) - p(0.0, z)).abs() < 1e-3 * p(0.0, z), "left wall");
        let slope = (p(x, step) - p(x, 0.0)) / step;
        assert!((slope + 1.0).abs() < 2e-2, "the bed carries the weight: {slope}");
    }
}
