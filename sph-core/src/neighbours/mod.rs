//! Which samples lie within a radius of a point.
//!
//! A search visits every sample j with |x − x_j| < radius, each exactly once (each image once, on periodic axes), in the
//! order that it documents: sums taken in that order have the same bits everywhere. The sample at x itself is
//! visited like any other, with offset 0: densities include it, and gradients vanish there.
//!
//! | search | order | cost of a query | storage |
//! |---|---|---|---|
//! | [`BruteForce`], the oracle | ascending j, then ascending image | n | none |
//! | [`CellGrid`] | rows of cells ascending, first axis fastest; ascending j in a cell | samples in the cells in reach | (cells + 1 + n) indices |
//!
//! A search of your own implements [`Neighbours::for_each`] and [`Neighbours::positions`].

mod axis;
mod brute_force;
mod cell_grid;
mod cell_layout;
mod cell_order;
mod index;
mod inline_grid;
mod list;
mod reach;

pub use axis::{Axis, Domain, Open, Space};
pub use brute_force::BruteForce;
pub use cell_grid::CellGrid;
pub use cell_layout::CellLayout;
pub use cell_order::CellOrder;
pub use index::Index;
pub use inline_grid::InlineCellGrid;
pub use list::NeighbourList;

use crate::vector::{norm_squared, sub};
use crate::{Error, Scalar};

/// One sample in reach of a point x.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Neighbour<T, const D: usize> {
    /// j
    pub index: usize,
    /// x − x_j, with the image of x_j that is meant.
    pub offset: [T; D],
    /// |x − x_j|²
    pub distance_squared: T,
}

impl<T: Scalar, const D: usize> Neighbour<T, D> {
    /// The neighbour at `position`, if |x − x_j|² < `radius_squared`, squares and sum in T: what the searches of
    /// this module decide by. Squares that overflow or vanish in T decide too: f32 sees nothing within 10⁻³⁰, not even the sample at x.
    #[inline(always)]
    pub fn within(index: usize, x: &[T; D], position: &[T; D], radius_squared: T) -> Option<Self> {
        let offset = sub(x, position);
        let distance_squared = norm_squared(&offset);
        (distance_squared < radius_squared).then_some(Self { index, offset, distance_squared })
    }
}

/// A search over a set of samples.
///
/// ```
/// use sph_core::{BruteForce, Neighbours};
/// let positions = [[0.0_f32, 0.0], [0.3, 0.0], [2.0, 0.0]];
/// let search = BruteForce::new(&positions)?;
/// let mut found = [false; 3];
/// search.for_each(&[0.1, 0.0], 1.0, |neighbour| found[neighbour.index] = true);
/// assert_eq!(found, [true, true, false]);
/// # Ok::<(), sph_core::Error>(())
/// ```
///
/// The smallest one of your own. [`Neighbour::within`] decides as the searches of this crate do:
///
/// ```
/// use sph_core::{KernelInfluence, Neighbour, Neighbours, Scalar, Sources, Uniform, kernel::WendlandC2};
///
/// /// Samples on a line, in ascending order.
/// #[derive(Clone, Copy)]
/// struct Sorted<'a, T>(&'a [[T; 1]]);
///
/// impl<T: Scalar> Neighbours<T, 1> for Sorted<'_, T> {
///     fn positions(&self) -> &[[T; 1]] {
///         self.0
///     }
///     fn for_each(&self, x: &[T; 1], radius: T, mut visit: impl FnMut(Neighbour<T, 1>)) {
///         if radius > T::ZERO {
///             let first = self.0.partition_point(|position| position[0] <= x[0] - radius);
///             for (j, position) in self.0.iter().enumerate().skip(first) {
///                 match Neighbour::within(j, x, position, radius * radius) {
///                     Some(neighbour) => visit(neighbour),
///                     None if position[0] > x[0] => break,
///                     None => {}
///                 }
///             }
///         }
///     }
/// }
///
/// let sources = Sources::new(Sorted(&[[0.0_f64], [0.3], [0.4], [2.0]]), Uniform(1.0))?;
/// assert_eq!(sources.positions().len(), 4);
/// let w = KernelInfluence::<f64, 1, WendlandC2>::new(0.5)?;
/// assert_eq!(sources.density_at(&w, &[2.0]), w.normalisation());
/// # Ok::<(), sph_core::Error>(())
/// ```
pub trait Neighbours<T: Scalar, const D: usize> {
    /// The samples' positions x_j.
    fn positions(&self) -> &[[T; D]];

    /// Visits every sample with |x − x_j| < `radius`. Visits none for a radius that is not greater than zero.
    fn for_each(&self, x: &[T; D], radius: T, visit: impl FnMut(Neighbour<T, D>));

    /// How many samples are within the radius.
    fn count(&self, x: &[T; D], radius: T) -> usize {
        let mut count = 0;
        self.for_each(x, radius, |_| count += 1);
        count
    }

    /// The indices of the samples within the radius, in the order of the visits.
    ///
    /// # Errors
    /// [`Error::CapacityExceeded`] with the number needed: of [`Neighbours`](crate::Parameter::Neighbours), when there are
    /// more than CAP; of [`Position`](crate::Parameter::Position)s, when I is too narrow for the index of one of them.
    fn list<const CAP: usize, I: Index>(
        &self,
        x: &[T; D],
        radius: T,
    ) -> Result<NeighbourList<CAP, I>, Error> {
        let mut list = NeighbourList::new();
        let (mut needed, mut largest) = (0, 0);
        self.for_each(x, radius, |neighbour| {
            needed += 1;
            largest = neighbour.index.max(largest);
            list.push_if_room(neighbour.index);
        });
        list.complete(needed, largest)
    }
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>> Neighbours<T, D> for &N {
    #[inline(always)]
    fn positions(&self) -> &[[T; D]] {
        (**self).positions()
    }

    #[inline(always)]
    fn for_each(&self, x: &[T; D], radius: T, visit: impl FnMut(Neighbour<T, D>)) {
        (**self).for_each(x, radius, visit);
    }
}
