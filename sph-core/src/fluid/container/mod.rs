//! Containers of a fluid: walls that press without wall particles.
//!
//! A wall is treated as more fluid at rest behind it. Near one, a particle's kernel reaches into it by a known share, so its
//! density is right without wall particles; and the wall pushes as that fluid would under the same pressure. See
//! [`half_space`]. Lengths are in units of the support radius h, and a container lies in the box from 0 to
//! [`size`](Container::size).
//!
//! | container | what |
//! |---|---|
//! | [`OpenBox`] | a box; corners are exact products of their walls |
//! | [`Disc`] | a disc, in three dimensions a ball |
//! | [`Shape`] | any signed distance |
//! | [`Mask`] | a bitmap, obstacles and all |

mod disc;
pub mod half_space;
mod mask;
mod open_box;
mod shape;

pub use disc::Disc;
pub use mask::Mask;
pub use open_box::OpenBox;
pub use shape::Shape;

use crate::scalar::compact::{Compact, NearUnit};

/// What the walls do at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall<N, const D: usize> {
    /// The share of the kernel's integral that lies in walls, in [0, 1].
    pub share: N,
    /// The push under unit pressure, away from the walls: Σ f u over the particles that the walls stand for.
    pub push: [N; D],
}

impl<N: NearUnit, const D: usize> Wall<N, D> {
    /// One plane wall at distance d along the unit `normal` that points into the fluid.
    #[inline(always)]
    pub fn plane(d: N, normal: [N; D]) -> Option<Self> {
        if d >= N::ONE {
            return None;
        }
        let d = d.positive_part();
        let push = half_space::push::<N, D>(d);
        Some(Self { share: half_space::share::<N, D>(d), push: normal.map(|along| along.mul_rounded(push)) })
    }
}

/// The largest gap that [`Container::confine`] is asked for, a fraction of h.
pub const GAP: (i32, i32) = (1, 8);

/// A container for particles: which places are inside, and what its walls do.
///
/// Your own needs four methods, all but [`is_clear`](Self::is_clear); [`Shape`] makes one from a signed distance. Places are given as the fluid keeps them, in
/// [`Compact::Near`]: floats as they are, fixed-point numbers in counts of 2^−14 ([`Compact::from_near`] has the scalar). The
/// fluid trusts `confine`: what it returns must be inside, whatever it is given, NaN included.
///
/// The smallest one: a box in f32 and two dimensions whose floor alone is a wall that presses; at its other sides, particles stop.
///
/// ```
/// use sph_core::fluid::{Container, Particle, PositionBasedFluid, Wall};
///
/// struct Tray;
///
/// impl Container<f32, 2> for Tray {
///     fn size(&self) -> [f32; 2] {
///         [4.0, 4.0]
///     }
///     fn contains(&self, x: &[f32; 2]) -> bool {
///         x.iter().all(|coordinate| (0.0..=4.0).contains(coordinate))
///     }
///     fn wall(&self, x: &[f32; 2]) -> Option<Wall<f32, 2>> {
///         Wall::plane(x[1], [0.0, 1.0])
///     }
///     fn confine(&self, from: &[f32; 2], to: [f32; 2], _gap: f32) -> [f32; 2] {
///         // NaN is not in the range either
///         core::array::from_fn(|axis| if (0.0..=4.0).contains(&to[axis]) { to[axis] } else { from[axis] })
///     }
/// }
///
/// let mut fluid = PositionBasedFluid::<f32, Tray, 2, 1, 25>::new(Tray);
/// fluid.add(Particle::new([2.0, 3.0], [0.0, 0.0])).unwrap();
/// for _ in 0..100 {
///     fluid.step([0.0, -0.005]);
/// }
/// assert!(fluid.particles()[0].position()[1] < 1.0);
/// ```
pub trait Container<T: Compact, const D: usize> {
    /// The upper corner of the box from 0 that the container lies in.
    fn size(&self) -> [T; D];

    /// Whether a particle may be at x.
    fn contains(&self, x: &[T; D]) -> bool;

    /// What the walls do at x; None out of their reach.
    fn wall(&self, x: &[T::Near; D]) -> Option<Wall<T::Near, D>>;

    /// Whether [`confine`](Self::confine) certainly returns `to` as it is, wherever a particle comes from: asked first, to save the call.
    #[inline(always)]
    fn is_clear(&self, _to: &[T::Near; D]) -> bool {
        false
    }

    /// `to` where a particle can come from `from`, which is inside, in one step; else a place inside near to it, about `gap`
    /// (at most [`GAP`]) away from the wall that was in the way.
    fn confine(&self, from: &[T::Near; D], to: [T::Near; D], gap: T::Near) -> [T::Near; D];
}

/// x held between `gap` and `upper − gap`, and `gap` for NaN.
#[inline(always)]
fn hold<N: PartialOrd + Copy + core::ops::Sub<Output = N>>(x: N, upper: N, gap: N) -> N {
    let highest = upper - gap;
    if x >= gap && x <= highest {
        x
    } else if x > highest {
        highest
    } else {
        gap
    }
}
