//! A column of water, a wide and 2a high, collapses on a dry bed in a tank 4a wide.
//!
//! The pressure to begin with is that of an incompressible column at the moment the gate is gone, the solution of ∇²p = 0 with
//! p = 0 at the free sides: p/(ρ g) = H − z − 8H/π² Σ_{n odd} cosh(nπx/2H)/cosh(nπa/2H) cos(nπz/2H)/n². Walls are smooth.

use std::f64::consts::PI;

use serde_json::{Map, Value, json};

use super::{Case, View};
use crate::engine::{Setup, Snapshot, StateEquation, cells, centre, walls};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::run::reference;
use crate::run::series::{Check, Series};

/// The file of the plot.
pub(super) const PLOT: &str = "front.png";
/// a of Koshizuka and Oka's experiment.
const WIDTH: f64 = 0.146;
const GRAVITY: f64 = 9.81;
/// The tank's height over a; it has a roof.
const WALL_HEIGHT: i64 = 4;

/// The dam break, in two dimensions or in three, where the tank is a deep.
pub(in crate::run) struct DamBreak {
    /// Particles across a.
    pub(in crate::run) resolution: u32,
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
    fn deviation(series: &Series, name: &str) -> f64 {
        let points = reference::front(name).into_iter().filter(|&[t, z]| t > 0.0 && z <= 4.0);
        let squares: Option<Vec<f64>> = points
            .map(|[t, z]| {
                let front = series.at("front_x", t / Self::scaled(1.0))?;
                Some((front / WIDTH / z - 1.0).powi(2))
            })
            .collect();
        squares.map_or(f64::NAN, |squares| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
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

/// Pressure over ρ g in the column, from the left wall and the bed.
fn first_pressure(x: f64, z: f64) -> f64 {
    let height = 2.0 * WIDTH;
    let terms = (0..60).map(|k| {
        let n = f64::from(2 * k + 1);
        let rate = n * PI / (2.0 * height);
        // cosh(rate x) / cosh(rate a), without overflow
        let across =
            ((rate * (x - WIDTH)).exp() + (-rate * (x + WIDTH)).exp()) / (1.0 + (-2.0 * rate * WIDTH).exp());
        across * (rate * z).cos() / (n * n)
    });
    (height - z - 8.0 * height / (PI * PI) * terms.sum::<f64>()).max(0.0)
}

impl<const D: usize> Case<D> for DamBreak {
    fn setup(&self) -> Setup<D> {
        let (spacing, reach) = (self.spacing(), 2.6);
        let positions: Vec<[f64; D]> =
            cells([0; D], self.counts(1, 2)).iter().map(|cell| centre(cell, spacing)).collect();
        let density = 1000.0;
        let tank = self.counts(4, WALL_HEIGHT);
        let margin = 3.0 * spacing;
        Setup {
            spacing,
            reach,
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
            pressures: positions.iter().map(|x| density * GRAVITY * first_pressure(x[0], x[D - 1])).collect(),
            positions,
            walls: walls(tank, reach.ceil() as i64, [(true, true); D], spacing),
            lower: [-margin; D],
            upper: tank.map(|count| count as f64 * spacing + margin),
            periodic: [false; D],
        }
    }

    fn duration(&self) -> f64 {
        0.6
    }

    fn inside(&self) -> [(f64, f64); D] {
        let tank: [i64; D] = self.counts(4, WALL_HEIGHT);
        tank.map(|count| (0.0, count as f64 * self.spacing()))
    }

    fn columns(&self) -> &'static [&'static str] {
        &["front_x"]
    }

    fn measure(&self, now: &Snapshot<D>) -> Vec<f64> {
        let front = now.positions.iter().map(|x| x[0]).fold(0.0, f64::max);
        vec![front + 0.5 * self.spacing()]
    }

    fn checks(&self, series: &Series, _: &Snapshot<D>) -> Vec<Check> {
        let rms = |name| Self::deviation(series, name);
        vec![
            Check::at_most(
                "front against Koshizuka & Oka's computation, RMS",
                rms("koshizuka_oka_mps"),
                0.04,
            ),
            Check::at_most("front against Koshizuka & Oka's experiment, RMS", rms("koshizuka_oka"), 0.12),
            Check::at_most("growth of total energy", series.energy_growth(), 1e-3),
        ]
    }

    fn particulars(&self) -> Map<String, Value> {
        let pairs = [("column_width", json!(WIDTH)), ("gravity", json!(GRAVITY))];
        pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    fn plots(&self, series: &Series, _: &Snapshot<D>) -> (&'static str, Vec<Vec<Plot>>) {
        let ours = series.column("front_x").into_iter().map(|[t, x]| [Self::scaled(t), x / WIDTH]);
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
            title: "Without gate and wall friction, computations lead the experiments by a tenth".into(),
            x_title: "t √(2g/a)".into(),
            y_title: "front / a".into(),
            series: curves,
            x_range: Some([0.0, 4.0]),
            y_range: Some([1.0, 4.2]),
        };
        (PLOT, vec![vec![plot]])
    }

    fn view(&self) -> View {
        let speed = 2.0 * (GRAVITY * 2.0 * WIDTH).sqrt();
        View { radius: 0.5 * self.spacing(), lower: [0.0; 2], upper: [4.0 * WIDTH, 2.4 * WIDTH], speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_pressure_is_that_of_an_incompressible_column() {
        let height = 2.0 * WIDTH;
        for part in [0.1, 0.4, 0.8] {
            assert!(first_pressure(WIDTH, part * height) < 2e-3 * height, "free side");
            assert!(first_pressure(part * WIDTH, height) < 1e-9, "free surface");
        }
        let (x, z, step) = (0.4 * WIDTH, 0.3 * height, 1e-3 * height);
        let p = first_pressure;
        let laplacian = p(x + step, z) + p(x - step, z) + p(x, z + step) + p(x, z - step) - 4.0 * p(x, z);
        assert!(laplacian.abs() < 1e-4 * p(x, z) * step / height, "{laplacian}");
        assert!((p(step, z) - p(0.0, z)).abs() < 1e-3 * p(0.0, z), "left wall");
        let slope = (p(x, step) - p(x, 0.0)) / step;
        assert!((slope + 1.0).abs() < 2e-2, "the bed carries the weight: {slope}");
    }
}
