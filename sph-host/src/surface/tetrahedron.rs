//! A tetrahedron of a box, and how a surface crosses it.
//!
//! Corners of a box are numbered by their bits: bit 0 is set on the upper side along x, bit 1 along y, bit 2 along z.

/// The orders of axes in which a path goes from corner 0 to corner 7; those of right-handed tetrahedra first.
const ORDERS: [([u8; 3], bool); 6] = [
    ([0, 1, 2], true),
    ([1, 2, 0], true),
    ([2, 0, 1], true),
    ([0, 2, 1], false),
    ([2, 1, 0], false),
    ([1, 0, 2], false),
];

/// An even order a, b, c, d of a tetrahedron's corners for each set of corners inside (bit k is corner k): a is the one that is alone
/// on its side, or a and b are the two inside.
const EVEN: [[usize; 4]; 16] = [
    [0, 1, 2, 3],
    [0, 1, 2, 3],
    [1, 0, 3, 2],
    [0, 1, 2, 3],
    [2, 0, 1, 3],
    [0, 2, 3, 1],
    [1, 2, 0, 3],
    [3, 2, 1, 0],
    [3, 2, 1, 0],
    [0, 3, 1, 2],
    [1, 3, 2, 0],
    [2, 0, 1, 3],
    [2, 3, 0, 1],
    [1, 0, 3, 2],
    [0, 1, 2, 3],
    [0, 1, 2, 3],
];

/// One of the six tetrahedra of a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tetrahedron {
    /// Corners of the box, along the path.
    pub(super) corners: [u8; 4],
    is_right_handed: bool,
}

/// An edge of a tetrahedron, by corners of the box.
pub(super) type Edge = (u8, u8);

impl Tetrahedron {
    /// The six that fill a box.
    pub(super) fn all() -> [Self; 6] {
        ORDERS.map(|([i, j, _], is_right_handed)| {
            let corners = [0, 1 << i, 1 << i | 1 << j, 7];
            Self { corners, is_right_handed }
        })
    }

    /// Which of the corners are in a set of the box's corners.
    pub(super) fn among(&self, set: u8) -> u8 {
        (0..4).filter(|&k| set >> self.corners[k] & 1 == 1).fold(0, |bits, k| bits | 1 << k)
    }

    /// The edges that a surface crosses where the corners `inside` are on its inner side, counter-clockwise as seen from outside: none,
    /// three or four.
    pub(super) fn crossed(&self, inside: u8) -> ([Edge; 4], usize) {
        let [a, b, c, d] = EVEN[usize::from(inside & 15)].map(|k| self.corners[k]);
        let (mut edges, count) = match (inside & 15).count_ones() {
            1 => ([(a, b), (a, c), (a, d), (a, b)], 3),
            2 => ([(a, c), (a, d), (b, d), (b, c)], 4),
            3 => ([(a, b), (a, d), (a, c), (a, b)], 3),
            _ => ([(a, b); 4], 0),
        };
        if !self.is_right_handed {
            edges[..count].reverse();
        }
        (edges, count)
    }

    /// For each face that the surface crosses, the corner that the tetrahedron on its other side has there, in steps along each axis
    /// from corner 0 of the box.
    pub(super) fn beyond(&self, inside: u8) -> impl Iterator<Item = [isize; 3]> {
        let path = self.corners.map(|corner| [0, 1, 2].map(|axis| isize::from(corner >> axis & 1)));
        let crosses_face = move |&k: &usize| {
            let face = 15 & !(1 << k);
            !matches!(inside & face, rest if rest == 0 || rest == face)
        };
        // the neighbour across the face without corner k goes the other way round the square of k's neighbours on the path
        (0..4).filter(crosses_face).map(move |k| {
            let (before, after) = (path[(k + 3) % 4], path[(k + 1) % 4]);
            std::array::from_fn(|axis| before[axis] + after[axis] - path[k][axis])
        })
    }
}
