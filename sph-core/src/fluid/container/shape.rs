//! Any shape that can tell the distance to its wall.

use super::{Container, Wall, hold, kept};
use crate::Arithmetic;
use crate::scalar::compact::{Compact, Near};
use crate::vector::scale;

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

    fn wall(&self, x: &[T; D]) -> Option<Wall<T::Near, D>> {
        let (d, normal) = (self.distance)(x);
        if d < T::ONE {
            let normal = normal.map(|along| along.offset(T::ZERO).held(T::Near::ONE));
            Wall::plane(d.max(T::ZERO).offset(T::ZERO), normal)
        } else {
            None
        }
    }

    fn confine(&self, from: &[T; D], to: [T; D], gap: T) -> [T; D] {
        let mut to = to;
        for _ in 0..TRIES {
            to = kept(&core::array::from_fn(|axis| hold(to[axis], self.size[axis], T::ZERO)));
            let (d, normal) = (self.distance)(&to);
            if d >= T::ZERO {
                return to;
            }
            let back = scale(&normal, gap - d);
            to = kept(&core::array::from_fn(|axis| to[axis] + back[axis]));
        }
        if self.contains(&to) { to } else { *from }
    }
}
