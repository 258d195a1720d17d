//! The sorted particles, and the jobs that start from them.

use std::ops::Range;

use sph_core::{Error, Parameter, Scalar};

use super::cells::BandLayout;
use super::simd::{InstructionSet, Real};
use super::sort::{Sorted, sort, to_f64};
use crate::parallel;

/// Particles sorted into cells for one support radius h: what every sum and search starts from.
///
/// ```
/// use sph_core::{Uniform, kernel::WendlandC2};
/// use sph_host::fast::SortedCells;
///
/// let positions: Vec<[f32; 2]> = (0..400).map(|i| [(i % 20) as f32, (i / 20) as f32]).collect();
/// let cells = SortedCells::sort(&positions, 2.5)?;
/// let density = cells.density::<WendlandC2>(Uniform(1.0))?;
/// assert!((density[210] - 1.0138).abs() < 1e-4); // the lattice error of this kernel is 1.4 %
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SortedCells<T, const D: usize> {
    pub(super) layout: BandLayout<D>,
    pub(super) sorted: Sorted<T, D>,
    pub(super) radius: T,
    pub(super) level: InstructionSet,
}

impl<T: Real, const D: usize> SortedCells<T, D> {
    /// Sorts particles in 1 to 3 dimensions for the support radius h.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::NotPositive`] for such a radius; [`Error::NotFinite`] with its index for such a
    /// position; [`Error::NotRepresentable`] where the box of the positions or h² is out of range;
    /// [`Error::CapacityExceeded`] for 2³² particles or more.
    pub fn sort(positions: &[[T; D]], radius: T) -> Result<Self, Error> {
        const { assert!(D >= 1 && D <= 3, "cells are for one to three dimensions") };
        check_radius(radius, 0)?;
        if positions.len() >= u32::MAX as usize {
            let (capacity, needed) = (u32::MAX as usize - 1, positions.len());
            return Err(Error::CapacityExceeded { parameter: Parameter::Position, capacity, needed });
        }
        let (lower, upper) = bounds(positions)?;
        let layout = BandLayout::new(lower, upper, radius.to_f64(), positions.len());
        Ok(Self { layout, sorted: sort(&layout, positions), radius, level: InstructionSet::best() })
    }

    /// The same with the code of another instruction set: the bits are the same, the time is not. A level that the
    /// processor does not have is taken as the best below it.
    #[must_use]
    pub fn at_level(self, level: InstructionSet) -> Self {
        Self { level, ..self }
    }

    /// How many particles there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.sorted.order.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The particles' indices in the input, in the order of the cells.
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.sorted.order
    }

    /// The coordinates along one axis, in the order of the cells.
    ///
    /// # Panics
    /// Where there is no such axis.
    #[must_use]
    pub fn along(&self, axis: usize) -> &[T] {
        &self.sorted.coordinates[axis][..self.len()]
    }
}

impl<T: Real, const D: usize> SortedCells<T, D> {
    /// The box of some consecutive particles, of which there is one at least.
    #[inline(always)]
    pub(super) fn corners(&self, particles: Range<usize>) -> ([T; D], [T; D]) {
        let first = self.sorted.position(particles.start);
        let (mut lower, mut upper) = (first, first);
        let axes = self.sorted.padded();
        for axis in 0..D {
            for &x in &axes[axis][particles.clone()] {
                lower[axis] = if x < lower[axis] { x } else { lower[axis] };
                upper[axis] = if x > upper[axis] { x } else { upper[axis] };
            }
        }
        (lower, upper)
    }
}

/// The radius is finite and positive, and so is its square.
pub(super) fn check_radius<T: Real>(radius: T, index: usize) -> Result<(), Error> {
    let parameter = Parameter::SupportRadius;
    if !radius.is_finite() {
        return Err(Error::NotFinite { parameter, index });
    }
    if !radius.is_above_zero() {
        return Err(Error::NotPositive { parameter, index });
    }
    let square = radius * radius;
    if !square.is_finite() || !square.is_above_zero() {
        return Err(Error::NotRepresentable { parameter });
    }
    Ok(())
}

/// A length is the expected one.
pub(super) fn check_length(found: usize, expected: usize, parameter: Parameter) -> Result<(), Error> {
    if found == expected { Ok(()) } else { Err(Error::LengthMismatch { parameter, expected, found }) }
}

/// Positions that a thread takes at a time.
const CHUNK: usize = 1 << 14;

/// The box of the positions: zero where there are none.
pub(super) fn bounds<T: Real, const D: usize>(positions: &[[T; D]]) -> Result<([f64; D], [f64; D]), Error> {
    let empty = ([T::MAX; D], [-T::MAX; D], true);
    let boxes = parallel::map(positions.chunks(CHUNK), |_, positions| {
        positions.iter().fold(empty, |all, x| join(all, (*x, *x, is_finite(x))))
    });
    let (lower, upper, finite) = boxes.into_iter().fold(empty, join);
    let parameter = Parameter::Position;
    if !finite {
        let index = positions.iter().position(|x| !is_finite(x)).unwrap_or(0);
        return Err(Error::NotFinite { parameter, index });
    }
    if positions.is_empty() {
        return Ok(([0.0; D], [0.0; D]));
    }
    let (lower, upper) = (to_f64(&lower), to_f64(&upper));
    if (0..D).any(|axis| !(upper[axis] - lower[axis]).is_finite()) {
        return Err(Error::NotRepresentable { parameter });
    }
    Ok((lower, upper))
}

fn is_finite<T: Real, const D: usize>(x: &[T; D]) -> bool {
    x.iter().all(|component| component.is_finite())
}

/// The box around two boxes, and whether both are finite.
#[inline(always)]
fn join<T: Real, const D: usize>(a: Bounds<T, D>, b: Bounds<T, D>) -> Bounds<T, D> {
    let (mut lower, mut upper) = (a.0, a.1);
    for axis in 0..D {
        lower[axis] = Scalar::min(a.0[axis], b.0[axis]);
        upper[axis] = Scalar::max(a.1[axis], b.1[axis]);
    }
    (lower, upper, a.2 & b.2)
}

/// Lower and upper corner, and whether all in it are finite.
type Bounds<T, const D: usize> = ([T; D], [T; D], bool);
