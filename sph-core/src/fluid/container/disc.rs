//! A disc, in three dimensions a ball.

use super::{Container, Wall, hold};
use crate::scalar::compact::{Compact, NearUnit};
use crate::vector::{norm_squared, scale};
use crate::{Arithmetic, Error, Parameter, check};

/// A disc (in three dimensions a ball) of `radius` 1 or more around (radius, radius, …), in units of h.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Disc<T> {
    radius: T,
}

impl<T> Disc<T> {
    /// The disc in the box from 0 to 2 `radius`, for a `static`: a constant cannot be compared with another here. A radius below 1,
    /// or one that wrapped, makes a disc that contains no place, so that no particle is taken; [`try_new`](Self::try_new) refuses it.
    pub const fn new(radius: T) -> Self {
        Self { radius }
    }
}

impl<T: Compact> Disc<T> {
    /// The disc in the box from 0 to 2 `radius`; a radius of 1 or more.
    ///
    /// # Errors
    /// [`Error::NotFinite`] and [`Error::NotPositive`]; [`Error::NotRepresentable`] for a radius below 1, and where the scalar
    /// cannot hold 2 `radius`.
    pub fn try_new(radius: T) -> Result<Self, Error> {
        check::positive(radius, Parameter::Axis, 0)?;
        if radius >= T::ONE && radius + radius - radius == radius && radius + radius > radius {
            Ok(Self::new(radius))
        } else {
            Err(Error::NotRepresentable { parameter: Parameter::Axis })
        }
    }

    /// x from the centre in units of the radius, and its square: in the range of every scalar.
    #[inline(always)]
    fn relative<const D: usize>(&self, x: &[T; D]) -> ([T; D], T) {
        let u = x.map(|coordinate| (coordinate - self.radius) / self.radius);
        (u, norm_squared(&u))
    }
}

impl<T: Compact, const D: usize> Container<T, D> for Disc<T> {
    fn size(&self) -> [T; D] {
        [self.radius + self.radius; D]
    }

    fn contains(&self, x: &[T; D]) -> bool {
        self.radius >= T::ONE && self.relative(x).1 <= T::ONE
    }

    fn wall(&self, x: &[T::Near; D]) -> Option<Wall<T::Near, D>> {
        let (u, square) = self.relative(&x.map(T::from_near));
        let inner = T::ONE - T::ONE / self.radius;
        if square < inner * inner {
            return None;
        }
        let length = square.sqrt();
        let d = ((T::ONE - length) * self.radius).max(T::ZERO);
        let normal = u.map(|along| (-along / length).near());
        if length > T::ZERO && d < T::ONE {
            Wall::plane(d.near(), normal.map(|n| n.clamp_abs(T::Near::ONE)))
        } else {
            None
        }
    }

    fn confine(&self, from: &[T::Near; D], to: [T::Near; D], gap: T::Near) -> [T::Near; D] {
        let edge = (self.radius + self.radius).near();
        let to = to.map(|coordinate| hold(coordinate, edge, T::Near::ZERO));
        let (u, square) = self.relative(&to.map(T::from_near));
        if square <= T::ONE {
            return to;
        }
        let back = scale(&u, (self.radius - T::from_near(gap)) / square.sqrt());
        let to = back.map(|along| (along + self.radius).near());
        if self.contains(&to.map(T::from_near)) { to } else { *from }
    }
}
