//! Masks and shapes, place by place: what they contain, and where a particle comes to that would leave.

use sph_core::fluid::{Container, Mask, Shape, Wall};

/// Ten pixels of side 1 in each of two rows; in the upper one the first and the last are closed.
const BITS: [u8; 4] = [0xff, 0xc0, 0x7f, 0x80];
const GAP: f64 = 0.125;

fn mask() -> Mask<'static, f64> {
    Mask::new(&BITS, 10, 1.0).unwrap()
}

#[test]
fn a_mask_contains_its_open_pixels() {
    let mask = mask();
    assert_eq!(mask.size(), [10.0, 2.0]);
    for x in [[0.0, 0.0], [9.5, 0.5], [0.5, 0.5], [1.0, 1.0], [8.5, 1.5], [7.5, 1.5], [4.5, 1.5]] {
        assert!(mask.contains(&x), "{x:?}");
    }
    for x in [
        [0.5, 1.5],
        [9.5, 1.5],
        [-0.1, 0.5],
        [10.1, 0.5],
        [10.0, 0.5],
        [0.5, -0.1],
        [5.0, 2.1],
        [5.0, 2.0],
        [f64::NAN, 0.5],
    ] {
        assert!(!mask.contains(&x), "{x:?}");
    }
}

#[test]
fn a_mask_stops_at_the_first_wall_along_each_axis() {
    for (from, to, expected) in [
        ([5.0, 0.5], [5.25, 0.75], [5.25, 0.75]),
        ([0.5, 0.5], [0.5, 1.25], [0.5, 0.875]),
        ([1.5, 1.5], [0.75, 1.5], [1.125, 1.5]),
        ([8.5, 1.5], [9.25, 1.5], [8.875, 1.5]),
        ([0.5, 0.9375], [0.5, 1.25], [0.5, 0.9375]),
        ([5.0, 0.5], [5.0, -1.0], [5.0, 0.0]),
        ([5.0, 0.5], [9.0, 0.5], [6.0, 0.5]),
        ([5.0, 0.5], [1.0, 0.5], [4.0, 0.5]),
        ([5.0, 0.5], [f64::NAN, 0.5], [4.0, 0.5]),
    ] {
        assert_eq!(mask().confine(&from, to, GAP), expected, "{from:?} {to:?}");
    }
}

/// The half above y = 1 of a box of side 4.
fn above_one(x: &[f64; 2]) -> (f64, [f64; 2]) {
    (x[1] - 1.0, [0.0, 1.0])
}

#[test]
fn a_shape_is_where_its_distance_is_positive() {
    let shape = Shape::new([4.0, 4.0], above_one);
    assert_eq!(shape.size(), [4.0, 4.0]);
    for x in [[2.0, 1.5], [0.0, 1.0], [4.0, 4.0]] {
        assert!(shape.contains(&x), "{x:?}");
    }
    for x in [[2.0, 0.5], [2.0, 4.1], [-0.1, 2.0], [4.1, 2.0]] {
        assert!(!shape.contains(&x), "{x:?}");
    }
    for (y, d) in [(1.5, 0.5), (1.0, 0.0), (0.75, 0.0)] {
        assert_eq!(shape.wall(&[2.0, y]), Wall::plane(d, [0.0, 1.0]), "{y}");
    }
    assert_eq!(shape.wall(&[2.0, 2.5]), None);
    let steep = Shape::new([4.0, 4.0], |x: &[f64; 2]| (x[1], [0.0, 7.0]));
    assert_eq!(steep.wall(&[2.0, 0.5]), Wall::plane(0.5, [0.0, 1.0]), "a normal is no longer than 1");
}

#[test]
fn a_shape_puts_back_along_its_normal_or_leaves_where_it_was() {
    let shape = Shape::new([4.0, 4.0], above_one);
    for (to, expected) in [([2.5, 1.25], [2.5, 1.25]), ([2.0, 0.5], [2.0, 1.125]), ([5.0, 2.0], [4.0, 2.0])] {
        assert_eq!(shape.confine(&[2.0, 1.5], to, GAP), expected, "{to:?}");
    }
    let nowhere = Shape::new([4.0, 4.0], |_: &[f64; 2]| (-1.0, [0.0; 2]));
    assert_eq!(nowhere.confine(&[2.0, 1.5], [3.0, 1.0], GAP), [2.0, 1.5]);
}
