//! A search behind a reference, so that every sum is compiled once for all searches: the digests of every scalar then fit
//! into the flash of the smallest target.

use sph_core::{Neighbour, Neighbours, Scalar};

/// What [`Neighbours`] is, without its generic method.
pub(crate) trait Search<T, const D: usize> {
    fn samples(&self) -> &[[T; D]];
    fn visit_all(&self, x: &[T; D], radius: T, visit: &mut dyn FnMut(Neighbour<T, D>));
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>> Search<T, D> for N {
    fn samples(&self) -> &[[T; D]] {
        self.positions()
    }

    fn visit_all(&self, x: &[T; D], radius: T, visit: &mut dyn FnMut(Neighbour<T, D>)) {
        self.for_each(x, radius, visit);
    }
}

/// Any search.
#[derive(Clone, Copy)]
pub(crate) struct Erased<'a, T, const D: usize>(pub(crate) &'a dyn Search<T, D>);

impl<T: Scalar, const D: usize> Neighbours<T, D> for Erased<'_, T, D> {
    fn positions(&self) -> &[[T; D]] {
        self.0.samples()
    }

    fn for_each(&self, x: &[T; D], radius: T, mut visit: impl FnMut(Neighbour<T, D>)) {
        self.0.visit_all(x, radius, &mut visit);
    }
}
