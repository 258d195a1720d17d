//! Every sample against every query: the oracle that other searches are held against, and the smallest code.

use super::axis::{image, image_reach};
use super::{Domain, Neighbour, Neighbours};
use crate::{Error, Scalar};

/// Looks at all samples: ascending j, and for each j its images in ascending order, first axis fastest.
#[derive(Clone, Copy, Debug)]
pub struct BruteForce<'a, T, const D: usize> {
    positions: &'a [[T; D]],
    domain: Domain<T, D>,
}

impl<'a, T: Scalar, const D: usize> BruteForce<'a, T, D> {
    /// A search over samples in open space.
    ///
    /// # Errors
    /// [`Error::NotFinite`] with the sample's index.
    pub fn new(positions: &'a [[T; D]]) -> Result<Self, Error> {
        Self::in_domain(positions, Domain::open())
    }

    /// A search over samples in a domain with periodic axes.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutsideDomain`] with the sample's index.
    pub fn in_domain(positions: &'a [[T; D]], domain: Domain<T, D>) -> Result<Self, Error> {
        domain.check(positions)?;
        Ok(Self { positions, domain })
    }
}

impl<T: Scalar, const D: usize> Neighbours<T, D> for BruteForce<'_, T, D> {
    fn positions(&self) -> &[[T; D]] {
        self.positions
    }

    fn for_each(&self, x: &[T; D], radius: T, mut visit: impl FnMut(Neighbour<T, D>)) {
        if !radius.is_above_zero() {
            return;
        }
        let x = self.domain.wrap(x);
        let radius_squared = radius * radius;
        let reach = self.domain.axes().map(|axis| image_reach(&axis, radius));
        for (index, position) in self.positions.iter().enumerate() {
            let mut k = reach.map(|reach| -reach);
            loop {
                let image =
                    core::array::from_fn(|axis| image(&self.domain.axes()[axis], position[axis], k[axis]));
                if let Some(neighbour) = Neighbour::within(index, &x, &image, radius_squared) {
                    visit(neighbour);
                }
                if !advance(&mut k, &reach) {
                    break;
                }
            }
        }
    }
}

/// The next k in −reach … reach, first axis fastest; false after the last.
fn advance<const D: usize>(k: &mut [i32; D], reach: &[i32; D]) -> bool {
    for axis in 0..D {
        if k[axis] < reach[axis] {
            k[axis] += 1;
            return true;
        }
        k[axis] = -reach[axis];
    }
    false
}
