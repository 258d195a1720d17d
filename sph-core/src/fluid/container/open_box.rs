//! A box.

use super::{Container, GAP, Wall, half_space, hold};
use crate::scalar::compact::{Compact, NearUnit};
use crate::{Arithmetic, Error, Parameter, check};

/// A box from 0 to `size`, in units of h, closed on all sides.
///
/// In corners the walls' shares combine as those of a product: 1 − Π (1 − χ_lower − χ_upper).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OpenBox<T, const D: usize> {
    size: [T; D],
}

impl<T, const D: usize> OpenBox<T, D> {
    /// The box from 0 to `size`, for a `static`: a constant cannot be compared with another here. A length below 1/4, or
    /// one that wrapped, makes a box that contains no place, so that no particle is taken; [`try_new`](Self::try_new) refuses it.
    pub const fn new(size: [T; D]) -> Self {
        Self { size }
    }
}

impl<T: Compact, const D: usize> OpenBox<T, D> {
    /// The box from 0 to `size`; lengths of 1/4 or more.
    ///
    /// ```
    /// use sph_core::fluid::OpenBox;
    /// assert!(OpenBox::try_new([7.5_f32, 0.25]).is_ok());
    /// assert!(OpenBox::try_new([7.5_f32, 0.2]).is_err());
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::NotPositive`] with the axis as index; [`Error::NotRepresentable`] for a length below 1/4.
    pub fn try_new(size: [T; D]) -> Result<Self, Error> {
        for (axis, &length) in size.iter().enumerate() {
            check::positive(length, Parameter::Axis, axis)?;
            if !is_wide(length) {
                return Err(Error::NotRepresentable { parameter: Parameter::Axis });
            }
        }
        Ok(Self::new(size))
    }

    /// The upper corner.
    #[inline(always)]
    fn upper(&self) -> [T::Near; D] {
        self.size.map(T::near)
    }

    /// Whether every wall is `distance` away or more.
    #[inline(always)]
    fn is_inside_by(&self, x: &[T::Near; D], distance: T::Near) -> bool {
        T::Near::all_between(x, distance, &self.upper().map(|upper| upper - distance))
    }

    /// The walls in reach of x, in a function of its own: few particles need it.
    #[inline(never)]
    fn touching(&self, x: &[T::Near; D]) -> Wall<T::Near, D> {
        let upper = self.upper();
        let mut open = [T::Near::ONE; D];
        let mut push = [T::Near::ZERO; D];
        for axis in 0..D {
            let (lower, upper) = (x[axis], upper[axis] - x[axis]);
            if lower < T::Near::ONE {
                open[axis] -= half_space::share::<T::Near, D>(lower);
                push[axis] += half_space::push::<T::Near, D>(lower);
            }
            if upper < T::Near::ONE {
                open[axis] -= half_space::share::<T::Near, D>(upper);
                push[axis] -= half_space::push::<T::Near, D>(upper);
            }
        }
        product(open, push)
    }
}

impl<T: Compact, const D: usize> Container<T, D> for OpenBox<T, D> {
    fn size(&self) -> [T; D] {
        self.size
    }

    fn contains(&self, x: &[T; D]) -> bool {
        (0..D).all(|axis| x[axis] >= T::ZERO && x[axis] <= self.size[axis] && is_wide(self.size[axis]))
    }

    #[inline(always)]
    fn wall(&self, x: &[T::Near; D]) -> Option<Wall<T::Near, D>> {
        if self.is_inside_by(x, T::Near::ONE) {
            return None;
        }
        Some(self.touching(x))
    }

    #[inline(always)]
    fn is_clear(&self, to: &[T::Near; D]) -> bool {
        self.is_inside_by(to, T::Near::ratio(GAP.0, GAP.1))
    }

    #[inline(always)]
    fn confine(&self, _from: &[T::Near; D], to: [T::Near; D], gap: T::Near) -> [T::Near; D] {
        let upper = self.upper();
        core::array::from_fn(|axis| hold(to[axis], upper[axis], gap))
    }
}

/// Whether a place between two walls so far apart can be [`GAP`] away from both.
fn is_wide<T: Arithmetic + PartialOrd>(length: T) -> bool {
    length >= T::ratio(2 * GAP.0, GAP.1)
}

/// The walls across each axis together, of which each takes a share of what the others leave `open`.
#[inline(always)]
fn product<N: NearUnit, const D: usize>(open: [N; D], mut push: [N; D]) -> Wall<N, D> {
    let mut all = N::ONE;
    for axis in 0..D {
        all = all * open[axis];
        for other in 0..D {
            if other != axis {
                push[other] = push[other].mul_rounded(open[axis]);
            }
        }
    }
    Wall { share: N::ONE - all, push }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_clear_is_not_moved() {
        let walls = OpenBox::new([2.0_f32, 3.0]);
        let clear = |x: &[f32; 2]| Container::is_clear(&walls, x);
        assert!(clear(&[1.0, 1.5]));
        for outside in [[-0.1, 1.0], [1.0, 3.1], [2.1, 1.0], [f32::NAN, 1.0], [1.0, f32::NEG_INFINITY]] {
            assert!(!clear(&outside), "{outside:?}");
        }
        for k in 0..400 {
            let x = [(k % 20) as f32 * 0.1, (k / 20) as f32 * 0.15];
            for gap in [1.0 / 128.0, 1.0 / 8.0] {
                assert!(!clear(&x) || walls.confine(&x, x, gap) == x, "{x:?}");
            }
        }
    }
}
