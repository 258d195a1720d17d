//! How quickly the projection is solved, and to what: against an iteration without momentum, and by numbers of iterations.

use sph_core::fluid::incompressible::{Summation, Tuning};

use crate::support::{Fluid, SPACING};

#[test]
fn the_defaults_are_those_that_are_documented() {
    let expected = Tuning {
        tolerances: [4e-4, 1e-2],
        least_iterations: 2,
        most_iterations: 200,
        closing: 0.05,
        opening: 0.2,
        relaxation: 0.2,
        courant: 0.6,
        acceleration: 0.003,
    };
    assert_eq!(Tuning::<f64>::default(), expected);
}

#[test]
fn a_limit_of_the_step_that_is_below_one_binds_as_well() {
    let mut fluid = Fluid::<f64, 2>::new([2, 2], None, 0.5);
    let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
    fluid.scheme.viscosity = 0.0;
    near(fluid.scheme.longest_step(0.0), (0.003 * SPACING / 0.5_f64).sqrt());
    fluid.scheme.gravity = [0.0; 2];
    near(fluid.scheme.longest_step(0.5), 0.6 * SPACING / 0.5);
    fluid.scheme.viscosity = 0.5;
    near(fluid.scheme.longest_step(0.0), 0.4 * 0.13 * 0.13 / 0.5);
}

/// A column that falls onto the bed in one step, with pressures solved to a mean error of `tolerance` in a row.
fn fallen(tolerance: f64) -> (Fluid<f64, 2>, u32) {
    let mut fluid = Fluid::<f64, 2>::new([6, 12], Some([6, 14]), 9.81);
    fluid.scheme.tuning.tolerances = [tolerance, 0.0];
    fluid.scheme.tuning.most_iterations = 100_000;
    fluid.prepare();
    let outcome = fluid.step(4e-3).unwrap();
    (fluid, outcome.iterations)
}

/// The pressures q Δt² of the same column by steps of ω r/d alone, without momentum, restarts or an end.
fn plainly_solved() -> Vec<f64> {
    let mut fluid = Fluid::<f64, 2>::new([6, 12], Some([6, 14]), 9.81);
    fluid.prepare();
    let (dt, count) = (4e-3, fluid.shapes.len());
    let shapes = fluid.shapes.clone();
    let falling: Vec<[f64; 2]> = shapes.iter().map(|shape| shape.force.map(|a| a * dt)).collect();
    let (mut sources, mut rates) = (vec![0.0; count], vec![0.0; count]);
    let (mut values, mut pushes) = (vec![0.0; count], vec![[0.0; 2]; count]);
    let relaxation = fluid.scheme.tuning.relaxation;
    fluid
        .with(|scheme, p| {
            p.sums.rates(scheme, p.positions, &shapes, &falling, &mut sources)?;
            for (source, shape) in sources.iter_mut().zip(&shapes) {
                let excess = shape.density - 1.0;
                *source = dt * *source + if excess > 0.0 { 0.2 } else { 0.05 } * excess;
            }
            for _ in 0..3_000 {
                p.sums.pushes(scheme, p.positions, &shapes, &values, &mut pushes)?;
                p.sums.rates(scheme, p.positions, &shapes, &pushes, &mut rates)?;
                for (k, shape) in shapes.iter().enumerate().filter(|(_, shape)| shape.density >= 0.5) {
                    values[k] = (values[k] + relaxation * (sources[k] + rates[k]) / shape.diagonal).max(0.0);
                }
            }
            Ok::<(), sph_core::Error>(())
        })
        .unwrap();
    values
}

#[test]
fn the_solution_is_that_of_plain_projected_steps() {
    let (fluid, _) = fallen(1e-13);
    let expected = plainly_solved();
    let greatest = expected.iter().fold(0.0, |greatest: f64, &value| greatest.max(value));
    let unit = 4e-3_f64.powi(2) / 1000.0;
    for (pressure, expected) in fluid.pressures.iter().zip(&expected) {
        assert!((pressure * unit - expected).abs() < 1e-6 * greatest, "{} {expected}", pressure * unit);
    }
    assert!(greatest > 0.0);
}

#[test]
fn momentum_and_restarts_take_the_iterations_they_are_known_to_take() {
    // any other rule for t, β, the restart, the tolerance or the least and the most takes others
    let found = [1e-2, 4e-4, 1e-6, 1e-9].map(|tolerance| fallen(tolerance).1);
    assert_eq!(found, [11, 14, 65, 157]);
}

#[test]
fn a_step_begins_with_the_pressures_of_the_one_before() {
    let next = |forget: bool| {
        let (mut fluid, _) = fallen(1e-6);
        if forget {
            fluid.pressures.fill(0.0);
        }
        fluid.step(4e-3).unwrap().iterations
    };
    assert_eq!((next(false), next(true)), (57, 64));
}

#[test]
fn iterations_have_a_least_and_a_most() {
    let iterations = |least: u32, most: u32| {
        let mut fluid = Fluid::<f64, 2>::new([6, 12], Some([6, 14]), 9.81);
        fluid.scheme.tuning.tolerances = [1e9, 0.0];
        (fluid.scheme.tuning.least_iterations, fluid.scheme.tuning.most_iterations) = (least, most);
        fluid.prepare();
        let first = fluid.step(4e-3).unwrap().iterations;
        fluid.scheme.tuning.tolerances = [0.0, 0.0];
        (first, fluid.step(4e-3).unwrap().iterations)
    };
    // a tolerance of nothing never ends, one that is held at 8e-5 in the mean may end at the least
    let (first, second) = iterations(30, 40);
    assert_eq!(second, 40);
    assert!((30..=40).contains(&first), "{first}");
    assert_eq!(iterations(40, 40), (40, 40));
}

#[test]
fn spray_falls_and_meets_freely_whatever_its_pressure_was() {
    let mut fluid = Fluid::<f64, 2>::new([2, 1], None, 9.81);
    fluid.scheme.viscosity = 0.0;
    // so fast that a fluid would be pressed together
    let speeds = if fluid.positions[0][0] < fluid.positions[1][0] { [8.0, -8.0] } else { [-8.0, 8.0] };
    fluid.velocities = speeds.map(|speed| [speed, 0.0]).to_vec();
    fluid.prepare();
    assert!(fluid.shapes.iter().all(|shape| shape.density < 0.5));
    fluid.pressures.fill(1000.0);
    fluid.step(2e-3).unwrap();
    for ((velocity, pressure), speed) in fluid.velocities.iter().zip(&fluid.pressures).zip(speeds) {
        assert_eq!((velocity[0], *pressure), (speed, 0.0));
        assert!((velocity[1] + 9.81 * 2e-3).abs() < 1e-15, "{}", velocity[1]);
    }
}
