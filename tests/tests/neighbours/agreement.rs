//! More than eighteen thousand random configurations: brute force, grids and a sweep against the oracle.

use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use sph_core::scalar::fixed::{Checked, I16F16, I20F12, I32F32, Saturating, Wrapping};
use sph_core::{BruteForce, CellGrid, Index, InlineCellGrid};

use super::oracle::{self, Record, found, record, sorted};
use super::plan::{Plan, Probe, Sketch, sketch};
use super::sweep::Sweep;

/// Every search on every query of one configuration.
fn agree<T: Probe, const D: usize>(sketch: &Sketch<D>) -> Result<(), TestCaseError> {
    let plan = Plan::<T, D>::new(sketch);
    let brute = BruteForce::in_domain(&plan.positions, plan.domain().unwrap()).unwrap();
    for query in &plan.queries {
        let x = std::array::from_fn(|axis| oracle::wrapped(query[axis], plan.periods[axis]));
        prop_assert_eq!(plan.domain().unwrap().wrap(query), x);
        let hits = oracle::hits(&plan.positions, &plan.periods, &x, plan.radius, plan.reach());
        let by_index = oracle::records(&hits);
        prop_assert_eq!(found(&brute, query, plan.radius), &by_index[..]);
        let mut by_cell: Vec<_> = hits.iter().map(|hit| (cell(&plan, &x, hit), hit)).collect();
        by_cell.sort_by_key(|&(cell, hit)| (cell, hit.index));
        let by_cell: Vec<Record> =
            by_cell.iter().map(|(_, hit)| record(hit.index, &hit.offset, hit.distance_squared)).collect();
        grids(&plan, query, &by_cell)?;
        copies(&plan, &x, &by_index)?;
    }
    Ok(())
}

/// Where a grid meets a hit: rows ascending, so the last axis counts first.
fn cell<T: Probe, const D: usize>(plan: &Plan<T, D>, x: &[T; D], hit: &oracle::Hit<T, D>) -> [i64; D] {
    std::array::from_fn(|place| {
        let axis = D - 1 - place;
        plan.cell_number(axis, x[axis], plan.positions[hit.index][axis], hit.image[axis])
    })
}

/// Grids of each index type find the expected neighbours in the expected order, twice.
fn grids<T: Probe, const D: usize>(
    plan: &Plan<T, D>,
    query: &[T; D],
    expected: &[Record],
) -> Result<(), TestCaseError> {
    grid::<T, u8, D>(plan, query, expected, 0)?;
    grid::<T, u16, D>(plan, query, expected, 3)?;
    grid::<T, u32, D>(plan, query, expected, 1)?;
    let mut inline = InlineCellGrid::<u8, 1025, 32>::new();
    if plan.layout().unwrap().cells() <= 1024 {
        for _ in 0..2 {
            let grid = inline.build(plan.layout().unwrap(), &plan.positions).unwrap();
            prop_assert_eq!(&found(&grid, query, plan.radius)[..], expected);
        }
    }
    Ok(())
}

/// A grid on slices with room to spare and rubbish in them.
fn grid<T: Probe, I: Index, const D: usize>(
    plan: &Plan<T, D>,
    query: &[T; D],
    expected: &[Record],
    spare: usize,
) -> Result<(), TestCaseError> {
    let layout = plan.layout().unwrap();
    let rubbish = I::from_usize(7);
    let mut starts = vec![rubbish; layout.cells() + 1 + spare];
    let mut entries = vec![rubbish; plan.positions.len() + spare];
    let grid = CellGrid::build(layout, &plan.positions, &mut starts, &mut entries).unwrap();
    prop_assert_eq!(&found(&grid, query, plan.radius)[..], expected);
    let mut all: Vec<usize> = grid.entries().iter().map(|entry| entry.to_usize()).collect();
    all.sort();
    prop_assert_eq!(all, (0..plan.positions.len()).collect::<Vec<_>>());
    Ok(())
}

/// Open searches over an explicit copy of all images find the same as a periodic one.
fn copies<T: Probe, const D: usize>(
    plan: &Plan<T, D>,
    x: &[T; D],
    expected: &[Record],
) -> Result<(), TestCaseError> {
    let images = oracle::images(&plan.periods, plan.reach());
    let copies: Vec<[T; D]> = plan
        .positions
        .iter()
        .flat_map(|position| {
            images.iter().map(|k| {
                std::array::from_fn(|axis| oracle::image(position[axis], plan.periods[axis], k[axis]))
            })
        })
        .collect();
    let original = |records: Vec<Record>| -> Vec<Record> {
        records.into_iter().map(|(copy, offset, square)| (copy / images.len(), offset, square)).collect()
    };
    let expected = sorted(expected.to_vec());
    let brute = BruteForce::new(&copies).unwrap();
    prop_assert_eq!(sorted(original(found(&brute, x, plan.radius))), &expected[..]);
    prop_assert_eq!(sorted(original(found(&Sweep::new(&copies), x, plan.radius))), &expected[..]);

    let layout = sph_core::CellLayout::unbounded(plan.cell_size, plan.counts).unwrap();
    let mut starts = vec![0_u32; layout.cells() + 1];
    let mut entries = vec![0_u32; copies.len()];
    let grid = CellGrid::build(layout, &copies, &mut starts, &mut entries).unwrap();
    prop_assert_eq!(sorted(original(found(&grid, x, plan.radius))), expected);
    Ok(())
}

macro_rules! agreements {
    ($($name:ident: $Scalar:ty, $axes:literal, $cases:literal;)*) => {$(
        proptest! {
            #![proptest_config(ProptestConfig {
                cases: $cases,
                failure_persistence: None,
                ..ProptestConfig::default()
            })]

            #[test]
            fn $name(sketch in sketch::<$axes>()) {
                agree::<$Scalar, $axes>(&sketch)?;
            }
        }
    )*};
}

agreements! {
    f32_on_a_line: f32, 1, 2500;
    f32_in_the_plane: f32, 2, 2000;
    f32_in_space: f32, 3, 800;
    f32_in_four_dimensions: f32, 4, 200;
    f64_on_a_line: f64, 1, 2500;
    f64_in_the_plane: f64, 2, 2000;
    f64_in_space: f64, 3, 800;
    f64_in_four_dimensions: f64, 4, 200;
    saturating_on_a_line: Saturating<I16F16>, 1, 1500;
    saturating_in_the_plane: Saturating<I16F16>, 2, 1000;
    saturating_in_space: Saturating<I16F16>, 3, 300;
    coarse_on_a_line: Saturating<I20F12>, 1, 1500;
    coarse_in_the_plane: Saturating<I20F12>, 2, 500;
    checked_on_a_line: Checked<I16F16>, 1, 1500;
    checked_in_the_plane: Checked<I16F16>, 2, 500;
    wrapping_in_the_plane: Wrapping<I32F32>, 2, 500;
}
