//! What the searches refuse, and how they say so.

use sph_core::{BruteForce, CellGrid, CellLayout, Domain, Error, InlineCellGrid, Neighbours, Parameter};

const AXIS: Parameter = Parameter::Axis;
const CELLS: Parameter = Parameter::Cells;

fn unit_cells() -> CellLayout<f32, 1> {
    CellLayout::bounded(&[0.0], &[4.0], [4]).unwrap()
}

#[test]
fn positions_that_are_not_finite_or_outside_are_named() {
    let ring = unit_cells().periodic(0, 0.0, 4.0).unwrap();
    let domain = Domain::open().periodic(0, 0.0, 4.0).unwrap();
    let not_finite = Error::NotFinite { parameter: Parameter::Position, index: 2 };
    let outside = Error::OutsideDomain { index: 2, axis: 0 };
    let cases = [
        (f32::NAN, not_finite),
        (f32::INFINITY, not_finite),
        (f32::NEG_INFINITY, not_finite),
        (4.0, outside),
        (-f32::MIN_POSITIVE, outside),
    ];
    for (coordinate, error) in cases {
        let positions = [[1.0], [0.0], [coordinate]];
        assert_eq!(BruteForce::in_domain(&positions, domain).unwrap_err(), error);
        let (mut starts, mut entries) = ([0_u8; 5], [0_u8; 3]);
        assert_eq!(CellGrid::build(ring, &positions, &mut starts, &mut entries).unwrap_err(), error);
        let inline = InlineCellGrid::<u16, 5, 3>::new().build(ring, &positions).map(|_| ());
        assert_eq!(inline, Err(error));
    }
    assert!(BruteForce::in_domain(&[[0.0], [4.0_f32.next_down()]], domain).is_ok());
    let second = [[0.0, 0.0], [0.0, 9.0]];
    let along_second = Domain::<f64, 2>::open().periodic(1, 0.0, 1.0).unwrap();
    let error = BruteForce::in_domain(&second, along_second).unwrap_err();
    assert_eq!(error, Error::OutsideDomain { index: 1, axis: 1 });
}

#[test]
fn short_storage_is_refused_with_the_length_needed() {
    let positions = [[0.5_f32], [1.5], [9.0]];
    let full = |parameter, capacity, needed| Some(Error::CapacityExceeded { parameter, capacity, needed });
    let build = |starts: usize, entries: usize| {
        let (mut starts, mut entries) = (vec![9_u8; starts], vec![9_u8; entries]);
        CellGrid::build(unit_cells(), &positions, &mut starts, &mut entries).err()
    };
    assert_eq!(build(5, 3), None);
    assert_eq!(build(4, 3), full(CELLS, 3, 4));
    assert_eq!(build(0, 3), full(CELLS, 0, 4));
    assert_eq!(build(5, 2), full(Parameter::Entries, 2, 3));
    assert_eq!(build(5, 0), full(Parameter::Entries, 0, 3));
    let mut tiny = InlineCellGrid::<u8, 0, 0>::default();
    assert_eq!(tiny.build(unit_cells(), &positions).err(), full(CELLS, 0, 4));
}

#[test]
fn an_index_type_too_narrow_is_refused() {
    let positions = vec![[0.5_f32]; 256];
    let (mut starts, mut entries) = ([0_u8; 5], [0_u8; 300]);
    let grid = CellGrid::build(unit_cells(), &positions[..255], &mut starts, &mut entries).unwrap();
    assert_eq!(grid.count(&[0.5], 0.1), 255);
    let refused = CellGrid::build(unit_cells(), &positions, &mut starts, &mut entries).unwrap_err();
    assert_eq!(
        refused,
        Error::CapacityExceeded { parameter: Parameter::Entries, capacity: 255, needed: 256 }
    );

    let many = vec![[0.5_f32]; 65_536];
    let (mut starts, mut entries) = ([0_u16; 5], vec![0_u16; 65_536]);
    assert!(CellGrid::build(unit_cells(), &many[..65_535], &mut starts, &mut entries).is_ok());
    let refused = CellGrid::build(unit_cells(), &many, &mut starts, &mut entries).unwrap_err();
    assert!(matches!(refused, Error::CapacityExceeded { capacity: 65_535, needed: 65_536, .. }));
}

#[test]
fn a_list_says_what_was_full() {
    let mut positions = vec![[9.0_f32]; 301];
    positions[255] = [0.0];
    let search = BruteForce::new(&positions).unwrap();
    assert_eq!(search.list::<4, u8>(&[0.0], 1.0).unwrap().as_slice(), [255]);
    assert_eq!(search.list::<4, u8>(&[0.0], 0.0).unwrap().len(), 0);
    let full = |parameter, capacity, needed| Error::CapacityExceeded { parameter, capacity, needed };
    let crowded = search.list::<300, u16>(&[0.0], 10.0).unwrap_err();
    assert_eq!(crowded, full(Parameter::Neighbours, 300, 301));
    assert!(search.list::<301, u16>(&[0.0], 10.0).unwrap().iter().eq(0..301));

    positions[300] = [0.0];
    let search = BruteForce::new(&positions).unwrap();
    let too_wide = search.list::<4, u8>(&[0.0], 1.0).unwrap_err();
    assert_eq!(too_wide, full(Parameter::Position, 256, 301));
    assert_eq!(search.list::<1, u8>(&[0.0], 1.0).unwrap_err(), full(Parameter::Neighbours, 1, 2));
}

#[test]
fn layouts_without_cells_or_lengths_are_refused() {
    let not_positive = |parameter, index| Err(Error::NotPositive { parameter, index });
    let not_finite = |index| Err(Error::NotFinite { parameter: AXIS, index });
    let bounded =
        |upper, count| CellLayout::<f32, 2>::bounded(&[0.0; 2], &[1.0, upper], [1, count]).map(|_| ());
    let unbounded = |size, count| CellLayout::<f32, 2>::unbounded(size, [1, count]).map(|_| ());
    let periodic = |axis, lower, upper| {
        CellLayout::<f32, 2>::unbounded(1.0, [2, 2]).unwrap().periodic(axis, lower, upper).map(|_| ())
    };
    assert_eq!(bounded(1.0, 0), not_positive(CELLS, 1));
    assert_eq!(unbounded(1.0, 0), not_positive(CELLS, 1));
    assert_eq!(bounded(0.0, 1), not_positive(AXIS, 1));
    assert_eq!(bounded(-1.0, 1), not_positive(AXIS, 1));
    assert_eq!(bounded(f32::NAN, 1), not_finite(1));
    assert_eq!(bounded(f32::INFINITY, 1), not_finite(1));
    assert_eq!(unbounded(0.0, 1), not_positive(AXIS, 0));
    assert_eq!(unbounded(-0.5, 1), not_positive(AXIS, 0));
    assert_eq!(unbounded(f32::NAN, 1), not_finite(0));
    assert_eq!(periodic(1, 1.0, 1.0), not_positive(AXIS, 1));
    assert_eq!(periodic(1, 1.0, 0.0), not_positive(AXIS, 1));
    assert_eq!(periodic(2, 0.0, 1.0), not_positive(AXIS, 2));
    assert_eq!(periodic(0, f32::NAN, 1.0), not_finite(0));
    assert_eq!(periodic(0, 0.0, f32::MAX), Err(Error::NotRepresentable { parameter: AXIS }));
    assert_eq!(unbounded(1e-40, 1), Err(Error::NotRepresentable { parameter: AXIS }));
}

#[test]
fn more_cells_than_can_be_numbered_are_refused() {
    let most = 1 << 20;
    let layout = CellLayout::<f32, 4>::unbounded(1.0, [most; 4]);
    assert_eq!(layout.unwrap_err(), Error::NotRepresentable { parameter: CELLS });
    let layout = CellLayout::<f32, 1>::unbounded(1.0, [most + 1]).unwrap_err();
    let (capacity, needed) = (most as usize, most as usize + 1);
    assert_eq!(layout, Error::CapacityExceeded { parameter: CELLS, capacity, needed });
    let layout = CellLayout::<f32, 3>::unbounded(1.0, [most; 3]).unwrap();
    let refused = CellGrid::build(layout, &[], &mut [0_u8; 9], &mut []).unwrap_err();
    assert_eq!(refused, Error::CapacityExceeded { parameter: CELLS, capacity: 8, needed: 1 << 60 });
}

#[test]
fn no_samples_have_no_neighbours() {
    let (mut starts, mut entries) = ([7_u8; 5], [7_u8; 0]);
    let grid = CellGrid::build(unit_cells(), &[], &mut starts, &mut entries).unwrap();
    assert_eq!(grid.count(&[0.5], f32::INFINITY), 0);
    assert!(grid.entries().is_empty() && grid.positions().is_empty());
    assert_eq!(BruteForce::<f64, 3>::new(&[]).unwrap().count(&[0.0; 3], 1.0), 0);
}
