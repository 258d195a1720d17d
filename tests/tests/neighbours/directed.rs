//! Cases worked out by hand: aliasing cells, the edge of the radius, and roundings that move an image or a query.

use sph_core::scalar::fixed::{Checked, I16F16, Saturating};
use sph_core::{BruteForce, CellGrid, CellLayout, Domain, Neighbours, Scalar};

use super::oracle::{Record, found, sorted};

/// What brute force and a grid find, required to be the same.
fn both<T: Scalar, const D: usize>(
    layout: CellLayout<T, D>,
    domain: Domain<T, D>,
    positions: &[[T; D]],
    x: &[T; D],
    radius: T,
) -> Vec<Record> {
    let mut starts = vec![0_u32; layout.cells() + 1];
    let mut entries = vec![0_u32; positions.len()];
    let grid = CellGrid::build(layout, positions, &mut starts, &mut entries).unwrap();
    let brute = found(&BruteForce::in_domain(positions, domain).unwrap(), x, radius);
    assert_eq!(sorted(found(&grid, x, radius)), sorted(brute.clone()));
    brute
}

/// The same on one periodic axis of `count` cells.
fn on_a_ring<T: Scalar>(bounds: [T; 2], count: u32, positions: &[[T; 1]], x: T, radius: T) -> Vec<Record> {
    let [lower, upper] = bounds;
    let domain = Domain::open().periodic(0, lower, upper).unwrap();
    let layout = CellLayout::unbounded(T::ONE, [count]).unwrap().periodic(0, lower, upper).unwrap();
    both(layout, domain, positions, &[x], radius)
}

#[test]
fn samples_of_aliasing_cells_are_counted_once() {
    // Every one of these cells is stored in one of four; a radius over many cells meets each stored cell again and again.
    let positions: Vec<[f32; 2]> = (-20..20).map(|n| [n as f32 * 1.01, n as f32 * -0.37]).collect();
    for counts in [[1, 1], [2, 2], [4, 1], [3, 2]] {
        let layout = CellLayout::unbounded(0.5, counts).unwrap();
        for radius in [0.4, 0.6, 3.0, 100.0] {
            let found = both(layout, Domain::open(), &positions, &[-0.2, 0.1], radius);
            let mut indices: Vec<usize> = found.iter().map(|record| record.0).collect();
            indices.dedup();
            assert_eq!(indices.len(), found.len());
        }
        assert_eq!(both(layout, Domain::open(), &positions, &[0.0, 0.0], 100.0).len(), 40);
    }
}

#[test]
fn the_radius_itself_is_out() {
    let radius = 0.5_f32;
    for (distance, within) in [(radius.next_down(), 1), (radius, 0), (radius.next_up(), 0)] {
        for sign in [-1.0, 1.0] {
            let layout = CellLayout::bounded(&[-1.0], &[1.0], [4]).unwrap();
            assert_eq!(both(layout, Domain::open(), &[[sign * distance]], &[0.0], radius).len(), within);
        }
    }
}

#[test]
fn an_image_rounded_onto_the_lower_end_is_found() {
    // 0.49999997 − 100.5 rounds to −100, as −99.5 − 0.50000006 does.
    let sample = [[0.5_f32.next_down()]];
    for count in [1, 8, 201] {
        assert_eq!(on_a_ring([-100.0, 0.5], count, &sample, -99.5, 0.5_f32.next_up()).len(), 1);
    }
}

#[test]
fn an_image_moved_over_several_cells_by_its_rounding_is_found() {
    // Beyond 1024 an f32 moves in steps of eight of these cells.
    let step = 2_f32.powi(-14);
    let sample = [[1023.0 + step]];
    assert_eq!(on_a_ring([1023.0, 1024.0], 1 << 17, &sample, 1024.0 - step, 1.5 * step).len(), 1);
    assert_eq!(on_a_ring([1023.0, 1024.0], 1 << 17, &[[1023.0]], 1024.0 - step, 1.5 * step).len(), 1);
}

#[test]
fn a_thousand_periods_of_narrow_cells_miss_nothing() {
    let positions = [[0.1_f32], [0.2], [0.7]];
    for radius in [999.95, 1000.3, 1234.5] {
        let count = on_a_ring([0.0, 0.7001], 1 << 15, &positions, 0.35, radius).len();
        assert!((count as f32 - 3.0 * 2.0 * radius / 0.7001).abs() < 4.0, "{count}");
    }
}

#[test]
fn a_query_is_wrapped_and_one_that_is_not_finite_finds_nothing() {
    let positions = [[0.25_f64], [0.75]];
    assert_eq!(on_a_ring([0.0, 1.0], 4, &positions, 1e6 + 0.25, 0.1).len(), 1);
    assert_eq!(on_a_ring([0.0, 1.0], 4, &positions, -7.25, 0.1).len(), 1);
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(on_a_ring([0.0, 1.0], 4, &[[0.0], [0.5]], x, 0.75), []);
        let layout = CellLayout::bounded(&[0.0], &[1.0], [4]).unwrap();
        assert_eq!(both(layout, Domain::open(), &positions, &[x], 0.75), []);
    }
}

#[test]
fn a_radius_that_is_not_positive_finds_nothing() {
    let layout = CellLayout::unbounded(1.0_f32, [2, 2]).unwrap();
    for radius in [0.0, -0.0, -1.0, f32::NEG_INFINITY, f32::NAN] {
        assert_eq!(both(layout, Domain::open(), &[[0.0, 0.0]], &[0.0, 0.0], radius), []);
    }
    assert_eq!(both(layout, Domain::open(), &[[0.0, 9.0]], &[0.0, 0.0], f32::INFINITY).len(), 1);
}

#[test]
fn the_orders_are_those_documented() {
    let positions = [[2.5_f32, 0.5], [0.5, 1.5], [1.5, 0.5], [0.5, 0.5], [1.6, 0.4]];
    let order = |search: &dyn Fn(&mut Vec<usize>)| {
        let mut indices = Vec::new();
        search(&mut indices);
        indices
    };
    let brute = BruteForce::new(&positions).unwrap();
    let by_index = order(&|all| brute.for_each(&[1.0, 1.0], 9.0, |neighbour| all.push(neighbour.index)));
    assert_eq!(by_index, [0, 1, 2, 3, 4]);
    let layout = CellLayout::bounded(&[0.0, 0.0], &[3.0, 2.0], [3, 2]).unwrap();
    let (mut starts, mut entries) = ([0_u8; 7], [0_u8; 5]);
    let grid = CellGrid::build(layout, &positions, &mut starts, &mut entries).unwrap();
    let by_cell = order(&|all| grid.for_each(&[1.0, 1.0], 9.0, |neighbour| all.push(neighbour.index)));
    assert_eq!(by_cell, [3, 2, 4, 0, 1]);
    assert_eq!(grid.entries(), [3, 2, 4, 0, 1]);
}

/// Samples near both ends of the range, where x ± r is beyond it.
fn at_the_ends_of_the_range<T: Scalar>() {
    let number = T::from_f64;
    let layouts = [
        CellLayout::unbounded(number(10.0), [7]).unwrap(),
        CellLayout::bounded(&[number(-32_000.0)], &[number(0.0)], [9]).unwrap(),
        CellLayout::bounded(&[number(31_000.0)], &[number(32_000.0)], [9]).unwrap(),
    ];
    for end in [-1.0, 1.0] {
        let positions = [32_760.0, 32_700.0, 32_650.0, 32_500.0, 0.0].map(|x| [number(end * x)]);
        for layout in layouts {
            let found = both(layout, Domain::open(), &positions, &[number(end * 32_705.0)], number(100.0));
            assert_eq!(found.len(), 3);
        }
    }
}

#[test]
fn the_ends_of_a_fixed_point_range_are_searched() {
    at_the_ends_of_the_range::<Saturating<I16F16>>();
    at_the_ends_of_the_range::<Checked<I16F16>>();
}
