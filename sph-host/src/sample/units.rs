//! Units and origin: what a number of a file is before it becomes one of a scalar.
//!
//! Every scalar sees coordinates from an origin near the particles and in a unit near h, subtracted and divided in f64: a set
//! at 10⁹ gives what the same set gives at 0. Masses, densities and values have units too, so that none leaves the range of
//! a small scalar.
//!
//! For floats all units are powers of two: h / 2 < unit ≤ h, and likewise the largest mass and the largest magnitude of each
//! quantity. Scaling is then exact and changes no bit of a result. The origin is a multiple of a power of two that is at least
//! twice what the particles span: a set near 0 keeps the origin 0, where subtraction is exact too, and moving a set by a
//! multiple of it changes no bit.
//!
//! Fixed point has few bits above 1, so its units are exact: h is 1 and the origin is the middle of the particles.

use sph_core::Scalar;

use super::span::Span;
use crate::scalar_choice::name_of;

/// The units of one run, as multiples of the file's, and the cells of its search: with the same of these, a program that
/// links sph-core computes the same bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Units {
    /// The scalar's name.
    pub scalar: String,
    /// Along each of the axes that sums run over.
    pub origin: Vec<f64>,
    /// The unit of length.
    pub length: f64,
    /// The unit of mass.
    pub mass: f64,
    /// The unit of density.
    pub density: f64,
    /// The name of each quantity and its unit.
    pub quantities: Vec<(String, f64)>,
    /// Cells along each axis, over the box of the particles, of the search that exact sums go by.
    pub cells: Vec<u32>,
}

/// Origin and unit of length in D dimensions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<const D: usize> {
    origin: [f64; D],
    length: f64,
}

impl Units {
    /// The units that suit a scalar for particles along these axes. Where h differs, the largest counts.
    pub(super) fn of<T: Scalar>(span: &Span, axes: &[usize]) -> Self {
        let is_float = is_float::<T>();
        let unit = if is_float { power_of_two } else { |value: f64| value };
        let boxes: Vec<(f64, f64)> = axes.iter().map(|&axis| span.coordinates[axis]).collect();
        let length = unit(span.supports.1);
        let mass = match span.masses {
            Some((_, most)) if is_float => unit(most),
            // as if all were of the largest mass: the mean density is 1
            Some((_, most)) => {
                let volume = boxes.iter().map(|(lower, upper)| ((upper - lower) / length).max(1.0));
                most * span.count as f64 / volume.product::<f64>()
            }
            None => 1.0,
        };
        let density = match (span.masses, span.densities) {
            // step by step: no power of a small length leaves the range of f64 before the density does
            (Some(_), _) if is_float => axes.iter().fold(mass, |density, _| density / length),
            (Some(_), _) => mass / length.powi(axes.len() as i32),
            // weights 1 / ρ: the largest density is the unit
            (None, Some((_, most))) => unit(most),
            (None, None) => 1.0,
        };
        let quantities = span.fields.iter().map(|field| {
            let most = field.bounds.0.abs().max(field.bounds.1.abs());
            (field.name.clone(), if most > 0.0 { unit(most) } else { 1.0 })
        });
        let origin = if is_float { snapped_origin(&boxes, length) } else { middle(&boxes) };
        let cells = cells(&boxes, span.supports.1, span.count);
        Self {
            scalar: name_of::<T>(),
            origin,
            length,
            mass,
            density,
            quantities: quantities.collect(),
            cells,
        }
    }

    /// Origin and unit of length; there are D axes.
    pub(super) fn frame<const D: usize>(&self) -> Frame<D> {
        Frame { origin: std::array::from_fn(|axis| self.origin[axis]), length: self.length }
    }
}

impl<const D: usize> Frame<D> {
    /// A position of a particle in these units.
    #[inline]
    pub(super) fn position<T: Scalar>(&self, x: [f64; D]) -> [T; D] {
        std::array::from_fn(|axis| T::from_f64((x[axis] - self.origin[axis]) / self.length))
    }

    /// A point in these units. One beyond the range of a float is at its end, out of reach of every particle.
    #[inline]
    pub(super) fn point<T: Scalar>(&self, x: [f64; D]) -> [T; D] {
        let most = if is_float::<T>() { T::MAX.to_f64() / 4.0 } else { f64::MAX };
        std::array::from_fn(|axis| {
            T::from_f64(((x[axis] - self.origin[axis]) / self.length).clamp(-most, most))
        })
    }
}

/// Whether a scalar is a float of a wide range, for which powers of two are units that change no bit.
pub(super) fn is_float<T: Scalar>() -> bool {
    T::MAX.to_f64() > 1e30
}

/// Cells about as wide as the largest h over boxes, at most some four a particle.
pub(crate) fn cells(boxes: &[(f64, f64)], reach: f64, count: usize) -> Vec<u32> {
    let most = (4.0 * count as f64).powf(1.0 / boxes.len() as f64).ceil().clamp(1.0, 1e6);
    boxes.iter().map(|(lower, upper)| ((upper - lower) / reach).floor().clamp(1.0, most) as u32).collect()
}

/// The middles of boxes.
fn middle(boxes: &[(f64, f64)]) -> Vec<f64> {
    boxes.iter().map(|(lower, upper)| lower + (upper - lower) / 2.0).collect()
}

/// The multiples of a power of two that are nearest to the middle of the boxes, the lower of two; the step is two to four times
/// the longest box.
fn snapped_origin(boxes: &[(f64, f64)], length: f64) -> Vec<f64> {
    let extent = boxes.iter().fold(length, |most, (lower, upper)| most.max(upper - lower));
    let step = 4.0 * power_of_two(extent);
    let snapped = |middle: f64| {
        // a sum with 0 has no negative zero
        let origin = (middle / step - 0.5).ceil() * step + 0.0;
        if origin.is_finite() { origin } else { 0.0 }
    };
    middle(boxes).into_iter().map(snapped).collect()
}

/// The largest power of two that is not above a positive number.
fn power_of_two(value: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(value.to_bits() & EXPONENT).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_are_at_or_below() {
        for (value, expected) in [(1.0, 1.0), (1.99, 1.0), (0.3, 0.25), (1e300, 2_f64.powi(996))] {
            assert_eq!(power_of_two(value), expected);
        }
        assert!(power_of_two(5e-324) > 0.0);
    }

    #[test]
    fn origins_move_with_the_set_and_are_zero_near_zero() {
        assert_eq!(snapped_origin(&[(0.0, 1.0), (-0.25, 0.75)], 0.1), [0.0; 2]);
        for offset in [8.0, -64.0, 1_073_741_824.0] {
            let moved = snapped_origin(&[(offset, 1.0 + offset), (offset + 1.0, offset + 1.25)], 0.1);
            assert_eq!(moved, [offset, offset]);
        }
        assert_eq!(snapped_origin(&[(-1e308, 7e307)], 1.0), [0.0]);
    }
}
