//! Any shape that can tell the distance to its wall.

use super::{Container, Wall, hold};
use crate::Arithmetic;
use crate::scalar::compact::{Compact, NearUnit};
use crate::vector::{add, scale};

/// A container from a signed distance: `distance(x)` gives the distance to the nearest wall, positive inside, and the unit
/// normal of that wall, into the fluid. Lengths in units of h.
///
/// Walls count as plane, one at a place: smooth shapes of a radius of curvature of h and more. What the function says
/// that makes no sense (NaN, a normal of any length) cannot let a particle out: it then stays where it was.
///
/// ```
/// use sph_core::fluid::{Container, Shape};
/// // a channel along x that rises to the right
/// let channel = Shape::new([20.0_f32, 8.0], |x: &[f32; 2]| {
///     let d = (x[1] - 0.2 * x[0]) * 0.980_58;
///     if d < 3.0 { (d, [-0.196_12, 0.980_58]) } else { (6.0 - d, [0.196_12, -0.980_58]) }
/// });
/// assert!(channel.contains(&[5.0, 2.0]));
/// assert!(!channel.contains(&[15.0, 2.0]));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Shape<T, F, const D: usize> {
    size: [T; D],
    distance: F,
}

impl<T, F, const D: usize> Shape<T, F, D> {
    /// The part of the shape that lies in the box from 0 to `size`.
    pub const fn new(size: [T; D], distance: F) -> Self {
        Self { size, distance }
    }
}

/// Corrections along the normal before a particle is left where it was.
const TRIES: usize = 3;

impl<T: Compact, F: Fn(&[T; D]) -> (T, [T; D]), const D: usize> Container<T, D> for Shape<T, F, D> {
    fn size(&self) -> [T; D] {
        self.size
    }

    fn contains(&self, x: &[T; D]) -> bool {
        (0..D).all(|axis| x[axis] >= T::ZERO && x[axis] <= self.size[axis]) && (self.distance)(x).0 >= T::ZERO
    }

    fn wall(&self, x: &[T::Near; D]) -> Option<Wall<T::Near, D>> {
        let (d, normal) = (self.distance)(&x.map(T::from_near));
        if d < T::ONE {
            let normal = normal.map(|along| along.near().clamp_abs(T::Near::ONE));
            Wall::plane(d.max(T::ZERO).near(), normal)
        } else {
            None
        }
    }

    fn confine(&self, from: &[T::Near; D], to: [T::Near; D], gap: T::Near) -> [T::Near; D] {
        let (size, gap) = (self.size.map(T::near), T::from_near(gap));
        let mut to = to;
        for _ in 0..TRIES {
            to = core::array::from_fn(|axis| hold(to[axis], size[axis], T::Near::ZERO));
            let x = to.map(T::from_near);
            let (d, normal) = (self.distance)(&x);
            if d >= T::ZERO {
                return to;
            }
            to = add(&x, &scale(&normal, gap - d)).map(T::near);
        }
        if self.contains(&to.map(T::from_near)) { to } else { *from }
    }
}
