//! One particle of the fluid, as it lies in memory.

use crate::scalar::compact::{Compact, Near};

type Stored<T> = <<T as Compact>::Near as Near>::Stored;

/// A particle: a position in units of h and a velocity in h a frame.
///
/// 36 bytes for f32 in two dimensions, 24 for a fixed-point scalar of 32 bits.
#[derive(Clone, Copy, Debug)]
pub struct Particle<T: Compact, const D: usize> {
    pub(super) position: [T; D],
    pub(super) velocity: [Stored<T>; D],
    /// The displacement gathered so far.
    pub(super) push: [Stored<T>; D],
    /// The kernel's sum over the particles before this one.
    pub(super) load: Stored<T>,
    pub(super) pressure: Stored<T>,
    /// Which of the particles ahead were in reach: bit k for the k-th, all bits where there were 32 or more.
    pub(super) reach: i32,
}

impl<T: Compact, const D: usize> Particle<T, D> {
    pub(super) const AT_ORIGIN: Self = Self {
        position: [T::ZERO; D],
        velocity: [T::Near::STORED_ZERO; D],
        push: [T::Near::STORED_ZERO; D],
        load: T::Near::STORED_ZERO,
        pressure: T::Near::STORED_ZERO,
        reach: 0,
    };

    /// A particle at `position` with `velocity`, which is held at ±1.
    pub fn new(position: [T; D], velocity: [T; D]) -> Self {
        let velocity = velocity.map(|v| super::near_held(v, (1, 1)).store());
        Self { position, velocity, ..Self::AT_ORIGIN }
    }

    /// With the pressure that its last frame ended with: position, velocity and pressure are all that a frame hands on.
    pub fn with_pressure(self, pressure: T) -> Self {
        Self { pressure: super::near_held(pressure, (1, 1)).store(), ..self }
    }

    /// Where it is, in units of h.
    pub fn position(&self) -> [T; D] {
        self.position
    }

    /// How far it moved in the last frame, in units of h.
    pub fn velocity(&self) -> [T; D] {
        self.velocity.map(|v| T::from_near(Near::load(v)))
    }

    /// The pressure that the last frame ended with; no unit, 0 at a free surface.
    pub fn pressure(&self) -> T {
        T::from_near(Near::load(self.pressure))
    }
}
