//! A box of fluid that is turned by a script: what a pendant does all day, with a lamp a support radius as its picture.
//!
//! The fluid feels what an accelerometer in the box reads: gravity, turned. Held long enough at an angle θ its surface is level
//! with the world, and the centre of mass of a layer H deep in a box L wide is off the middle by L² tan θ/(12 H) and
//! H/2 + L² tan² θ/(24 H) above the floor.

use crate::engine::{Setup, Snapshot, StateEquation, cells, centre};
use crate::picture::plot::{Mark, Plot, Series as Curve};
use crate::picture::{Image, PictureError};
use crate::run::check::Check;
use crate::run::definition::{Case, Definition, Form, Results};
use crate::run::drawing::{self, View};
use crate::run::solver::Solver;
use crate::run::tank::Tank;

/// The case.
pub(super) static CASE: Definition = Definition {
    across: "the box",
    duration: || SCRIPT[SCRIPT.len() - 1].0,
    plot: "tilt.png",
    columns: &["fluid_height", "centre_offset"],
    solvers: &[Solver::Pbf, Solver::Wcsph, Solver::Incompressible],
    in_2d: Some(Form {
        resolution: 32,
        solver: Solver::Pbf,
        build: |resolution| Box::new(Tilt { resolution }),
    }),
    in_3d: None,
};

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;
/// L; the box is as high.
const WIDTH: f64 = 0.1;
/// The angle at times between which it changes evenly, in seconds and degrees.
const SCRIPT: [(f64, f64); 8] =
    [(0.0, 0.0), (0.5, 0.0), (1.0, 20.0), (3.0, 20.0), (4.0, -20.0), (6.0, -20.0), (6.5, 0.0), (9.0, 0.0)];
/// The times at which it has been held at an angle for longest.
const HELD: [f64; 2] = [3.0, 6.0];

/// The box that is turned.
struct Tilt {
    /// Particles across the box.
    resolution: u32,
}

impl Tilt {
    fn spacing(&self) -> f64 {
        WIDTH / f64::from(self.resolution)
    }

    fn tank(&self) -> Tank<2> {
        Tank::closed([self.resolution.into(); 2], [WIDTH; 2], self.spacing())
    }

    /// H, a whole number of layers.
    fn depth(&self) -> f64 {
        self.layers() as f64 * self.spacing()
    }

    fn layers(&self) -> i64 {
        i64::from(self.resolution * 2 / 5)
    }

    /// The centre of mass of a level surface, off the middle.
    fn level_offset(&self, time: f64) -> f64 {
        WIDTH * WIDTH * angle(time).tan() / (12.0 * self.depth())
    }
}

/// θ in radians, positive when the right-hand side is low.
fn angle(time: f64) -> f64 {
    let after = SCRIPT.iter().position(|&(at, _)| at > time).unwrap_or(SCRIPT.len());
    let (Some(&(t0, a0)), next) = (SCRIPT.get(after.saturating_sub(1)), SCRIPT.get(after)) else {
        return 0.0;
    };
    let degrees = next.map_or(a0, |&(t1, a1)| a0 + (a1 - a0) * (time - t0) / (t1 - t0));
    degrees.to_radians()
}

fn gravity(time: f64) -> [f64; 2] {
    let (sine, cosine) = angle(time).sin_cos();
    [GRAVITY * sine, -GRAVITY * cosine]
}

fn mean(now: &Snapshot<2>, axis: usize) -> f64 {
    now.positions.iter().map(|x| x[axis]).sum::<f64>() / now.positions.len() as f64
}

impl Case<2> for Tilt {
    fn setup(&self) -> Setup<2> {
        let (spacing, tank, n) = (self.spacing(), self.tank(), i64::from(self.resolution));
        let positions: Vec<_> =
            cells([0; 2], [n, self.layers()]).iter().map(|cell| centre(cell, spacing)).collect();
        Setup {
            spacing,
            reach: 2.6,
            state_equation: StateEquation::Tait,
            rest_density: DENSITY,
            sound_speed: 10.0 * (2.0 * GRAVITY * WIDTH).sqrt(),
            gravity: gravity(0.0),
            gravity_at: gravity,
            artificial_viscosity: 0.1,
            kinematic_viscosity: 0.0,
            density_diffusion: 0.1,
            shift_speed: 0.0,
            velocities: vec![[0.0; 2]; positions.len()],
            pressures: positions.iter().map(|x| DENSITY * GRAVITY * (self.depth() - x[1])).collect(),
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
        vec![2.0 * mean(now, 1), mean(now, 0) - 0.5 * WIDTH]
    }

    fn checks(&self, results: &Results<2>) -> Vec<Check> {
        let at = |name, time| results.series.at(name, time);
        let end = SCRIPT[SCRIPT.len() - 1].0;
        let mass = DENSITY * WIDTH * self.depth();
        let speed = at("kinetic_energy", end)
            .map(|energy| (2.0 * energy / mass).sqrt() / (GRAVITY * self.depth()).sqrt());
        let height = at("fluid_height", end).map(|height| height / self.depth() - 1.0);
        let level = HELD.map(|time| {
            at("centre_offset", time).map(|offset| (offset / self.level_offset(time) - 1.0).abs())
        });
        vec![
            Check::at_most("fluid height at rest against the volume put in", height, 0.03),
            Check::at_most("speed at rest / √(g H), RMS", speed, 0.01),
            Check::at_most("centre of mass while held at +20° against a level surface", level[0], 0.1),
            Check::at_most("centre of mass while held at −20° against a level surface", level[1], 0.1),
        ]
    }

    fn plots(&self, results: &Results<2>) -> Vec<Vec<Plot>> {
        let over = |points: Vec<[f64; 2]>, unit: f64| points.into_iter().map(move |[t, v]| [t, v / unit]);
        let level = results.series.column("time").into_iter().map(|[t, _]| [t, self.level_offset(t) / WIDTH]);
        let curve = |name: &str, points, mark| Curve { name: name.into(), points, mark };
        let offset = Plot {
            title: "Centre of mass".into(),
            x_title: "t / s".into(),
            y_title: "off the middle / L".into(),
            series: vec![
                curve("level surface", level.collect(), Mark::Line),
                curve("fluisim", over(results.series.column("centre_offset"), WIDTH).collect(), Mark::Points),
            ],
            ..Plot::default()
        };
        let lift = |t: f64| self.level_offset(t) * angle(t).tan() / self.depth();
        let level_height = results.series.column("time").into_iter().map(|[t, _]| [t, 1.0 + lift(t)]);
        let height = Plot {
            title: "Height: twice the mean height of the particles".into(),
            x_title: "t / s".into(),
            y_title: "height / H".into(),
            series: vec![
                curve("level surface", level_height.collect(), Mark::Line),
                curve("fluisim", over(results.series.column("fluid_height"), self.depth()).collect(), Mark::Points),
            ],
            ..Plot::default()
        };
        vec![vec![offset, height]]
    }

    fn view(&self) -> View {
        View { radius: 0.5 * self.spacing(), lower: [0.0; 2], upper: [WIDTH; 2], speed: 0.5 }
    }

    fn picture(&self, now: &Snapshot<2>, title: &str) -> Result<Image, PictureError> {
        let title = format!("{title}, turned by {:.0}°", angle(now.time).to_degrees());
        drawing::lamps(now, &self.view(), 2.0 * self.spacing(), &title)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_script_is_followed_and_gravity_keeps_its_size() {
        for (time, degrees) in [(0.2, 0.0), (0.75, 10.0), (2.0, 20.0), (3.5, 0.0), (5.0, -20.0), (99.0, 0.0)]
        {
            assert!((angle(time).to_degrees() - degrees).abs() < 1e-9, "{time}");
            let [x, y] = gravity(time);
            assert!((x.hypot(y) - GRAVITY).abs() < 1e-12 && y < 0.0);
        }
        assert!(gravity(2.0)[0] > 0.0, "to the right, the low side");
    }

    #[test]
    fn the_level_offset_is_that_of_a_trapezium() {
        let tilt = Tilt { resolution: 40 };
        let (n, slope) = (10_000, angle(2.0).tan());
        let (mut area, mut moment) = (0.0, 0.0);
        for k in 0..n {
            let x = (f64::from(k) + 0.5) / f64::from(n) * WIDTH - 0.5 * WIDTH;
            let height = tilt.depth() + slope * x;
            area += height;
            moment += height * x;
        }
        assert!((moment / area / tilt.level_offset(2.0) - 1.0).abs() < 1e-6);
    }
}
