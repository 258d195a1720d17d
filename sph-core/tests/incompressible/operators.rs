//! P and C, the solver over them, and what a step keeps.

use sph_core::fluid::incompressible::{Outcome, Summation};
use sph_core::{Error, Parameter, Scalar};

use crate::support::{Fluid, SPACING};

#[test]
fn pushes_are_minus_the_adjoint_of_rates() {
    let mut fluid = Fluid::<f64, 2>::new([6, 5], Some([6, 8]), 9.81);
    fluid.jitter(0.2);
    fluid.with(|scheme, particles| scheme.prepare(particles)).unwrap();
    let count = fluid.shapes.len();
    let values = Fluid::<f64, 2>::noise(count, 3);
    let flow: Vec<[f64; 2]> = Fluid::<f64, 2>::noise(2 * count, 5).as_chunks().0.to_vec();
    let (mut pushes, mut rates) = (vec![[0.0; 2]; count], vec![0.0; count]);
    fluid
        .with(|scheme, p| {
            p.sums.pushes(scheme, p.positions, p.shapes, &values, &mut pushes)?;
            p.sums.rates(scheme, p.positions, p.shapes, &flow, &mut rates)
        })
        .unwrap();
    let of_rates: f64 = values.iter().zip(&rates).map(|(q, rate)| q * rate).sum();
    let of_pushes: f64 = flow.iter().flatten().zip(pushes.iter().flatten()).map(|(v, a)| v * a).sum();
    let size: f64 = values.iter().zip(&rates).map(|(q, rate)| (q * rate).abs()).sum();
    assert!((of_rates + of_pushes).abs() < 1e-13 * size, "{of_rates} {of_pushes}");
    assert!(of_rates.abs() > 1e-3 * size, "{of_rates} of {size}");
}

#[test]
fn rates_are_the_change_of_density() {
    let mut fluid = Fluid::<f64, 3>::new([4, 4, 3], None, 0.0);
    fluid.jitter(0.2);
    fluid.with(|scheme, particles| scheme.prepare(particles)).unwrap();
    let count = fluid.shapes.len();
    let flow: Vec<[f64; 3]> = Fluid::<f64, 3>::noise(3 * count, 5).as_chunks().0.to_vec();
    let mut rates = vec![0.0; count];
    fluid.with(|scheme, p| p.sums.rates(scheme, p.positions, p.shapes, &flow, &mut rates)).unwrap();
    const STEP: f64 = 1e-6;
    let densities = |fluid: &mut Fluid<f64, 3>, sign: f64| -> Vec<f64> {
        for (x, v) in fluid.positions[..count].iter_mut().flatten().zip(flow.iter().flatten()) {
            *x += sign * STEP * v;
        }
        fluid.with(|scheme, particles| scheme.prepare(particles)).unwrap();
        fluid.shapes.iter().map(|shape| shape.density).collect()
    };
    let after = densities(&mut fluid, 1.0);
    let before = densities(&mut fluid, -2.0);
    for i in 0..count {
        let expected = (after[i] - before[i]) / (2.0 * STEP);
        assert!((rates[i] - expected).abs() < 1e-5 * expected.abs().max(1.0), "{i}: {} {expected}", rates[i]);
    }
}

#[test]
fn the_lattice_has_density_one_up_to_the_walls() {
    let mut fluid = Fluid::<f64, 2>::new([8, 8], Some([8, 12]), 9.81);
    fluid.with(|scheme, particles| scheme.prepare(particles)).unwrap();
    for (shape, x) in fluid.shapes.iter().zip(&fluid.positions) {
        if x[1] < 5.0 * SPACING {
            assert!((shape.density - 1.0).abs() < 1e-12, "{x:?}: {}", shape.density);
        }
    }
}

/// The greatest eigenvalue of D⁻¹A.
fn eigenvalue<const D: usize>(fluid: &mut Fluid<f64, D>) -> f64 {
    0.9 / fluid.with(|scheme, particles| scheme.estimate_relaxation(particles)).unwrap()
}

#[test]
fn the_greatest_eigenvalue_grows_with_dimensions_and_a_fixed_half_diverges() {
    let found = eigenvalue(&mut Fluid::<f64, 2>::new([8, 8], Some([8, 10]), 9.81));
    assert!((2.3..2.9).contains(&found), "{found}");
    let found = eigenvalue(&mut Fluid::<f64, 3>::new([4, 4, 5], Some([4, 4, 6]), 9.81));
    assert!((3.2..4.6).contains(&found), "{found}");
    let outcome = |relaxation: Option<f64>| -> Outcome {
        let mut fluid = Fluid::<f64, 3>::new([4, 4, 5], Some([4, 4, 7]), 9.81);
        fluid.prepare();
        fluid.scheme.tuning.most_iterations = 100;
        if let Some(relaxation) = relaxation {
            fluid.scheme.tuning.relaxation = relaxation;
        }
        fluid.step(5e-3).unwrap()
    };
    assert!(outcome(None).iterations < 80, "{:?}", outcome(None));
    assert_eq!(outcome(Some(0.5)).iterations, 100, "does not end");
}

#[test]
fn the_greatest_eigenvalue_stays_where_particles_have_come_close_to_walls() {
    let mut fluid = Fluid::<f64, 2>::new([8, 8], Some([8, 10]), 9.81);
    let at_first = eigenvalue(&mut fluid);
    fluid.jitter(0.3);
    let count = fluid.shapes.len();
    for x in &mut fluid.positions[..count] {
        if x[1] < SPACING {
            x[1] *= 0.3;
        }
    }
    let found = eigenvalue(&mut fluid);
    assert!(found < 1.25 * at_first, "{at_first} {found}: the solution would diverge");
}

#[test]
fn the_projection_ends_within_its_tolerance() {
    let mut fluid = Fluid::<f64, 2>::new([8, 10], Some([16, 12]), 9.81);
    fluid.prepare();
    let count = fluid.shapes.len();
    let dt = 4e-3;
    for _ in 0..20 {
        let (before, shapes) = (fluid.positions.clone(), fluid.shapes.clone());
        fluid.step(dt).unwrap();
        let velocities = fluid.velocities.clone();
        let after = std::mem::replace(&mut fluid.positions, before);
        let mut rates = vec![0.0; count];
        fluid.with(|scheme, p| p.sums.rates(scheme, p.positions, &shapes, &velocities, &mut rates)).unwrap();
        fluid.positions = after;
        fluid.with(|scheme, particles| scheme.prepare(particles)).unwrap();
        let compression = shapes.iter().zip(&rates).map(|(shape, rate)| {
            let excess = shape.density - 1.0;
            let part = if excess > 0.0 { 0.2 } else { 0.05 };
            if shape.density < 0.5 { 0.0 } else { (dt * rate + part * excess).max(0.0) }
        });
        let mean = compression.sum::<f64>() / count as f64;
        // of nine rows; the last look is at the values before the last step
        assert!(mean <= 2.0 * (4e-4 + 1e-2 * 0.4) / 9.0, "{mean}");
    }
}

#[test]
fn momentum_and_angular_momentum_are_kept_to_rounding() {
    fn check<T: Scalar>(tolerance: f64) {
        let mut fluid = Fluid::<T, 2>::new([8, 8], None, 0.0);
        fluid.jitter(0.1);
        let noise = Fluid::<T, 2>::noise(128, 11);
        for (v, noise) in fluid.velocities.iter_mut().flatten().zip(noise) {
            *v = T::from_f64(noise);
        }
        let sums = |fluid: &Fluid<T, 2>| {
            let mut sums = [0.0; 4];
            for ([x, y], [u, v]) in fluid.positions.iter().zip(&fluid.velocities) {
                let ([x, y], [u, v]) = ([x, y].map(|x| x.to_f64()), [u, v].map(|v| v.to_f64()));
                sums[0] += u;
                sums[1] += v;
                sums[2] += x * v - y * u;
                sums[3] += u.abs() + v.abs();
            }
            sums
        };
        fluid.prepare();
        let before = sums(&fluid);
        for _ in 0..20 {
            fluid.step(5e-3).unwrap();
        }
        let after = sums(&fluid);
        assert!((after[3] / before[3] - 1.0).abs() > 1e-2, "something happened");
        for k in 0..3 {
            assert!((after[k] - before[k]).abs() < tolerance * before[3], "{k}: {before:?} {after:?}");
        }
    }
    check::<f64>(1e-14);
    check::<f32>(1e-5);
}

#[test]
fn viscosity_slows_approach_alone() {
    let mut fluid = Fluid::<f64, 2>::new([2, 1], None, 0.0);
    let gradient = {
        let scheme = &fluid.scheme;
        let slope = sph_core::Influence::slope(&scheme.influence, SPACING * SPACING);
        scheme.volume * slope * -SPACING
    };
    let length = fluid.scheme.length();
    for (speed, braked) in [(3.0, true), (-3.0, false)] {
        fluid.velocities = vec![[speed, 0.0], [0.0, 0.0]];
        fluid.with(|scheme, particles| scheme.prepare(particles)).unwrap();
        let softened = SPACING * SPACING + 0.01 * length * length;
        let expected = if braked { -0.02 * 3.0 * SPACING / softened * gradient } else { 0.0 };
        let found = fluid.shapes.iter().map(|shape| shape.force[0]).collect::<Vec<_>>();
        assert!((found[0] - expected).abs() < 1e-12 && (found[1] + expected).abs() < 1e-12, "{found:?}");
        assert_eq!(braked, found[0] < 0.0);
    }
}

#[test]
fn each_limit_of_the_step_is_its_closed_form() {
    let mut fluid = Fluid::<f64, 2>::new([2, 2], None, 9.81);
    let near =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    fluid.scheme.viscosity = 0.0;
    near(fluid.scheme.longest_step(0.0), (0.003 * SPACING / 9.81_f64).sqrt());
    near(fluid.scheme.longest_step(12.0), 0.6 * SPACING / 12.0);
    fluid.scheme.viscosity = 100.0;
    near(fluid.scheme.longest_step(12.0), 0.4 * 0.13 * 0.13 / 100.0);
    fluid.scheme.viscosity = 0.0;
    fluid.scheme.gravity = [0.0; 2];
    assert_eq!(fluid.scheme.longest_step(0.0), f64::MAX);
}

#[test]
fn a_particle_that_is_shot_at_a_wall_is_put_back_and_counted() {
    let mut fluid = Fluid::<f64, 2>::new([4, 4], Some([8, 8]), 0.0);
    fluid.prepare();
    fluid.velocities[0] = [-500.0, 0.0];
    let outcome = fluid.step(5e-3).unwrap();
    // it takes others with it
    assert!((1..4).contains(&outcome.put_back), "{outcome:?}");
    assert_eq!((fluid.positions[0][0], fluid.velocities[0][0]), (0.0, 0.0));
    assert!(fluid.positions[..16].iter().flatten().all(|x| (0.0..=0.8).contains(x)));
}

#[test]
fn slices_that_do_not_agree_and_lost_particles_are_errors() {
    let mut fluid = Fluid::<f64, 2>::new([3, 3], Some([4, 4]), 9.81);
    fluid.positions[4][1] = f64::NAN;
    let error = fluid.step(1e-3).unwrap_err();
    assert_eq!(error, Error::NotFinite { parameter: Parameter::Position, index: 4 });
    fluid.velocities.pop();
    let error = fluid.step(1e-3).unwrap_err();
    assert!(matches!(error, Error::LengthMismatch { expected: 9, found: 8, .. }), "{error}");
    let mut fluid = Fluid::<f64, 2>::new([3, 3], Some([4, 4]), 9.81);
    fluid.trial.pop();
    assert!(fluid.with(|scheme, particles| scheme.prepare(particles)).is_err());
}
