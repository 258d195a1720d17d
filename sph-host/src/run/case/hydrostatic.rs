//! Water at uniform density in a tank, gravity brought up over a second, settles until its pressure is ρ g (H − z).
//!
//! Set on at once, gravity makes the water ring up and down with 2 % of the pressure at the bed, and what damps that weakens with
//! resolution.

use crate::engine::{Setup, Snapshot, StateEquation, cells, centre};
use crate::fast::{NeighbourLists, SortedCells};
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
    columns: &["pressure_error", "smoothed_pressure_error", "lowest_row_error"],
    solvers: &[Solver::Wcsph, Solver::Incompressible],
    in_2d: Some(Form {
        resolution: 40,
        solver: Solver::Wcsph,
        build: |resolution| Box::new(Hydrostatic { resolution }),
    }),
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

    /// p/(ρ g H) − (1 − z/H) of every particle.
    fn errors(positions: &[[f64; 2]], pressures: &[f64]) -> Vec<f64> {
        let error = |(x, p): (&[f64; 2], &f64)| p / (DENSITY * GRAVITY * DEPTH) - (1.0 - x[1] / DEPTH);
        positions.iter().zip(pressures).map(error).collect()
    }

    /// The same over the particles within two spacings of each, weighted by (1 − (r/2dx)²)³.
    fn smoothed(&self, positions: &[[f64; 2]], errors: &[f64]) -> Vec<f64> {
        let reach = 2.0 * self.spacing();
        let Ok(cells) = SortedCells::sort(positions, reach) else { return errors.to_vec() };
        let mut lists = NeighbourLists::new();
        cells.neighbour_lists(&mut lists);
        let order = cells.order();
        let mut smoothed = errors.to_vec();
        for (place, &i) in order.iter().enumerate() {
            let [x, y] = positions[i as usize];
            let mut sums = [0.0; 2];
            for &other in lists.of(place) {
                let j = order[other as usize] as usize;
                let square = (x - positions[j][0]).powi(2) + (y - positions[j][1]).powi(2);
                let weight = (1.0 - square / (reach * reach)).max(0.0).powi(3);
                sums[0] += weight * errors[j];
                sums[1] += weight;
            }
            smoothed[i as usize] = sums[0] / sums[1];
        }
        smoothed
    }

    /// Of p − ρ g (H − z) in parts of ρ g H: root mean square over all particles, the same smoothed, mean of the lowest row.
    fn pressure_errors(&self, now: &Snapshot<2>) -> [f64; 3] {
        let errors = Self::errors(&now.positions, &now.pressures);
        let square = |errors: &[f64]| errors.iter().map(|error| error * error).sum::<f64>();
        let size = |errors: &[f64]| (square(errors) / errors.len() as f64).sqrt();
        let is_low = |x: &[f64; 2]| x[1] < self.spacing();
        let lowest: Vec<f64> =
            now.positions.iter().zip(&errors).filter(|(x, _)| is_low(x)).map(|(_, &error)| error).collect();
        let mean = lowest.iter().sum::<f64>() / lowest.len().max(1) as f64;
        [size(&errors), size(&self.smoothed(&now.positions, &errors)), mean]
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
        self.pressure_errors(now).to_vec()
    }

    fn checks(&self, results: &Results<2>) -> Vec<Check> {
        let mass = DENSITY * DEPTH * DEPTH;
        let kinetic = results.last_from("kinetic_energy", AT_REST);
        let kinetic = kinetic.map(|energy| energy / (mass * GRAVITY * DEPTH));
        let error = |column| results.last_from(column, AT_REST);
        let mut checks = match results.solver {
            // pressures of neighbours alternate about their mean
            Solver::Incompressible => vec![
                Check::at_most(
                    "pressure, smoothed, against ρ g (H − z), RMS / ρ g H",
                    error("smoothed_pressure_error"),
                    0.05,
                ),
                Check::at_most("pressure of the lowest row, error / ρ g H", error("lowest_row_error"), 0.1),
            ],
            _ => {
                vec![Check::at_most("pressure against ρ g (H − z), RMS / ρ g H", error("pressure_error"), 0.02)]
            }
        };
        checks.extend([
            Check::at_most("kinetic energy / m g H at the end", kinetic, 1e-4),
            Check::at_most("growth of total energy", results.series.energy_growth(), 1e-3),
        ]);
        if results.solver == Solver::Incompressible {
            // twice the mean height: of a uniform block, its depth
            let height = 2.0 * results.last.positions.iter().map(|x| x[1]).sum::<f64>()
                / (results.last.positions.len() as f64 * DEPTH);
            let change = results.series.has_reached(AT_REST).then_some(height - 1.0);
            checks.push(Check::at_most("volume at rest, change", change, 0.01));
        }
        checks
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
    use super::*;
    use crate::run::tests::{assert_within, values};
    use crate::run::{CaseName, Options, simulate};
    use crate::scalar_choice::ScalarName;

    #[test]
    fn water_at_rest_stays_at_rest() {
        let found = values(CaseName::Hydrostatic, 12, ScalarName::F64, None);
        assert_within(&found, &[[1e-4, 0.02], [1e-12, 1e-4], [0.0, 1e-3], [0.0, 0.0]]);
    }

    #[test]
    fn incompressible_water_at_rest_stays_at_rest() {
        let options = Options {
            solver: Some(Solver::Incompressible),
            resolution: Some(12),
            every: Some(0.4),
            ..Options::new(CaseName::Hydrostatic)
        };
        let (summary, _) = simulate(&options, &()).unwrap();
        let found: Vec<f64> = summary.checks.iter().map(|check| check.value.unwrap_or(f64::NAN)).collect();
        let [smoothed, lowest, kinetic, growth] = [[0.0, 0.05], [-0.1, 0.1], [1e-12, 1e-4], [0.0, 4e-3]];
        assert_within(&found, &[smoothed, lowest, kinetic, growth, [-0.01, 0.01], [0.0, 2e-3], [0.0, 0.1], [0.0, 0.0]]);
    }

    #[test]
    fn smoothing_takes_what_alternates_and_leaves_what_is_even() {
        let tank = Hydrostatic { resolution: 12 };
        let positions = tank.setup().positions;
        let alternating: Vec<f64> = (0..positions.len()).map(|k| [-1.0, 1.0][(k / 12 + k % 12) % 2]).collect();
        let smoothed = tank.smoothed(&positions, &alternating);
        assert!(smoothed[5 * 12 + 5].abs() < 0.1, "{}", smoothed[5 * 12 + 5]);
        let even = tank.smoothed(&positions, &vec![0.3; positions.len()]);
        assert!(even.iter().all(|error| (error - 0.3).abs() < 1e-12));
    }

    #[test]
    fn nothing_is_measured_before_the_water_is_at_rest() {
        let found = values(CaseName::Hydrostatic, 8, ScalarName::F64, Some(0.05));
        assert!(found[0].is_nan() && found[1].is_nan() && found[2].is_finite(), "{found:?}");
    }
}
