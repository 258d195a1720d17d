//! Convergence of Def. 3.1 and Thm 3.3 on jittered lattices, and the table in `sph-core/docs/convergence.md`, which is the
//! output of
//!
//! ```text
//! cargo test --release -p fluisim-tests --test mathematics convergence -- --nocapture --test-threads 1
//! ```

use core::f64::consts::TAU;

use crate::cloud::{Grid, Random, jittered};
use sph_core::kernel::WendlandC2;
use sph_core::vector::{norm_squared, sub};
use sph_core::{Field, KernelInfluence, Neighbours, Sources, Uniform, field};

/// Every sample lies up to this fraction of the spacing away from its place, along every axis.
const JITTER: f64 = 0.1;
const RATIOS: [f64; 4] = [2.0, 2.6, 3.5, 5.0];
const POINTS: usize = 1000;

/// The columns: values by Def. 3.1, Shepard and moving least squares; their gradients; the corrected gradient at samples.
const COLUMNS: [&str; 7] =
    ["plain", "Shepard", "least squares", "∇ plain", "∇ Shepard", "∇ least squares", "∇ corrected"];
const PLAIN: usize = 0;
const SHEPARD: usize = 1;
const LEAST_SQUARES: usize = 2;
const PLAIN_SLOPE: usize = 3;
const LEAST_SQUARES_SLOPE: usize = 5;
const CORRECTED_SLOPE: usize = 6;

/// A(x) = Π sin(2π x_a + 0.4 a), which has period 1, and ∇A.
fn truth<const D: usize>(x: &[f64; D]) -> (f64, [f64; D]) {
    let phase = |axis: usize| TAU * x[axis] + 0.4 * axis as f64;
    let factor = |axis, by| if axis == by { TAU * phase(axis).cos() } else { phase(axis).sin() };
    let value = (0..D).map(|axis| phase(axis).sin()).product();
    (value, core::array::from_fn(|by| (0..D).map(|axis| factor(axis, by)).product()))
}

/// Root mean square errors in `COLUMNS`, gradients in units of 2π, and the mean number of neighbours.
fn errors<const D: usize>(count: usize, ratio: f64) -> ([f64; 7], f64) {
    let h = ratio / count as f64;
    let mut grid = Grid::new(jittered::<D>(count, JITTER, 42), h, true);
    let values: Vec<f64> = grid.positions.iter().map(|x| truth(x).0).collect();
    let mass = Uniform((count as f64).powi(-(D as i32)));
    let search = grid.search().unwrap();
    let w = KernelInfluence::<f64, D, WendlandC2>::new(h).unwrap();
    let (mut density, mut volumes) = (vec![0.0; values.len()], vec![0.0; values.len()]);
    Sources::new(&search, mass).unwrap().density(&w, &mut density).unwrap();
    field::volumes(mass, &density, &mut volumes).unwrap();
    let sources = Sources::new(&search, volumes.as_slice()).unwrap();
    let field = Field::new(&sources, values.as_slice()).unwrap();
    let mut random = Random(1);
    let (mut squares, mut neighbours) = ([0.0; 7], 0);
    for _ in 0..POINTS {
        let x = random.point(0.0, 1.0);
        let i = (random.unit() * values.len() as f64) as usize;
        let (value, slope) = truth(&x);
        let (plain, plain_slope) = field.interpolate_with_gradient_at(&w, &x);
        let (shepard, shepard_slope) = field.shepard_gradient_at(&w, &x).unwrap();
        let fit = field.corrected_at(&w, &x).unwrap();
        let at_sample = sub(&field.corrected_gradient(&w, i).unwrap(), &truth(&sources.positions()[i]).1);
        let of_slope = |found| norm_squared(&sub(&found, &slope)) / (TAU * TAU);
        for (sum, square) in squares.iter_mut().zip([
            (plain - value).powi(2),
            (shepard - value).powi(2),
            (fit.value - value).powi(2),
            of_slope(plain_slope),
            of_slope(shepard_slope),
            of_slope(fit.gradient),
            norm_squared(&at_sample) / (TAU * TAU),
        ]) {
            *sum += square;
        }
        neighbours += search.count(&x, h);
    }
    (squares.map(|sum| (sum / POINTS as f64).sqrt()), neighbours as f64 / POINTS as f64)
}

/// The order at which an error falls from one resolution to one `halvings` halvings of Δx finer.
fn order(coarse: f64, fine: f64, halvings: usize) -> f64 {
    (coarse / fine).log2() / halvings as f64
}

#[track_caller]
fn assert_order(found: f64, between: [f64; 2], what: &str) {
    assert!((between[0]..=between[1]).contains(&found), "{what}: order {found:.2} is not in {between:?}");
}

/// Measures, prints and holds the table for D dimensions; `counts` double from one to the next.
fn check<const D: usize>(counts: &[usize]) {
    let table: Vec<[([f64; 7], f64); 4]> =
        counts.iter().map(|&count| RATIOS.map(|ratio| errors::<D>(count, ratio))).collect();
    print_table::<D>(counts, &table);
    let error = |row: usize, ratio: usize, column: usize| table[row][ratio].0[column];
    let last = counts.len() - 1;

    // More samples and more neighbours together: every error falls at every step.
    for column in 0..COLUMNS.len() {
        for row in 1..=last {
            let (coarse, fine) = (error(row - 1, row - 1, column), error(row, row, column));
            assert!(fine < coarse, "D = {D}, {}, row {row}: {fine:e} after {coarse:e}", COLUMNS[column]);
        }
    }
    let diagonal = |column| order(error(0, 0, column), error(last, last, column), last);
    assert_order(diagonal(PLAIN), [0.9, 1.5], "plain value, joint limit");
    assert_order(diagonal(PLAIN_SLOPE), [0.25, 0.9], "plain gradient, joint limit");

    // More samples alone, at a fixed number of neighbours.
    for ratio in 0..RATIOS.len() {
        let what = |column: usize| format!("D = {D}, h/Δx = {}: {}", RATIOS[ratio], COLUMNS[column]);
        let found = |column| order(error(last - 1, ratio, column), error(last, ratio, column), 1);
        assert_order(found(LEAST_SQUARES), [1.8, 2.1], &what(LEAST_SQUARES));
        for column in [SHEPARD, LEAST_SQUARES_SLOPE, CORRECTED_SLOPE] {
            assert_order(found(column), [0.9, 2.1], &what(column));
        }
    }
    // The plain gradient's noise is of order jitter/h: it does not fall unless the number of neighbours rises.
    let noise = order(error(last - 1, 0, PLAIN_SLOPE), error(last, 0, PLAIN_SLOPE), 1);
    assert_order(noise, [-1.3, -0.6], "plain gradient at a fixed number of neighbours");
    // More neighbours alone, where noise is all that is left: the plain gradient falls.
    for ratio in 1..RATIOS.len() {
        assert!(error(last, ratio, PLAIN_SLOPE) < error(last, ratio - 1, PLAIN_SLOPE));
    }
}

fn print_table<const D: usize>(counts: &[usize], table: &[[([f64; 7], f64); 4]]) {
    let mut text = format!("\n## D = {D}\n\n| 1/Δx | h/Δx | neighbours |");
    for column in COLUMNS {
        text += &format!(" {column} |");
    }
    text += &format!("\n|---|---|---|{}\n", "---|".repeat(COLUMNS.len()));
    for (count, row) in counts.iter().zip(table) {
        for (ratio, (errors, neighbours)) in RATIOS.iter().zip(row) {
            text += &format!("| {count} | {ratio} | {neighbours:.1} |");
            for error in errors {
                text += &format!(" {error:.1e} |");
            }
            text.push('\n');
        }
    }
    println!("{text}");
}

#[test]
fn interpolants_converge_in_1d() {
    check::<1>(&[16, 32, 64, 128]);
}

#[test]
fn interpolants_converge_in_2d() {
    check::<2>(&[16, 32, 64, 128]);
}

#[test]
fn interpolants_converge_in_3d() {
    check::<3>(&[10, 20, 40]);
}
