//! Neighbour lists.

use proptest::prelude::*;
use sph_host::fast::{InstructionSet, NeighbourLists, Real, SortedCells};

use crate::cloud::{Cloud, clouds};

/// The lists, as indices of the input, are those of a plain double loop, and all levels give the same.
fn check<T: Real, const D: usize>(cloud: &Cloud<T, D>, lists: &mut NeighbourLists) {
    let positions = &cloud.positions;
    let within = |i: usize, j: usize| {
        let mut square = T::ZERO;
        for axis in 0..D {
            let d = positions[i][axis] - positions[j][axis];
            square = if axis == 0 { d * d } else { square + d * d };
        }
        square < cloud.radius * cloud.radius
    };
    for level in InstructionSet::available() {
        let cells = SortedCells::sort(positions, cloud.radius).unwrap().at_level(level);
        cells.neighbour_lists(lists);
        let mut pairs = 0;
        for (place, &i) in cells.order().iter().enumerate() {
            let mut found: Vec<usize> =
                lists.of(place).iter().map(|&place| cells.order()[place as usize] as usize).collect();
            found.sort_unstable();
            let expected: Vec<usize> = (0..positions.len()).filter(|&j| within(i as usize, j)).collect();
            assert_eq!(found, expected, "{level:?} {i}");
            pairs += expected.len();
        }
        assert_eq!(lists.pairs(), pairs);
        assert!(lists.of(positions.len()).is_empty());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn are_those_of_a_double_loop(
        line in clouds::<f64, 1>(), plane in clouds::<f32, 2>(), space in clouds::<f32, 3>(), wide in clouds::<f64, 3>()
    ) {
        // the same lists again and again: nothing of an earlier set may show
        let mut lists = NeighbourLists::new();
        check(&line, &mut lists);
        check(&plane, &mut lists);
        check(&space, &mut lists);
        check(&wide, &mut lists);
    }
}
