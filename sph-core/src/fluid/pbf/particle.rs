//! One particle of the fluid, as it lies in memory.

use super::FARTHEST;
use crate::Arithmetic;
use crate::fluid::Container;
use crate::scalar::compact::{Compact, NearUnit, Pack};
use crate::vector::{add, sub};

pub(super) type Packed<T, const D: usize> = <<T as Compact>::Near as NearUnit>::Packed<D>;

/// A particle: a position in units of h and a velocity in h a frame.
///
/// In two dimensions 32 bytes for f32 and 24 for any fixed-point scalar, whose position is kept to 2^−14.
#[derive(Clone, Copy, Debug)]
pub struct Particle<T: Compact, const D: usize> {
    pub(super) place: [T::Near; D],
    pub(super) velocity: Packed<T, D>,
    /// The displacement gathered so far.
    pub(super) push: Packed<T, D>,
    /// During a density pass, with the kernel's sum over the particles that were visited before this one.
    pub(super) pressure: T::Near,
    /// Which of the particles ahead are neighbours, as [`CellOrder::sweep`](crate::neighbours::CellOrder::sweep) gives it. From the
    /// prediction to the sorting, the number of the particle's cell.
    pub(super) neighbour_mask: u32,
}

impl<T: Compact, const D: usize> Particle<T, D> {
    pub(super) const AT_ORIGIN: Self = Self {
        place: [T::Near::ZERO; D],
        velocity: Packed::<T, D>::ZERO,
        push: Packed::<T, D>::ZERO,
        pressure: T::Near::ZERO,
        neighbour_mask: 0,
    };

    /// A particle at `position` with `velocity`, which is held at ±1. A coordinate that is not finite, or beyond ±2¹⁶,
    /// is taken as −1, which lies in no container.
    pub fn new(position: [T; D], velocity: [T; D]) -> Self {
        let outside = |x: T| !x.is_finite() || x.floor_to_i32().unsigned_abs() > FARTHEST as u32;
        Self::trusted(position.map(|x| if outside(x) { -T::ONE } else { x }), velocity)
    }

    /// As [`new`](Self::new) without a look at the position, which saves flash: for one that a container was seen to contain. Another
    /// gives wrong numbers; nothing panics.
    pub fn trusted(position: [T; D], velocity: [T; D]) -> Self {
        let velocity = Pack::pack(velocity.map(super::clamp_to_unit));
        Self { place: position.map(T::near), velocity, ..Self::AT_ORIGIN }
    }

    /// With the pressure that its last frame ended with: position, velocity and pressure are all that a frame hands on.
    pub fn with_pressure(self, pressure: T) -> Self {
        Self { pressure: super::clamp_to_unit(pressure), ..self }
    }

    /// Moves it by `way` as far as the container lets it, and adds the way it went to `velocity`.
    #[inline(always)]
    pub(super) fn advance<C: Container<T, D>>(
        &mut self,
        way: Packed<T, D>,
        velocity: Packed<T, D>,
        (container, gap): (&C, T::Near),
    ) {
        let from = self.place;
        let to = add(&from, &way.unpack());
        if container.is_clear(&to) {
            (self.place, self.velocity) = (to, velocity.plus(way));
        } else {
            self.stop(to, velocity, (container, gap));
        }
    }

    /// Moves it towards `to` as far as the container lets it, in a function of its own: few particles need it.
    #[inline(never)]
    fn stop<C: Container<T, D>>(
        &mut self,
        to: [T::Near; D],
        velocity: Packed<T, D>,
        (container, gap): (&C, T::Near),
    ) {
        let from = self.place;
        self.place = container.confine(&from, to, gap);
        self.velocity = velocity.plus(Pack::pack(sub(&self.place, &from)));
    }

    /// Where it is, in units of h.
    pub fn position(&self) -> [T; D] {
        self.place.map(T::from_near)
    }

    /// How far it moved in the last frame, in units of h.
    pub fn velocity(&self) -> [T; D] {
        self.velocity.unpack().map(T::from_near)
    }

    /// The pressure that the last frame ended with; no unit, 0 at a free surface.
    pub fn pressure(&self) -> T {
        T::from_near(self.pressure)
    }
}
