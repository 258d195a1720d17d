//! A column of water, 2H wide and H high, collapses in a tank 5.366 H long and hits its far wall, where a sensor is.
//!
//! The sensor's number is the mean over its height of p/(ρ g H) at the wall, zero where no water is near: of the particles about each of some
//! points Σ p W / Σ W with W = (1 − (r/R)²)³, where R is the support radius.

use serde_json::{Map, Value, json};

use super::dam_break::first_pressure;
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
    across: "the height",
    duration: || 5.8 / scaled(1.0),
    plot: "impact.png",
    columns: &["wall_pressure", "front_x"],
    solvers: &[Solver::Wcsph, Solver::Incompressible],
    in_2d: Some(Form {
        resolution: 40,
        solver: Solver::Incompressible,
        build: |resolution| Box::new(Impact { resolution }),
    }),
    in_3d: None,
};

/// H of Buchner's experiment.
const HEIGHT: f64 = 0.6;
/// The tank's length over H.
const LENGTH: f64 = 5.366;
/// The tank's height over H; it has a roof, which no water reaches.
const WALL_HEIGHT: i64 = 4;
/// Where the sensor begins and ends above the bed, m. It is taken half its width lower than it was, as Adami, Hu and Adams do (J. Comput. Phys. 231
/// (2012) 7057) after Greco: where the flow along the wall is thin, the gauge and its mount reach lower than its middle.
const SENSOR: [f64; 2] = [0.07, 0.16];
/// Points over the sensor's height.
const POINTS: u32 = 10;
const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;
/// Support radius / spacing.
const REACH: f64 = 2.6;
/// Pressures are means over so long, in T: a row of the series is one moment of a number that fluctuates.
const WINDOW: f64 = 0.2;
/// When water comes to the wall, in T.
const ARRIVAL: f64 = 2.4;
/// From when to when, in T, the pressure is about the same.
const PLATEAU: [f64; 2] = [3.2, 5.0];

/// T = t √(g/H)
fn scaled(time: f64) -> f64 {
    time * (GRAVITY / HEIGHT).sqrt()
}

/// The dam break and its wall.
struct Impact {
    /// Particles over H.
    resolution: u32,
}

impl Impact {
    fn spacing(&self) -> f64 {
        HEIGHT / f64::from(self.resolution)
    }

    fn tank(&self) -> Tank<2> {
        let n = f64::from(self.resolution);
        let counts = [(LENGTH * n).round() as i64, WALL_HEIGHT * i64::from(self.resolution)];
        Tank::closed(counts, counts.map(|count| count as f64 * self.spacing()), self.spacing())
    }

    /// p/(ρ g H) that the sensor shows.
    fn wall_pressure(&self, now: &Snapshot<2>) -> f64 {
        let (wall, reach) = (self.tank().size[0], REACH * self.spacing());
        let near: Vec<([f64; 2], f64)> = now
            .positions
            .iter()
            .zip(&now.pressures)
            .filter(|(x, _)| x[0] > wall - reach && x[1] < SENSOR[1] + reach)
            .map(|(&x, &pressure)| (x, pressure))
            .collect();
        let [lower, upper] = SENSOR;
        let at = |k: u32| lower + (upper - lower) * (f64::from(k) + 0.5) / f64::from(POINTS);
        let pressures = (0..POINTS).map(|k| mean_about([wall, at(k)], reach, &near));
        pressures.sum::<f64>() / f64::from(POINTS) / (DENSITY * GRAVITY * HEIGHT)
    }

    /// The mean pressure from half a [`WINDOW`] before a time T to half a window after it; `None` where the run does not come so far.
    fn mean_at(series: &Series, t: f64) -> Option<f64> {
        let [from, to] = [t - WINDOW / 2.0, t + WINDOW / 2.0];
        if !series.has_reached(to / scaled(1.0)) {
            return None;
        }
        let rows = series.column("wall_pressure").into_iter().map(|[time, p]| [scaled(time), p]);
        mean(rows.filter(|&[t, _]| (from..=to).contains(&t)).map(|row| row[1]).collect())
    }

    /// Root mean square of P − P_experiment from the time at which water comes to the wall.
    fn deviation(series: &Series) -> Option<f64> {
        let points = reference::impact().into_iter().filter(|point| point[0] > ARRIVAL);
        let square = |[t, p]: [f64; 2]| Some((Self::mean_at(series, t)? - p).powi(2));
        mean(points.map(square).collect::<Option<Vec<f64>>>()?).map(f64::sqrt)
    }

    /// The mean pressure of the plateau over the experiment's, less one.
    fn plateau(series: &Series) -> Option<f64> {
        let is_in = |t: f64| (PLATEAU[0]..=PLATEAU[1]).contains(&t);
        if !series.has_reached(PLATEAU[1] / scaled(1.0)) {
            return None;
        }
        let ours = series.column("wall_pressure").into_iter().filter(|&[t, _]| is_in(scaled(t)));
        let theirs = reference::impact().into_iter().filter(|&[t, _]| is_in(t));
        let [ours, theirs] = [ours.map(|point| point[1]).collect(), theirs.map(|point| point[1]).collect()].map(mean);
        Some(ours? / theirs? - 1.0)
    }
}

fn mean(values: Vec<f64>) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Σ p W / Σ W about a point; zero where there is nothing.
fn mean_about(point: [f64; 2], reach: f64, near: &[([f64; 2], f64)]) -> f64 {
    let mut sums = [0.0; 2];
    for (x, pressure) in near {
        let square = (x[0] - point[0]).powi(2) + (x[1] - point[1]).powi(2);
        let weight = (1.0 - square / (reach * reach)).max(0.0).powi(3);
        sums[0] += weight * pressure;
        sums[1] += weight;
    }
    if sums[1] > 0.0 { sums[0] / sums[1] } else { 0.0 }
}

impl Case<2> for Impact {
    fn setup(&self) -> Setup<2> {
        let (spacing, tank, n) = (self.spacing(), self.tank(), i64::from(self.resolution));
        let positions: Vec<_> = cells([0; 2], [2 * n, n]).iter().map(|cell| centre(cell, spacing)).collect();
        let pressure = |x: &[f64; 2]| DENSITY * GRAVITY * first_pressure([2.0 * HEIGHT, HEIGHT], x[0], x[1]);
        Setup {
            spacing,
            reach: REACH,
            state_equation: StateEquation::Tait,
            rest_density: DENSITY,
            sound_speed: 10.0 * (4.0 * GRAVITY * HEIGHT).sqrt(),
            gravity: [0.0, -GRAVITY],
            gravity_at: |_| [0.0, -GRAVITY],
            artificial_viscosity: 0.03,
            kinematic_viscosity: 0.0,
            density_diffusion: 0.1,
            shift_speed: 0.0,
            velocities: vec![[0.0; 2]; positions.len()],
            pressures: positions.iter().map(pressure).collect(),
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
        let front = now.positions.iter().map(|x| x[0]).fold(0.0, f64::max);
        vec![self.wall_pressure(now), front + 0.5 * self.spacing()]
    }

    fn checks(&self, results: &Results<2>) -> Vec<Check> {
        let series = results.series;
        vec![
            Check::at_most("wall pressure against Buchner's, RMS / ρ g H", Self::deviation(series), 0.15),
            Check::at_most("wall pressure against Buchner's, mean of the plateau", Self::plateau(series), 0.15),
            Check::at_most("growth of total energy", series.energy_growth(), 1e-3),
        ]
    }

    fn particulars(&self) -> Map<String, Value> {
        let pairs = [("column_height", json!(HEIGHT)), ("gravity", json!(GRAVITY))];
        pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    fn plots(&self, results: &Results<2>) -> Vec<Vec<Plot>> {
        let ours = results.series.column("wall_pressure").into_iter().map(|[t, p]| [scaled(t), p]);
        let curve = |name: &str, points, mark| Curve { name: name.into(), points, mark };
        let plot = Plot {
            title: "Pressure on the wall, mean over the sensor".into(),
            x_title: "t √(g/H)".into(),
            y_title: "p / (ρ g H)".into(),
            series: vec![
                curve("fluisim", ours.collect(), Mark::Line),
                curve("Buchner, measured", reference::impact(), Mark::Points),
            ],
            x_range: Some([2.0, 5.8]),
            ..Plot::default()
        };
        vec![vec![plot]]
    }

    fn view(&self) -> View {
        let speed = 2.0 * (GRAVITY * HEIGHT).sqrt();
        View { radius: 0.5 * self.spacing(), lower: [0.0; 2], upper: [LENGTH * HEIGHT, 2.5 * HEIGHT], speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::tests::assert_within;
    use crate::run::{CaseName, Options, simulate};

    /// Water at rest as deep as H against the wall.
    fn still(tank: &Impact) -> Snapshot<2> {
        let (spacing, wall) = (tank.spacing(), tank.tank().size[0]);
        let positions: Vec<[f64; 2]> = cells([0; 2], [6, i64::from(tank.resolution)])
            .iter()
            .map(|cell| centre(cell, spacing))
            .map(|[x, z]| [wall - x, z])
            .collect();
        let pressures = positions.iter().map(|x| DENSITY * GRAVITY * (HEIGHT - x[1])).collect();
        let count = positions.len();
        Snapshot {
            time: 0.0,
            positions,
            velocities: vec![[0.0; 2]; count],
            densities: vec![DENSITY; count],
            pressures,
        }
    }

    #[test]
    fn the_sensor_shows_the_weight_of_still_water_and_nothing_where_it_is_dry() {
        let tank = Impact { resolution: 80 };
        let expected = 1.0 - (SENSOR[0] + SENSOR[1]) / 2.0 / HEIGHT;
        let found = tank.wall_pressure(&still(&tank));
        assert!((found - expected).abs() < 1e-3, "{found} {expected}");
        let mut away = still(&tank);
        away.positions.iter_mut().for_each(|x| x[0] -= 0.1);
        assert_eq!(tank.wall_pressure(&away), 0.0);
    }

    #[test]
    fn the_wall_feels_what_was_measured() {
        let options = Options { resolution: Some(20), ..Options::new(CaseName::Impact) };
        let (summary, series) = simulate(&options, &()).unwrap();
        let found: Vec<f64> = summary.checks.iter().map(|check| check.value.unwrap_or(f64::NAN)).collect();
        assert_within(&found[..3], &[[0.05, 0.3], [-0.3, 0.3], [0.0, 1e-3]]);
        let before = series.column("wall_pressure").into_iter().filter(|&[t, _]| scaled(t) < 2.2);
        assert!(before.map(|row| row[1]).all(|p| p == 0.0), "nothing before the water arrives");
    }

    #[test]
    fn nothing_is_measured_before_the_plateau_has_ended() {
        let options = Options { resolution: Some(8), time: Some(0.05), ..Options::new(CaseName::Impact) };
        let (summary, _) = simulate(&options, &()).unwrap();
        assert_eq!((summary.checks[0].value, summary.checks[1].value), (None, None));
    }
}
