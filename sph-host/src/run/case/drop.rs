//! A round drop stretched by v = (−A x, A y) stays an ellipse with semi-axes a and b.
//!
//! ```text
//! da/dt = −A a,  db/dt = A b,  dA/dt = A² (a² − b²)/(a² + b²),  p = ρ A² a²b²/(a² + b²) (1 − x²/a² − y²/b²)
//! ```
//!
//! Source: J. J. Monaghan, *Simulating free surface flows with SPH*, J. Comput. Phys. 110 (1994) 399, sect. 5.1; R = 1 m,
//! A = 100 / s, c₀ = 1400 m/s as there.

use crate::engine::{Setup, Snapshot, StateEquation, cells, centre, jittered};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::run::check::Check;
use crate::run::definition::{Case, Definition, Form, Results};
use crate::run::drawing::View;
use crate::run::solver::Solver;

/// The case.
pub(super) static CASE: Definition = Definition {
    across: "the radius",
    duration: end,
    plot: "semi_axes.png",
    columns: &["semi_axis_x", "semi_axis_y"],
    solvers: &[Solver::Wcsph, Solver::Incompressible],
    in_2d: Some(Form {
        resolution: 40,
        solver: Solver::Wcsph,
        build: |resolution| Box::new(Drop { resolution }),
    }),
    in_3d: None,
};

/// R, m.
const RADIUS: f64 = 1.0;
/// A at the start, 1/s.
const RATE: f64 = 100.0;
const DENSITY: f64 = 1000.0;
/// b/a up to which the drop is followed.
const ASPECT: f64 = 4.0;

/// The elliptical drop.
struct Drop {
    /// Particles across the radius.
    resolution: u32,
}

impl Drop {
    fn spacing(&self) -> f64 {
        RADIUS / f64::from(self.resolution)
    }
}

/// (a, b, A) at a time, by Runge and Kutta's fourth-order method.
fn exact(time: f64) -> [f64; 3] {
    const STEPS: u32 = 2000;
    let slope =
        |[a, b, rate]: [f64; 3]| [-rate * a, rate * b, rate * rate * (a * a - b * b) / (a * a + b * b)];
    let along =
        |x: [f64; 3], k: [f64; 3], step: f64| -> [f64; 3] { std::array::from_fn(|i| x[i] + step * k[i]) };
    let step = time / f64::from(STEPS);
    (0..STEPS).fold([RADIUS, RADIUS, RATE], |x, _| {
        let k1 = slope(x);
        let k2 = slope(along(x, k1, step / 2.0));
        let k3 = slope(along(x, k2, step / 2.0));
        let k4 = slope(along(x, k3, step));
        std::array::from_fn(|i| x[i] + step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    })
}

/// The time at which b/a is [`ASPECT`].
fn end() -> f64 {
    let (mut early, mut late) = (0.0, 2.0 / RATE);
    for _ in 0..40 {
        let middle = 0.5 * (early + late);
        let [a, b, _] = exact(middle);
        if b / a < ASPECT { early = middle } else { late = middle }
    }
    late
}

/// The semi-axes of the uniform ellipse with the particles' second moments: 2 √⟨x²⟩.
fn semi_axes(positions: &[[f64; 2]]) -> [f64; 2] {
    let mean =
        |axis: usize| positions.iter().map(|x| x[axis] * x[axis]).sum::<f64>() / positions.len() as f64;
    [2.0 * mean(0).sqrt(), 2.0 * mean(1).sqrt()]
}

impl Case<2> for Drop {
    fn setup(&self) -> Setup<2> {
        let (spacing, n) = (self.spacing(), i64::from(self.resolution));
        let mut positions: Vec<_> = cells([-n; 2], [n; 2])
            .iter()
            .enumerate()
            .map(|(i, cell)| jittered(i, centre(cell, spacing), 0.2 * spacing))
            .collect();
        let square = |x: &[f64; 2]| (x[0] * x[0] + x[1] * x[1]) / (RADIUS * RADIUS);
        positions.retain(|x| square(x) < 1.0);
        let greatest = 0.5 * DENSITY * RATE * RATE * RADIUS * RADIUS;
        Setup {
            spacing,
            reach: 4.0,
            state_equation: StateEquation::Tait,
            rest_density: DENSITY,
            sound_speed: 1400.0,
            gravity: [0.0; 2],
            gravity_at: |_| [0.0; 2],
            artificial_viscosity: 0.0,
            kinematic_viscosity: 0.0,
            density_diffusion: 0.1,
            shift_speed: 0.0,
            velocities: positions.iter().map(|[x, y]| [-RATE * x, RATE * y]).collect(),
            pressures: positions.iter().map(|x| greatest * (1.0 - square(x))).collect(),
            positions,
            walls: Vec::new(),
            lower: [-1.2 * RADIUS, -2.4 * RADIUS],
            upper: [1.2 * RADIUS, 2.4 * RADIUS],
            periodic: [false; 2],
        }
    }

    fn measure(&self, now: &Snapshot<2>) -> Vec<f64> {
        semi_axes(&now.positions).to_vec()
    }

    fn checks(&self, results: &Results<2>) -> Vec<Check> {
        let end = end();
        let worst = |name: &str, axis: usize| {
            let column = results.series.column(name);
            let followed = column.into_iter().filter(|point| point[0] <= end * (1.0 + 1e-9));
            let worst = followed.map(|[t, found]| (found / exact(t)[axis] - 1.0).abs()).fold(0.0, f64::max);
            results.series.has_reached(end).then_some(worst)
        };
        let mut checks = vec![
            Check::at_most("semi-axis x against the exact one, worst", worst("semi_axis_x", 0), 0.01),
            Check::at_most("semi-axis y against the exact one, worst", worst("semi_axis_y", 1), 0.01),
            Check::at_most("growth of total energy", results.series.energy_growth(), 1e-3),
        ];
        checks.extend(results.conservation(true));
        checks
    }

    fn plots(&self, results: &Results<2>) -> Vec<Vec<Plot>> {
        let scaled = |[t, axis]: [f64; 2]| [RATE * t, axis / RADIUS];
        let ours = |name: &str, column: &str| Curve {
            name: name.into(),
            points: results.series.column(column).into_iter().map(scaled).collect(),
            mark: Mark::Points,
        };
        let times = results.series.column("semi_axis_x");
        let theirs = |name: &str, axis: usize| Curve {
            name: name.into(),
            points: times.iter().map(|&[t, _]| scaled([t, exact(t)[axis]])).collect(),
            mark: Mark::Line,
        };
        let plot = Plot {
            title: "Semi-axes of the drop".into(),
            x_title: "A t".into(),
            y_title: "semi-axis / R".into(),
            series: vec![
                theirs("a, exact", 0),
                theirs("b, exact", 1),
                ours("a, fluisim", "semi_axis_x"),
                ours("b, fluisim", "semi_axis_y"),
            ],
            ..Plot::default()
        };
        vec![vec![plot]]
    }

    fn view(&self) -> View {
        View {
            radius: 0.5 * self.spacing(),
            lower: [-1.2 * RADIUS, -2.2 * RADIUS],
            upper: [1.2 * RADIUS, 2.2 * RADIUS],
            speed: 1.2 * RATE * RADIUS,
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
    fn it_becomes_the_exact_ellipse() {
        for (scalar, rounding) in [(ScalarName::F64, 1e-13), (ScalarName::F32, 1e-5)] {
            let found = values(CaseName::Drop, 15, scalar, Some(end()));
            let conserved = [1e-20, rounding];
            assert_within(&found, &[[1e-5, 0.03], [1e-5, 0.02], [0.0, 1e-3], conserved, conserved]);
        }
    }

    #[test]
    fn the_axes_are_measured_when_the_drop_was_followed_to_its_end() {
        let found = values(CaseName::Drop, 8, ScalarName::F64, Some(0.5 * end()));
        assert!(found[0].is_nan() && found[1].is_nan() && found[3].is_finite(), "{found:?}");
    }

    #[test]
    fn the_exact_drop_keeps_its_area_and_its_energy() {
        let [a, b, rate] = exact(end());
        assert!((b / a / ASPECT - 1.0).abs() < 1e-9);
        assert!((a * b / (RADIUS * RADIUS) - 1.0).abs() < 1e-10);
        // kinetic energy: A² (a² + b²) stays
        assert!((rate * rate * (a * a + b * b) / (2.0 * RATE * RATE) - 1.0).abs() < 1e-9);
    }
}
