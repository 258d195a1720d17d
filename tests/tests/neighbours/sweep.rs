//! A search of one's own through the same trait: samples sorted along the first axis, and a sweep over those in reach.

use sph_core::{Error, Neighbour, NeighbourList, Neighbours, Scalar};

/// Open space; order: ascending first coordinate, then ascending j.
pub(crate) struct Sweep<'a, T, const D: usize> {
    positions: &'a [[T; D]],
    order: Vec<usize>,
}

impl<'a, T: Scalar, const D: usize> Sweep<'a, T, D> {
    pub(crate) fn new(positions: &'a [[T; D]]) -> Self {
        let mut order: Vec<usize> = (0..positions.len()).collect();
        order.sort_by(|&i, &j| positions[i][0].partial_cmp(&positions[j][0]).unwrap());
        Self { positions, order }
    }
}

impl<T: Scalar, const D: usize> Neighbours<T, D> for Sweep<'_, T, D> {
    fn positions(&self) -> &[[T; D]] {
        self.positions
    }

    fn for_each(&self, x: &[T; D], radius: T, visit: impl FnMut(Neighbour<T, D>)) {
        let (low, high) = (x[0] - radius, x[0] + radius);
        // Written so that an end which overflowed, and compares with nothing, excludes nothing.
        let beyond = |j: usize| self.positions[j][0] > high;
        let first = self.order.partition_point(|&j| self.positions[j][0] < low);
        if radius > T::ZERO {
            let in_reach = self.order[first..].iter().take_while(|&&j| !beyond(j));
            let near = |&j: &usize| Neighbour::within(j, x, &self.positions[j], radius * radius);
            in_reach.filter_map(near).for_each(visit);
        }
    }
}

#[test]
fn the_trait_gives_a_search_of_ones_own_the_rest() {
    let positions = [[0.4_f32, 0.0], [0.0, 0.0], [0.1, 0.1], [0.0, 3.0]];
    let sweep = Sweep::new(&positions);
    assert_eq!(sweep.count(&[0.0, 0.0], 0.3), 2);
    let borrowed: NeighbourList<3, u8> = Neighbours::list(&&sweep, &[0.0, 0.0], 0.5).unwrap();
    assert_eq!(borrowed.as_slice(), [1, 2, 0]);
    let full = sweep.list::<1, u8>(&[0.0, 0.0], 0.5);
    assert!(matches!(full, Err(Error::CapacityExceeded { capacity: 1, needed: 3, .. })));
}
