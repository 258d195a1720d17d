//! The neighbours of one point, found once and summed over many times.

use sph_core::{Neighbour, Neighbours, Scalar};

/// A search that knows the answer for one point and one radius, in the order in which another search found it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gathered<'a, T, const D: usize> {
    pub(super) positions: &'a [[T; D]],
    pub(super) neighbours: &'a [Neighbour<T, D>],
}

impl<T: Scalar, const D: usize> Neighbours<T, D> for Gathered<'_, T, D> {
    fn positions(&self) -> &[[T; D]] {
        self.positions
    }

    #[inline]
    fn for_each(&self, _: &[T; D], _: T, mut visit: impl FnMut(Neighbour<T, D>)) {
        for neighbour in self.neighbours {
            visit(*neighbour);
        }
    }
}
