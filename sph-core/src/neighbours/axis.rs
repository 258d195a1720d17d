//! Whether space is open or periodic along each axis.

use crate::{Error, Parameter, Scalar, check};
use core::fmt::Debug;

/// One axis of a [`Domain`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Axis<T> {
    /// Open on both sides. Samples may lie anywhere.
    Open,
    /// Periodic from `lower` with period `length`: x and x + `length` are the same point.
    Periodic {
        /// Where the period starts.
        lower: T,
        /// The period.
        length: T,
    },
}

/// D axes, each open or periodic.
///
/// On a periodic axis samples lie in [lower, lower + length), checked when a search is made; [`wrap`](Self::wrap) brings them
/// there. A query may lie anywhere and is wrapped first. Every image x_j + k · length within the radius counts, however large
/// the radius: the time of a query grows with their number. An image's position is the sum in T of x_j and the product in T
/// of k and the length, so a search with periodic axes gives the very bits of one over an explicit copy of the images.
///
/// ```
/// use sph_core::Domain;
/// let tube = Domain::<f32, 2>::open().periodic(0, 0.0, 1.0)?; // periodic along x, open along y
/// assert_eq!(tube.wrap(&[1.25, 7.0]), [0.25, 7.0]);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Domain<T, const D: usize> {
    axes: [Axis<T>; D],
}

impl<T: Scalar, const D: usize> Domain<T, D> {
    /// Open along every axis.
    pub const fn open() -> Self {
        Self { axes: [Axis::Open; D] }
    }

    /// The same domain, but periodic along `axis`.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for bounds that are not, [`Error::NotPositive`] unless lower < upper and `axis` < D; both with
    /// the axis as index. [`Error::NotRepresentable`] where the period's images at its two ends leave the range of T.
    pub fn periodic(mut self, axis: usize, lower: T, upper: T) -> Result<Self, Error> {
        check::finite(lower, Parameter::Axis, axis)?;
        check::finite(upper, Parameter::Axis, axis)?;
        let length = upper - lower;
        check::positive(length, Parameter::Axis, axis)?;
        let images = [lower - length, upper + length];
        if !(images.iter().all(|end| end.is_finite()) && images[0] < lower && upper < images[1]) {
            return Err(Error::NotRepresentable { parameter: Parameter::Axis });
        }
        let slot =
            self.axes.get_mut(axis).ok_or(Error::NotPositive { parameter: Parameter::Axis, index: axis })?;
        *slot = Axis::Periodic { lower, length };
        Ok(self)
    }

    /// The axes.
    pub const fn axes(&self) -> &[Axis<T>; D] {
        &self.axes
    }

    /// The image of x that lies in [lower, lower + length) along every periodic axis. What is not finite stays so; what is
    /// 2³¹ periods away or farther becomes `lower`.
    pub fn wrap(&self, x: &[T; D]) -> [T; D] {
        wrap(self, x)
    }
}

/// Open along every axis, known when the program is compiled: a search in it holds no code for periodic axes.
///
/// ```
/// use sph_core::{BruteForce, CellLayout, Neighbours, Open};
/// let samples = [[0.0_f32, 0.0], [0.5, 0.0]];
/// assert_eq!(BruteForce::open(&samples)?.count(&[0.1, 0.0], 0.2), 1);
/// let layout: CellLayout<f32, 2, Open> = CellLayout::unbounded(0.2, [4, 4])?.open();
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Open;

/// How space ends, as a search asks for it: a [`Domain`] knows when the program runs, [`Open`] when it is compiled.
pub trait Space<T, const D: usize>: Copy + Debug + Send + Sync {
    /// How it ends along one axis.
    fn axis(&self, axis: usize) -> Axis<T>;
}

impl<T: Scalar, const D: usize> Space<T, D> for Domain<T, D> {
    #[inline(always)]
    fn axis(&self, axis: usize) -> Axis<T> {
        self.axes.get(axis).copied().unwrap_or(Axis::Open)
    }
}

impl<T: Scalar, const D: usize> Space<T, D> for Open {
    #[inline(always)]
    fn axis(&self, _: usize) -> Axis<T> {
        Axis::Open
    }
}

/// [`Domain::wrap`] in any space.
#[inline(always)]
pub(super) fn wrap<T: Scalar, const D: usize>(space: &impl Space<T, D>, x: &[T; D]) -> [T; D] {
    let mut wrapped = *x;
    for (axis, coordinate) in wrapped.iter_mut().enumerate() {
        *coordinate = wrap_along(&space.axis(axis), *coordinate);
    }
    wrapped
}

/// Every coordinate is finite, and inside on periodic axes.
pub(super) fn check<T: Scalar, const D: usize>(
    space: &impl Space<T, D>,
    positions: &[[T; D]],
) -> Result<(), Error> {
    for (index, position) in positions.iter().enumerate() {
        for (axis, &coordinate) in position.iter().enumerate() {
            check::finite(coordinate, Parameter::Position, index)?;
            if !is_inside(&space.axis(axis), coordinate) {
                return Err(Error::OutsideDomain { index, axis });
            }
        }
    }
    Ok(())
}

/// x_j + k · length; x_j itself for k = 0.
#[inline(always)]
pub(super) fn image<T: Scalar>(kind: &Axis<T>, coordinate: T, k: i32) -> T {
    match *kind {
        Axis::Periodic { length, .. } if k != 0 => coordinate + length.times(k),
        _ => coordinate,
    }
}

/// The images k = −reach … reach that can lie within the radius of a point inside the period; 0 on an open axis.
#[inline(always)]
pub(super) fn image_reach<T: Scalar>(kind: &Axis<T>, radius: T) -> i32 {
    match *kind {
        Axis::Open => 0,
        Axis::Periodic { length, .. } => (radius / length).floor_to_i32().saturating_add(2),
    }
}

#[inline(always)]
pub(super) fn is_inside<T: Scalar>(kind: &Axis<T>, coordinate: T) -> bool {
    match *kind {
        Axis::Open => true,
        Axis::Periodic { lower, length } => coordinate >= lower && coordinate < lower + length,
    }
}

#[inline(always)]
fn wrap_along<T: Scalar>(kind: &Axis<T>, coordinate: T) -> T {
    match *kind {
        Axis::Open => coordinate,
        Axis::Periodic { lower, length } => wrap_into(lower, length, coordinate),
    }
}

fn wrap_into<T: Scalar>(lower: T, length: T, coordinate: T) -> T {
    let kind = &Axis::Periodic { lower, length };
    if is_inside(kind, coordinate) || !coordinate.is_finite() {
        return coordinate;
    }
    let periods = ((coordinate - lower) / length).floor_to_i32();
    let near = coordinate - length.times(periods);
    // A quotient rounded across an integer is one period off. Rounding may still leave the upper end, which is the lower.
    [near, near + length, near - length].into_iter().find(|&x| is_inside(kind, x)).unwrap_or(lower)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wraps_into_the_half_open_period() {
        let domain = Domain::<f64, 1>::open().periodic(0, -1.0, 2.0).unwrap();
        for (x, wrapped) in [(-1.0, -1.0), (2.0, -1.0), (0.5, 0.5), (-4.5, 1.5), (8.25, -0.75)] {
            assert_eq!(domain.wrap(&[x]), [wrapped], "{x}");
        }
        let tiny = domain.wrap(&[-1.0 - 1e-300])[0];
        assert!((-1.0..2.0).contains(&tiny));
    }

    #[test]
    fn refuses_bounds_that_are_no_period() {
        let open = Domain::<f32, 2>::open();
        let error = |index| Err(Error::NotPositive { parameter: Parameter::Axis, index });
        assert_eq!(open.periodic(1, 1.0, 1.0), error(1));
        assert_eq!(open.periodic(2, 0.0, 1.0), error(2));
        assert!(matches!(open.periodic(0, f32::NAN, 1.0), Err(Error::NotFinite { .. })));
    }
}
