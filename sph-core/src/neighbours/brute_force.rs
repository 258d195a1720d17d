//! Every sample against every query: the oracle that other searches are held against, and the smallest code.

use super::axis::{self, image, image_reach};
use super::{Domain, Neighbour, Neighbours, Open, Space};
use crate::{Error, Scalar};

/// Looks at all samples: ascending j, and for each j its images in ascending order, first axis fastest.
#[derive(Clone, Copy, Debug)]
pub struct BruteForce<'a, T, const D: usize, S = Domain<T, D>> {
    positions: &'a [[T; D]],
    space: S,
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
        Self::in_space(positions, domain)
    }
}

impl<'a, T: Scalar, const D: usize> BruteForce<'a, T, D, Open> {
    /// As [`new`](BruteForce::new), without code for periodic axes.
    ///
    /// # Errors
    /// [`Error::NotFinite`] with the sample's index.
    pub fn open(positions: &'a [[T; D]]) -> Result<Self, Error> {
        Self::in_space(positions, Open)
    }
}

impl<'a, T: Scalar, const D: usize, S: Space<T, D>> BruteForce<'a, T, D, S> {
    fn in_space(positions: &'a [[T; D]], space: S) -> Result<Self, Error> {
        axis::check(&space, positions)?;
        Ok(Self { positions, space })
    }
}

impl<T: Scalar, const D: usize, S: Space<T, D>> Neighbours<T, D> for BruteForce<'_, T, D, S> {
    fn positions(&self) -> &[[T; D]] {
        self.positions
    }

    #[inline]
    fn for_each(&self, x: &[T; D], radius: T, mut visit: impl FnMut(Neighbour<T, D>)) {
        if !radius.is_above_zero() {
            return;
        }
        let x = axis::wrap(&self.space, x);
        let radius_squared = radius * radius;
        let reach: [i32; D] = core::array::from_fn(|axis| image_reach(&self.space.axis(axis), radius));
        for (index, position) in self.positions.iter().enumerate() {
            let mut k = reach.map(|reach| -reach);
            loop {
                let image =
                    core::array::from_fn(|axis| image(&self.space.axis(axis), position[axis], k[axis]));
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

/// The number of samples, not each of them.
#[cfg(feature = "defmt")]
impl<T, const D: usize, S: defmt::Format> defmt::Format for BruteForce<'_, T, D, S> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "BruteForce of {=usize} samples in {}", self.positions.len(), self.space);
    }
}
