//! How a [`CellGrid`](super::CellGrid) divides space: the cell of every point, and the cells in reach of one.
//!
//! The cell of a coordinate is ⌊(x − origin) / cell size⌋. Rounding is monotone, so for |x − x_j| < r the cell of x_j lies
//! between those of x − r and x + r as computed, whatever the rounding and the range of T: no sample is missed, and cells
//! need no margin. An image x_j + k · length is found by the cell of x_j, which is monotone in the image's position but
//! for the few roundings that moved it: periodic axes widen the radius by those.

use core::num::NonZeroU32;

use super::axis::{Axis, Domain, Open, Space, image_reach, is_inside, wrap};
use crate::{Error, Parameter, Scalar, check};

/// How many cells along one axis, how wide, and what happens outside of them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct CellAxis<T> {
    origin: T,
    inverse_size: T,
    pub(super) count: NonZeroU32,
    ends: Ends,
}

/// What lies beyond the cells of an axis. As wide as a register, so that an axis has no padding and is copied word by word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(u32)]
enum Ends {
    /// The outermost cells hold what lies beyond them.
    Clamped,
    /// Cells repeat for ever; each holds the samples of all its repetitions.
    Repeated,
    /// Cells repeat as images of the same samples.
    Periodic,
}

/// Cells beyond this number are one: it keeps sums of cell numbers within i32, and rounding stays monotone.
const FARTHEST: i32 = 1 << 30;

/// The most cells along one axis.
const MOST_CELLS: u32 = 1 << 20;

impl<T: Scalar> CellAxis<T> {
    /// The cell number of a coordinate, before its ends are looked at; what overflows is farthest, and above where
    /// it compares with nothing.
    ///
    /// Six places ask; on a microcontroller they share one copy of the code.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn raw(&self, coordinate: T) -> i32 {
        let number = (coordinate - self.origin) * self.inverse_size;
        if number.is_finite() {
            number.floor_to_i32().clamp(-FARTHEST, FARTHEST)
        } else if coordinate < self.origin {
            -FARTHEST
        } else {
            FARTHEST
        }
    }

    /// The first and last cell number in reach of a coordinate; each number in between is one visit.
    #[inline(always)]
    pub(super) fn range(&self, kind: &Axis<T>, x: T, radius: T) -> (i32, i32) {
        if let Axis::Periodic { length, .. } = *kind {
            return self.periodic_range(kind, length, x, radius);
        }
        let low = x - radius;
        let first = if low.is_finite() { self.raw(low) } else { -FARTHEST };
        let last = self.raw(x + radius);
        let most = self.count.get() as i32 - 1;
        match self.ends {
            Ends::Repeated => (first, last.min(first.saturating_add(most))),
            Ends::Clamped | Ends::Periodic => (first.max(0).min(most), last.max(0).min(most)), // `clamp` could panic
        }
    }

    /// [`range`](Self::range) on a periodic axis, where cell number c + k · count is image k of the cell c.
    ///
    /// The two ends of the interval, the image and the shift back by k periods are rounded seven times in all, each time by
    /// at most ε/2 · 2(|x| + r + length): the radius is widened by 8 ε (|x| + r + length).
    #[inline(always)]
    fn periodic_range(&self, kind: &Axis<T>, length: T, x: T, radius: T) -> (i32, i32) {
        let count = self.count.get() as i32;
        let error = T::EPSILON.times(8);
        let reach = radius + (error * x.abs() + error * radius + error * length);
        let number = |end: T, side: i32| {
            if is_inside(kind, end) {
                return self.raw(end).max(0).min(count - 1);
            }
            let images = image_reach(kind, radius).min((FARTHEST as u32 / self.count) as i32);
            let periods = (end - self.origin) / length;
            let k = if periods.is_finite() { periods.floor_to_i32() } else { side * images };
            let k = k.max(-images).min(images);
            k * count + self.raw(end - length.times(k)).max(0).min(count - 1)
        };
        (number(x - reach, -1), number(x + reach, 1))
    }

    /// The stored cell that a cell number of [`range`](Self::range) stands for, and the image k of its samples.
    #[inline(always)]
    pub(super) fn locate(&self, number: i32) -> (u32, i32) {
        let count = self.count;
        if number >= 0 && (number as u32) < count.get() {
            return (number as u32, 0);
        }
        // floor division and remainder by an unsigned divisor that is never zero
        let (quotient, remainder) = if number >= 0 {
            ((number as u32 / count) as i32, number as u32 % count)
        } else {
            let below = !(number as u32); // −number − 1
            (-1 - (below / count) as i32, count.get() - 1 - below % count)
        };
        (remainder, if self.ends == Ends::Periodic { quotient } else { 0 })
    }

    /// The stored cell that a sample belongs to.
    #[inline(always)]
    fn cell(&self, coordinate: T) -> u32 {
        let number = self.raw(coordinate);
        match self.ends {
            Ends::Repeated => self.locate(number).0,
            Ends::Clamped | Ends::Periodic => number.max(0).min(self.count.get() as i32 - 1) as u32,
        }
    }
}

/// The cells of a grid: `counts` along each axis, first axis fastest.
///
/// ```
/// use sph_core::{CellLayout, Domain};
/// // a box 2 × 1 in cells of 0.1; points beyond it belong to the outermost cells
/// let layout = CellLayout::<f32, 2>::bounded(&[0.0, 0.0], &[2.0, 1.0], [20, 10])?;
/// assert_eq!(layout.cells(), 200);
/// // all of space in 8 × 8 cells that repeat
/// let layout = CellLayout::<f32, 2>::unbounded(0.1, [8, 8])?;
/// assert_eq!(layout.cells(), 64);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CellLayout<T, const D: usize, S = Domain<T, D>> {
    pub(super) axes: [CellAxis<T>; D],
    pub(super) space: S,
}

impl<T: Scalar, const D: usize> CellLayout<T, D> {
    /// Cells between two corners of a box, in open space: what lies outside the box is kept in the outermost cells.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::NotPositive`] with the axis, unless lower < upper and counts > 0;
    /// [`Error::NotRepresentable`] where 1 / cell size or the number of cells is not; [`Error::CapacityExceeded`] for more
    /// than 2²⁰ cells along one axis.
    pub fn bounded(lower: &[T; D], upper: &[T; D], counts: [u32; D]) -> Result<Self, Error> {
        let mut axes = [Self::unit_axis(); D];
        for (axis, slot) in axes.iter_mut().enumerate() {
            check::finite(lower[axis], Parameter::Axis, axis)?;
            let length = upper[axis] - lower[axis];
            *slot = Self::dividing(axis, lower[axis], length, counts[axis], Ends::Clamped)?;
        }
        Self::checked(axes, Domain::open())
    }

    /// Cells of one size that repeat in all directions: no bounds, and no sample is seen twice.
    ///
    /// # Errors
    /// As [`bounded`](Self::bounded), for the cell size.
    pub fn unbounded(cell_size: T, counts: [u32; D]) -> Result<Self, Error> {
        let mut axes = [Self::unit_axis(); D];
        for (axis, slot) in axes.iter_mut().enumerate() {
            check::positive(cell_size, Parameter::Axis, axis)?;
            *slot = Self::axis(axis, T::ZERO, T::ONE / cell_size, counts[axis], Ends::Repeated)?;
        }
        Self::checked(axes, Domain::open())
    }

    /// The same layout, but periodic along `axis`, its `counts` cells dividing the period.
    ///
    /// # Errors
    /// As [`Domain::periodic`] and [`bounded`](Self::bounded).
    pub fn periodic(mut self, axis: usize, lower: T, upper: T) -> Result<Self, Error> {
        self.space = self.space.periodic(axis, lower, upper)?;
        if let Some(slot) = self.axes.get_mut(axis) {
            *slot = Self::dividing(axis, lower, upper - lower, slot.count.get(), Ends::Periodic)?;
        }
        Ok(self)
    }

    /// How space ends along each axis.
    pub const fn domain(&self) -> &Domain<T, D> {
        &self.space
    }

    /// The same cells in space that is known to be open when the program is compiled: a search there is smaller and faster. An
    /// axis that was made periodic becomes a bounded one.
    #[inline(always)]
    pub fn open(self) -> CellLayout<T, D, Open> {
        CellLayout { axes: self.axes, space: Open }
    }

    const fn unit_axis() -> CellAxis<T> {
        CellAxis { origin: T::ZERO, inverse_size: T::ONE, count: NonZeroU32::MIN, ends: Ends::Clamped }
    }

    /// `count` cells that divide `length`.
    fn dividing(axis: usize, origin: T, length: T, count: u32, ends: Ends) -> Result<CellAxis<T>, Error> {
        check::positive(length, Parameter::Axis, axis)?;
        Self::axis(axis, origin, (T::ONE / length).times(count.min(MOST_CELLS) as i32), count, ends)
    }

    fn axis(axis: usize, origin: T, inverse_size: T, count: u32, ends: Ends) -> Result<CellAxis<T>, Error> {
        let parameter = Parameter::Cells;
        let count = NonZeroU32::new(count).ok_or(Error::NotPositive { parameter, index: axis })?;
        if count.get() > MOST_CELLS {
            let (capacity, needed) = (MOST_CELLS as usize, count.get() as usize);
            return Err(Error::CapacityExceeded { parameter, capacity, needed });
        }
        check::representable(inverse_size, Parameter::Axis)?;
        Ok(CellAxis { origin, inverse_size, count, ends })
    }

    fn checked(axes: [CellAxis<T>; D], space: Domain<T, D>) -> Result<Self, Error> {
        let total =
            axes.iter().try_fold(1_usize, |product, axis| product.checked_mul(axis.count.get() as usize));
        match total {
            Some(_) => Ok(Self { axes, space }),
            None => Err(Error::NotRepresentable { parameter: Parameter::Cells }),
        }
    }
}

impl<T: Scalar, const D: usize, S: Space<T, D>> CellLayout<T, D, S> {
    /// The number of cells in all.
    pub fn cells(&self) -> usize {
        self.axes.iter().fold(1, |product: usize, axis| product.wrapping_mul(axis.count.get() as usize))
    }

    /// The point as it lies in the domain, and the first and last cell number in reach of it along each axis.
    ///
    /// Not a part of a query's loop, so all queries share one copy of its code.
    pub(super) fn in_reach(&self, x: &[T; D], radius: T) -> ([T; D], [(i32, i32); D]) {
        let x = wrap(&self.space, x);
        let mut ranges = [(0, 0); D];
        for (axis, (range, (cells, &coordinate))) in
            ranges.iter_mut().zip(self.axes.iter().zip(&x)).enumerate()
        {
            *range = cells.range(&self.space.axis(axis), coordinate, radius);
        }
        (x, ranges)
    }

    /// The number of the cell that a sample at x belongs to.
    #[cfg_attr(target_os = "none", inline(never))]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(super) fn cell_of(&self, x: &[T; D]) -> usize {
        let mut cell = 0_usize;
        for (axis, &coordinate) in self.axes.iter().zip(x).rev() {
            cell = cell.wrapping_mul(axis.count.get() as usize).wrapping_add(axis.cell(coordinate) as usize);
        }
        cell
    }
}
