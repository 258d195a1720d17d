//! Position-based fluid: one step a frame, a fixed number of iterations, and no input that blows it up.
//!
//! ```text
//! predict    v ← v + a,  x ← x + v
//! density    ρ_i/ρ₀ = (1 + Σ_j t_ij³) / 3.05 + χ_i                  t_ij = (1 − |x_ij|²/h²)₊, poly6; χ the walls' share
//! pressure   p_i = κ (ρ_i/ρ₀ − 1 + p_i of the pass before / 3.05)₊    κ = 1
//! correct    x_i ← x_i + Σ_j ((p_i + p_j) t_ij³ + (t_ij − 0.84)₊) x_ij + 1.6 p_i G_i,  v likewise
//! ```
//!
//! Macklin & Müller's density constraint with these differences. The direction of a pair's push is poly6 times the offset, which
//! is sharper than poly6's own gradient, so that no root is needed; its strength has a constant denominator κ. Closer than
//! 0.8 spacings a repulsion is added that does not depend on pressure: particles never pair up. The pressure of the pass before
//! counts as a weight of the kernel, so a third of it is kept, in three dimensions a sixth; that halves what is left of the
//! compression under the fluid's own weight. XSPH viscosity is part of the first pass. In three dimensions 3.05 is 4.96, κ is 0.85 and 1.6 is 1.5; these numbers were chosen by measurement, which `tuning.rs`
//! lists. Every pair's push is computed once and applied with both signs, so momentum is conserved: to rounding in floats, exactly in
//! fixed point.
//!
//! The unit of length is the support radius h, the particles' spacing at rest is h/2, and time counts in frames. A fixed-point
//! scalar's positions and pressures are kept as counts of 2⁻¹⁴ in 32 bits, velocities and pushes in 16
//! ([`compact`](crate::scalar::compact)).
//!
//! Sources: M. Macklin, M. Müller, *Position based fluids*, ACM Trans. Graph. 32 (2013) 104; B. Solenthaler, R. Pajarola,
//! *Predictive-corrective incompressible SPH*, ACM Trans. Graph. 28 (2009) 40 (the constant denominator); J. J. Monaghan,
//! J. Comput. Phys. 82 (1989) 1 (XSPH).

mod borrowed;
mod particle;
mod step;
mod tuning;

use crate::fluid::Container;
use crate::neighbours::Index;
use crate::scalar::compact::{Compact, NearUnit, Pack};
use crate::{Arithmetic, Error, Parameter};
pub use borrowed::{BorrowedFluid, Pass};
pub use particle::Particle;

/// The largest velocity along an axis, a fraction of h a frame.
pub const FASTEST: (i32, i32) = (1, 2);
/// The largest acceleration along an axis, a fraction of h a frame².
pub const STEEPEST: (i32, i32) = (1, 8);

/// No coordinate is this large.
const FARTHEST: i32 = 1 << 16;

/// How the fluid behaves. Shares are in 1/256.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Settings {
    /// Passes of density and correction a frame; 0 counts as 1.
    pub iterations: u8,
    /// How much of the difference to the neighbours' velocity is taken away each frame (XSPH), at most 128 of 256, in three
    /// dimensions 72: beyond, neighbours overshoot.
    pub viscosity: u8,
    /// How much of the pressure is kept where it is negative, 0 to 64 of 256: the fluid's surface holds together.
    pub cohesion: u8,
}

impl Settings {
    /// Two iterations, a little viscosity, no cohesion.
    pub const DEFAULT: Self = Self { iterations: 2, viscosity: 26, cohesion: 0 };
    /// For three dimensions: as [`DEFAULT`](Self::DEFAULT) with the viscosity that lets a fluid come to rest there.
    pub const IN_3D: Self = Self { viscosity: 64, ..Self::DEFAULT };
}

impl Default for Settings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// A fluid of at most `CAP` particles in a container of at most `CELLS` cells of side 1, everything inline.
///
/// `I` is the integer that counts particles: u8 for fewer than 256. [`SIZE`](Self::SIZE) is its RAM. In a `static`:
///
/// ```
/// use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid};
/// use std::sync::Mutex;
///
/// type Pendant = PositionBasedFluid<f32, OpenBox<f32, 2>, 2, 64, 64>;
/// static FLUID: Mutex<Pendant> = Mutex::new(Pendant::new(OpenBox::new([7.5, 7.5])));
/// const _: () = assert!(Pendant::SIZE < 64 * 44);
///
/// let mut fluid = FLUID.lock().unwrap();
/// for k in 0..64 {
///     let at = [0.25 + 0.5 * (k % 8) as f32, 0.25 + 0.5 * (k / 8) as f32];
///     fluid.add(Particle::new(at, [0.0, 0.0])).unwrap();
/// }
/// for frame in 0..60 {
///     fluid.step([0.0, -0.005]);
/// }
/// assert!(fluid.particles().iter().all(|p| p.position()[1] < 4.1));
/// ```
///
/// Gravity: g Δt² / h for frames of Δt seconds and h metres. At 60 frames a second, 0.005 looks right for a fluid some twelve
/// spacings deep; the deeper the fluid and the stronger the gravity, the more it is compressed (1.3 % there with two
/// iterations).
#[derive(Clone, Debug)]
pub struct PositionBasedFluid<T: Compact, C, const D: usize, const CAP: usize, const CELLS: usize, I = u16> {
    container: C,
    starts: [I; CELLS],
    particles: [Particle<T, D>; CAP],
    len: I,
    settings: Settings,
}

/// A particle that was not taken, and why.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rejected<P> {
    /// The particle.
    pub particle: P,
    /// Why it was not taken.
    pub reason: Error,
}

impl<P> core::fmt::Display for Rejected<P> {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(formatter, "particle not taken: {}", self.reason)
    }
}

impl<P: core::fmt::Debug> core::error::Error for Rejected<P> {}

impl<T: Compact, C, I: Index, const D: usize, const CAP: usize, const CELLS: usize>
    PositionBasedFluid<T, C, D, CAP, CELLS, I>
{
    /// The RAM it takes, in bytes.
    pub const SIZE: usize = size_of::<Self>();
    /// The most particles it holds.
    pub const CAPACITY: usize = if CAP < I::MAX { CAP } else { I::MAX };

    /// An empty container and [`Settings::DEFAULT`].
    pub const fn new(container: C) -> Self {
        Self::with_settings(container, Settings::DEFAULT)
    }

    /// An empty container.
    pub const fn with_settings(container: C, settings: Settings) -> Self {
        const { assert!(D == 2 || D == 3, "two or three dimensions") };
        let particles = [Particle::AT_ORIGIN; CAP];
        Self { container, starts: [I::ZERO; CELLS], particles, len: I::ZERO, settings }
    }

    /// How it behaves, to be changed at any time.
    pub fn settings_mut(&mut self) -> &mut Settings {
        &mut self.settings
    }

    /// The container.
    pub fn container(&self) -> &C {
        &self.container
    }

    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.len.to_usize()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The particles, in an order that changes from frame to frame.
    pub fn particles(&self) -> &[Particle<T, D>] {
        self.particles.get(..self.len()).unwrap_or_default()
    }

    /// Removes the particle at `index` and puts the last one there; None where there is none.
    pub fn remove(&mut self, index: usize) -> Option<Particle<T, D>> {
        let last = self.len().checked_sub(1)?;
        let moved = *self.particles().get(last)?;
        let place = self.particles.get_mut(index).filter(|_| index <= last)?;
        self.len = I::from_usize(last);
        Some(core::mem::replace(place, moved))
    }

    /// Removes the particles that `keep` says no to.
    pub fn retain(&mut self, mut keep: impl FnMut(&Particle<T, D>) -> bool) {
        let mut index = 0;
        while let Some(particle) = self.particles().get(index) {
            if keep(particle) {
                index += 1;
            } else {
                self.remove(index);
            }
        }
    }

    /// Adds to every particle's velocity what `impulse` gives for it; the result is held as in [`Particle::new`].
    pub fn impulse(&mut self, mut impulse: impl FnMut(&Particle<T, D>) -> [T; D]) {
        let len = self.len();
        for particle in self.particles.iter_mut().take(len) {
            let change = impulse(particle);
            let velocity = particle.velocity.unpack();
            let after = |axis: usize| (velocity[axis] + clamp_to_unit(change[axis])).clamp_abs(T::Near::ONE);
            particle.velocity = Pack::pack(core::array::from_fn(after));
        }
    }
}

impl<T: Compact, C: Container<T, D>, I: Index, const D: usize, const CAP: usize, const CELLS: usize>
    PositionBasedFluid<T, C, D, CAP, CELLS, I>
{
    /// Moves the fluid by one frame under an acceleration in h a frame², one number an axis.
    ///
    /// Any number will do: each is held at ±[`STEEPEST`], and NaN counts as 0.
    pub fn step(&mut self, acceleration: [T; D]) {
        if let Ok(mut fluid) = self.borrowed() {
            fluid.step(acceleration);
        }
    }

    /// Its memory lent to the solver, for [`BorrowedFluid::step_observed`].
    ///
    /// # Errors
    /// [`Error::CapacityExceeded`] where the container has more than `CELLS` cells; the fluid is then empty.
    pub fn borrowed(&mut self) -> Result<BorrowedFluid<'_, T, C, D, I>, Error> {
        let particles = self.particles.get_mut(..self.len.to_usize()).unwrap_or_default();
        BorrowedFluid::trusted(&self.container, self.settings, particles, &mut self.starts)
    }

    /// Adds a particle.
    ///
    /// # Errors
    /// The particle comes back with [`Error::CapacityExceeded`] when the fluid is full or the container has more than `CELLS`
    /// cells, [`Error::OutsideDomain`] for a position outside the container.
    pub fn add(&mut self, particle: Particle<T, D>) -> Result<(), Rejected<Particle<T, D>>> {
        self.place(particle).map_err(|reason| Rejected { particle, reason })
    }

    fn place(&mut self, particle: Particle<T, D>) -> Result<(), Error> {
        self.borrowed()?;
        let index = self.len();
        check_inside(&self.container, &particle, index)?;
        let capacity = Self::CAPACITY;
        let full = Error::CapacityExceeded { parameter: Parameter::Particles, capacity, needed: index + 1 };
        *self.particles.get_mut(..capacity).and_then(|room| room.get_mut(index)).ok_or(full)? = particle;
        self.len = I::from_usize(index + 1);
        Ok(())
    }
}

/// Whether the particle may be in the container.
fn check_inside<T: Compact, C: Container<T, D>, const D: usize>(
    container: &C,
    particle: &Particle<T, D>,
    index: usize,
) -> Result<(), Error> {
    let (size, position) = (container.size(), particle.position());
    for (axis, &coordinate) in position.iter().enumerate() {
        if !(coordinate >= T::ZERO && coordinate <= size[axis]) {
            return Err(Error::OutsideDomain { index, axis });
        }
    }
    if container.contains(&position) { Ok(()) } else { Err(Error::OutsideDomain { index, axis: 0 }) }
}

/// A literal.
#[inline(always)]
fn ratio<N: Arithmetic>((numerator, denominator): (i32, i32)) -> N {
    N::ratio(numerator, denominator)
}

/// Clamps a number to ±`limit` ≤ 1, as its companion; NaN becomes 0.
#[inline(always)]
fn clamp_to_near<T: Compact>(value: T, limit: (i32, i32)) -> T::Near {
    clamp_to_unit(value).clamp_abs(ratio(limit))
}

/// Clamps a number to ±1, as its companion; NaN becomes 0.
#[inline(never)]
fn clamp_to_unit<T: Compact>(value: T) -> T::Near {
    let value = if value > T::ONE {
        T::ONE
    } else if value >= -T::ONE {
        value
    } else if value < -T::ONE {
        -T::ONE
    } else {
        T::ZERO
    };
    value.near()
}
