//! Both searches: they agree, respect periods, and say when something is full.

#![no_std]
#![no_main]

use fluisim_firmware as _;
use sph_core::{
    BruteForce, CellGrid, CellLayout, Domain, Error, InlineCellGrid, NeighbourList, Neighbours, Parameter,
};

const SAMPLES: usize = 60;

/// Samples from integers, in a box 2 × 2 about the origin.
fn samples() -> [[f32; 2]; SAMPLES] {
    let mut state = 7_u32;
    [(); SAMPLES].map(|()| {
        [(); 2].map(|()| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) as f32 / 32_768.0 - 1.0
        })
    })
}

/// Whether two searches find the same samples around many points.
fn agree(a: impl Neighbours<f32, 2>, b: impl Neighbours<f32, 2>, radius: f32) -> bool {
    a.positions().iter().all(|x| {
        let (mut found, mut expected) = ([0_u8; SAMPLES], [0_u8; SAMPLES]);
        a.for_each(x, radius, |neighbour| found[neighbour.index] += 1);
        b.for_each(x, radius, |neighbour| expected[neighbour.index] += 1);
        found == expected && a.count(x, radius) == b.count(x, radius)
    })
}

#[defmt_test::tests]
mod tests {
    use super::*;
    use defmt::{assert, assert_eq};

    #[test]
    fn a_bounded_grid_finds_what_brute_force_finds() {
        let positions = samples();
        let layout = CellLayout::bounded(&[-0.5, -0.5], &[0.5, 0.5], [4, 5]).unwrap();
        let (mut starts, mut entries) = ([0_u16; 21], [0_u16; SAMPLES]);
        let grid = CellGrid::build(layout, &positions, &mut starts, &mut entries).unwrap();
        assert!(agree(grid, BruteForce::new(&positions).unwrap(), 0.3));
        assert_eq!(grid.entries().len(), SAMPLES);
    }

    #[test]
    fn an_unbounded_grid_finds_each_sample_once() {
        let positions = samples();
        let mut storage = InlineCellGrid::<u8, 10, SAMPLES>::new();
        let grid = storage.build(CellLayout::unbounded(0.25, [3, 3]).unwrap(), &positions).unwrap();
        assert!(agree(grid, BruteForce::new(&positions).unwrap(), 0.9));
    }

    #[test]
    fn a_periodic_grid_finds_every_image() {
        let positions = samples();
        let domain = Domain::open().periodic(0, -1.0, 1.0).unwrap();
        let layout = CellLayout::bounded(&[-1.0, -1.0], &[1.0, 1.0], [8, 8]).unwrap();
        let mut storage = InlineCellGrid::<u8, 65, SAMPLES>::new();
        let grid = storage.build(layout.periodic(0, -1.0, 1.0).unwrap(), &positions).unwrap();
        let brute = BruteForce::in_domain(&positions, domain).unwrap();
        assert!(agree(grid, brute, 0.4));
        assert!(
            brute.count(&[0.99, 0.0], 0.4) > BruteForce::new(&positions).unwrap().count(&[0.99, 0.0], 0.4)
        );
    }

    #[test]
    fn a_sample_at_the_radius_is_outside() {
        let positions = [[0.0_f32, 0.0], [0.5, 0.0]];
        assert_eq!(BruteForce::new(&positions).unwrap().count(&[0.0, 0.0], 0.5), 1);
    }

    #[test]
    fn a_full_list_says_how_much_is_needed() {
        let positions = samples();
        let search = BruteForce::new(&positions).unwrap();
        let list: NeighbourList<SAMPLES, u8> = search.list(&[0.0, 0.0], 9.0).unwrap();
        assert_eq!(list.len(), SAMPLES);
        assert!(list.iter().eq(0..SAMPLES) && !list.is_empty() && list.as_slice().len() == SAMPLES);
        let full = search.list::<4, u8>(&[0.0, 0.0], 9.0).unwrap_err();
        let (capacity, needed) = (4, SAMPLES);
        assert_eq!(full, Error::CapacityExceeded { parameter: Parameter::Neighbours, capacity, needed });
    }

    #[test]
    fn a_full_grid_says_how_much_is_needed() {
        let positions = samples();
        let layout = CellLayout::unbounded(0.25, [3, 3]).unwrap();
        let few_cells = InlineCellGrid::<u8, 9, SAMPLES>::new().build(layout, &positions).err();
        let (capacity, needed) = (8, 9);
        assert_eq!(
            few_cells,
            Some(Error::CapacityExceeded { parameter: Parameter::Cells, capacity, needed })
        );
        let few_entries = InlineCellGrid::<u8, 10, 59>::new().build(layout, &positions).err();
        let (capacity, needed) = (59, SAMPLES);
        assert_eq!(
            few_entries,
            Some(Error::CapacityExceeded { parameter: Parameter::Entries, capacity, needed })
        );
    }

    #[test]
    fn bad_positions_are_refused() {
        let parameter = Parameter::Position;
        let refused = BruteForce::new(&[[0.0_f32], [f32::NAN]]).err();
        assert_eq!(refused, Some(Error::NotFinite { parameter, index: 1 }));
        let domain = Domain::<f32, 1>::open().periodic(0, 0.0, 1.0).unwrap();
        let refused = BruteForce::in_domain(&[[1.0]], domain).err();
        assert_eq!(refused, Some(Error::OutsideDomain { index: 0, axis: 0 }));
        assert_eq!(domain.wrap(&[1.25]), [0.25]);
    }

    #[test]
    fn memory_is_what_the_type_says() {
        assert_eq!(size_of::<InlineCellGrid<u8, 65, 128>>(), 65 + 128);
        assert_eq!(size_of::<InlineCellGrid<u16, 65, 128>>(), 2 * (65 + 128));
    }
}
