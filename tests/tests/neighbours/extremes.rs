//! Any finite numbers at all, with overflow checks on: no panic, and the searches still agree.

use proptest::array::uniform;
use proptest::collection::vec;
use proptest::num::{f32 as any_f32, f64 as any_f64};
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use sph_core::{BruteForce, CellGrid, CellLayout, Domain, Error, Neighbours, Scalar};

use super::oracle::{floor, found, sorted};

/// Numbers for one attempt; each choice of `ends` is open or periodic.
struct Attempt<'a, T, const D: usize> {
    bounds: [[T; D]; 2],
    counts: [u32; D],
    ends: [bool; D],
    radius: T,
    points: &'a [[T; D]],
}

/// The layouts that accept these numbers agree with brute force.
fn attempt<T: Scalar, const D: usize>(attempt: &Attempt<'_, T, D>) -> Result<(), TestCaseError> {
    let Attempt { bounds: [lower, upper], counts, ends, radius, points } = attempt;
    let layouts = [CellLayout::bounded(lower, upper, *counts), CellLayout::unbounded(lower[0], *counts)];
    for layout in layouts.into_iter().flatten() {
        compare(layout, Domain::open(), points, points, *radius)?;
        let (mut layout, mut domain, mut radius) = (layout, Domain::open(), *radius);
        for axis in (0..D).filter(|&axis| ends[axis]) {
            let ends = (lower[axis], upper[axis]);
            let periodic = domain.periodic(axis, ends.0, ends.1);
            if let (Ok(with), Ok(cells)) = (periodic, layout.periodic(axis, ends.0, ends.1)) {
                (layout, domain) = (cells, with);
                // Not more than a few images: their number is the time a query takes.
                let length = ends.1 - ends.0;
                radius = if floor(radius / length).abs() < 3.0 { radius } else { length };
            }
        }
        let inside: Vec<[T; D]> = points.iter().map(|x| domain.wrap(x)).collect();
        compare(layout, domain, &inside, points, radius)?;
    }
    Ok(())
}

fn compare<T: Scalar, const D: usize>(
    layout: CellLayout<T, D>,
    domain: Domain<T, D>,
    positions: &[[T; D]],
    queries: &[[T; D]],
    radius: T,
) -> Result<(), TestCaseError> {
    let mut starts = vec![0_u16; layout.cells() + 1];
    let mut entries = vec![0_u16; positions.len()];
    let grid = CellGrid::build(layout, positions, &mut starts, &mut entries)
        .map_err(|error: Error| TestCaseError::fail(error.to_string()))?;
    let brute = BruteForce::in_domain(positions, domain).unwrap();
    for x in queries {
        prop_assert_eq!(sorted(found(&grid, x, radius)), sorted(found(&brute, x, radius)));
    }
    Ok(())
}

/// A few numbers are repeated often, so that some lie near others: any finite ones, and the ends of the range.
macro_rules! extremes {
    ($($name:ident: $Float:ident, $any:ident, $axes:literal, $cases:literal;)*) => {$(
        proptest! {
            #![proptest_config(ProptestConfig {
                cases: $cases,
                failure_persistence: None,
                ..ProptestConfig::default()
            })]

            #[test]
            fn $name(
                pool in vec(prop_oneof![
                    4 => $any::NORMAL | $any::SUBNORMAL | $any::ZERO,
                    2 => -10.0..10.0 as $Float,
                    1 => prop::sample::select(vec![$Float::MAX, $Float::MIN, 1e30, -1e30, $Float::MIN_POSITIVE]),
                ], 6),
                ends in uniform::<_, $axes>(any::<bool>()),
                counts in uniform::<_, $axes>(prop::sample::select(vec![1_u32, 2, 3, 7])),
                picks in vec(uniform::<_, $axes>(0_usize..6), 8),
            ) {
                let points: Vec<[$Float; $axes]> =
                    picks.iter().map(|pick| pick.map(|index| pool[index])).collect();
                let radius = points[2][0].abs();
                attempt(&Attempt { bounds: [points[0], points[1]], counts, ends, radius, points: &points })?;
            }
        }
    )*};
}

extremes! {
    any_f32_on_a_line: f32, any_f32, 1, 4000;
    any_f32_in_the_plane: f32, any_f32, 2, 1500;
    any_f32_in_space: f32, any_f32, 3, 500;
    any_f64_on_a_line: f64, any_f64, 1, 4000;
    any_f64_in_the_plane: f64, any_f64, 2, 1500;
    any_f64_in_space: f64, any_f64, 3, 500;
}

#[test]
fn a_radius_of_more_periods_than_can_be_numbered_ends() {
    let layout = CellLayout::<f32, 1>::unbounded(1.0, [1 << 20]).unwrap().periodic(0, 0.0, 1.0).unwrap();
    let mut starts = vec![0_u8; layout.cells() + 1];
    let mut entries = [0_u8; 1];
    let grid = CellGrid::build(layout, &[[0.5]], &mut starts, &mut entries).unwrap();
    for radius in [1e10, 1e30, f32::MAX] {
        assert!(grid.count(&[0.5], radius) >= 1024);
    }
}

#[test]
fn a_radius_at_the_end_of_the_range_meets_few_images() {
    let (lower, upper) = (-1e37_f32, 1e38);
    let domain = Domain::open().periodic(0, lower, upper).unwrap();
    let layout = CellLayout::bounded(&[0.0], &[1.0], [3]).unwrap().periodic(0, lower, upper).unwrap();
    for radius in [1e38, 3e38, f32::MAX] {
        compare(layout, domain, &[[0.0], [9e37]], &[[0.0], [-9e36], [f32::MAX]], radius).unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn slices_that_nobody_sorted_are_harmless(starts in vec(any::<u8>(), 0..8), entries in vec(any::<u8>(), 0..8)) {
        let positions = [[0.5_f32], [1.5], [2.5]];
        let layout = CellLayout::bounded(&[0.0], &[4.0], [4]).unwrap();
        let grid = CellGrid::from_sorted(layout, &positions, &starts, &entries);
        grid.for_each(&[1.5], 9.0, |neighbour| assert!(neighbour.index < 3));
        prop_assert!(grid.entries().len() <= 3);
    }
}
