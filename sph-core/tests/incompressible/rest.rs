//! Water at rest, where a step leaves no trace but what the solver does wrong.

use sph_core::Scalar;

use crate::support::{Fluid, SPACING};

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 1000.0;

/// Water `wide` and `deep` particles in a tank, its gravity brought up over a part of the time.
fn settled<T: Scalar>(wide: i32, deep: i32, seconds: f64, closing: f64) -> Fluid<T, 2> {
    let mut fluid = Fluid::<T, 2>::new([wide, deep], Some([wide, deep + 4]), GRAVITY);
    // α = 0.1 as in the tank of `fluisim run hydrostatic`
    fluid.scheme.viscosity = T::from_f64(0.575);
    fluid.scheme.tuning.closing = T::from_f64(closing);
    fluid.prepare();
    const PARTS: u32 = 20;
    for part in 1..=PARTS {
        fluid.scheme.gravity[1] = T::from_f64(-GRAVITY * (2.0 * f64::from(part) / f64::from(PARTS)).min(1.0));
        fluid.advance(seconds / f64::from(PARTS));
    }
    fluid
}

/// The mean height of the rows from the bed up, and their mean pressure over that of a column of water of `depth`.
fn rows(fluid: &Fluid<f64, 2>, depth: f64) -> Vec<f64> {
    let mut rows: Vec<(f64, usize)> = Vec::new();
    for (x, p) in fluid.positions.iter().zip(&fluid.pressures) {
        let row = (x[1] / SPACING) as usize;
        rows.resize(rows.len().max(row + 1), (0.0, 0));
        rows[row].0 += p / (DENSITY * GRAVITY * (depth - x[1]));
        rows[row].1 += 1;
    }
    rows.iter().map(|&(sum, count)| sum / count as f64).collect()
}

#[test]
fn pressure_is_the_weight_above_in_the_lowest_row_too() {
    let fluid = settled::<f64>(10, 10, 1.2, 0.05);
    let rows = rows(&fluid, 10.0 * SPACING);
    assert!((rows[0] - 1.0).abs() < 0.1, "the lowest row: {rows:?}");
    let below = &rows[..6];
    let mean = below.iter().sum::<f64>() / below.len() as f64;
    assert!((mean - 1.0).abs() < 0.05, "{rows:?}");
}

#[test]
fn volume_and_energy_keep_at_rest() {
    let mut fluid = settled::<f32>(10, 10, 1.0, 0.05);
    let height = |fluid: &Fluid<f32, 2>| {
        let count = fluid.shapes.len();
        2.0 * fluid.positions[..count].iter().map(|x| f64::from(x[1])).sum::<f64>() / count as f64
    };
    assert!((height(&fluid) / (10.0 * SPACING) - 1.0).abs() < 0.01, "{}", height(&fluid));
    let (mut lowest, mut growth) = (fluid.energy(), 0.0_f64);
    let first = lowest;
    for _ in 0..10 {
        fluid.advance(0.05);
        lowest = lowest.min(fluid.energy());
        growth = growth.max(fluid.energy() - lowest);
    }
    assert!(growth < 2e-3 * first, "{growth} of {first}");
    assert!((height(&fluid) / (10.0 * SPACING) - 1.0).abs() < 0.01, "{}", height(&fluid));
    let excess = fluid.shapes.iter().map(|shape| (shape.density - 1.0).max(0.0));
    assert!(excess.sum::<f32>() / (fluid.shapes.len() as f32) < 2e-3);
}

#[test]
fn what_is_pressed_opens_again_and_without_chi_does_not() {
    let excess = |opening: f64| {
        let mut fluid = Fluid::<f64, 2>::new([10, 6], Some([10, 10]), 0.0);
        fluid.scheme.tuning.opening = opening;
        let count = fluid.shapes.len();
        fluid.positions[..count].iter_mut().for_each(|x| x[1] *= 0.97);
        fluid.prepare();
        for _ in 0..20 {
            fluid.step(5e-3).unwrap();
        }
        fluid.shapes.iter().map(|shape| (shape.density - 1.0).max(0.0)).sum::<f64>() / count as f64
    };
    let (with, without) = (excess(0.2), excess(0.0));
    assert!(with < 2e-3 && without > 1e-2, "{with} {without}");
}

#[test]
fn a_fluid_that_was_thinned_closes_again_and_without_chi_does_not() {
    let middle = |closing: f64| {
        let mut fluid = Fluid::<f64, 2>::new([10, 6], Some([10, 10]), GRAVITY);
        fluid.scheme.tuning.closing = closing;
        // thinner by 3 % in height
        let count = fluid.shapes.len();
        fluid.positions[..count].iter_mut().for_each(|x| x[1] *= 1.03);
        fluid.scheme.gravity = [0.0; 2];
        fluid.prepare();
        // no gravity: what pulls is nothing, and what flows together is held by the constraint alone
        fluid.velocities.iter_mut().zip(&fluid.positions).for_each(|(v, x)| v[1] = -0.2 * x[1]);
        for _ in 0..10 {
            fluid.step(5e-3).unwrap();
        }
        let inner =
            fluid.positions[..count].iter().zip(&fluid.shapes).filter(|(x, _)| (0.1..0.35).contains(&x[1]));
        let densities: Vec<f64> = inner.map(|(_, shape)| shape.density).collect();
        densities.iter().sum::<f64>() / densities.len() as f64
    };
    let (with, without) = (middle(0.05), middle(0.0));
    assert!(with > without + 1e-3, "{with} {without}");
}

#[test]
fn a_deep_column_that_falls_onto_the_bed_is_noticed() {
    // forty rows: one is pressed by a step of free fall, so that the mean over all rows is a fortieth of it
    let pressed = |in_a_row: f64| {
        let mut fluid = Fluid::<f64, 2>::new([3, 40], Some([3, 44]), GRAVITY);
        fluid.scheme.tuning.tolerances = [in_a_row, 0.0];
        fluid.scheme.tuning.opening = 0.0;
        fluid.scheme.tuning.least_iterations = 1;
        fluid.prepare();
        for _ in 0..4 {
            fluid.step(3e-3).unwrap();
        }
        let lowest: Vec<f64> = fluid
            .positions
            .iter()
            .zip(&fluid.velocities)
            .filter(|(x, _)| x[1] < 2.0)
            .map(|(_, v)| v[1])
            .collect();
        lowest.iter().sum::<f64>() / lowest.len() as f64 / (-GRAVITY * 4.0 * 3e-3)
    };
    let (scaled, not) = (pressed(4e-4), pressed(1e9));
    assert!(
        scaled < 0.2 && not > 1.8 * scaled,
        "the lower half falls by {scaled} of free fall, else by {not}"
    );
}
