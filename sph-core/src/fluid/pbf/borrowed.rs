//! The solver over slices of the caller.

use super::{FARTHEST, Particle, Settings, check_inside};
use crate::fluid::Container;
use crate::neighbours::{CellOrder, Index};
use crate::scalar::compact::Compact;
use crate::{Error, Parameter};

/// A pass over all particles, for those who want to know where the time goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Pass {
    /// Velocities and positions a frame on.
    Predict,
    /// Particles into the order of their cells.
    Sort,
    /// The pairs in reach, their viscosity and the first density.
    Search,
    /// A later density.
    Density,
    /// The correction of positions and velocities.
    Correct,
}

/// A fluid in borrowed memory: what [`PositionBasedFluid`](super::PositionBasedFluid) does, for any number of particles known only
/// when the program runs.
///
/// ```
/// use sph_core::fluid::{BorrowedFluid, OpenBox, Particle, Settings};
/// let walls = OpenBox::new([9.5_f32, 9.5]);
/// let place = |k: usize| Particle::new([0.25 + 0.5 * (k % 8) as f32, 0.25 + 0.5 * (k / 8) as f32], [0.0, 0.0]);
/// let mut particles: Vec<_> = (0..64).map(place).collect();
/// let mut starts = vec![0_u32; 100];
/// let mut fluid = BorrowedFluid::new(&walls, Settings::DEFAULT, &mut particles, &mut starts)?;
/// for frame in 0..60 {
///     fluid.step([0.0, -0.005]);
/// }
/// assert!(fluid.particles().iter().all(|p| p.position()[1] < 4.1));
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Debug)]
pub struct BorrowedFluid<'a, T: Compact, C, const D: usize, I = u32> {
    pub(super) container: &'a C,
    pub(super) settings: Settings,
    pub(super) particles: &'a mut [Particle<T, D>],
    pub(super) order: CellOrder<'a, I, D>,
}

impl<'a, T: Compact, C: Container<T, D>, const D: usize, I: Index> BorrowedFluid<'a, T, C, D, I> {
    /// The fluid of these particles. `starts` has an element for each cell of side 1, ⌊size⌋ + 1 along an axis;
    /// what is in it does not matter.
    ///
    /// # Errors
    /// [`Error::CapacityExceeded`] where it is too short, or for more particles than `I` counts;
    /// [`Error::NotRepresentable`] where the container ends beyond 2¹⁶, or less than 1 below the scalar's largest number;
    /// [`Error::OutsideDomain`] for a particle that is not inside the container.
    pub fn new(
        container: &'a C,
        settings: Settings,
        particles: &'a mut [Particle<T, D>],
        starts: &'a mut [I],
    ) -> Result<Self, Error> {
        let (capacity, needed) = (I::MAX, particles.len());
        if needed > capacity {
            return Err(Error::CapacityExceeded { parameter: Parameter::Particles, capacity, needed });
        }
        for (index, particle) in particles.iter().enumerate() {
            check_inside(container, particle, index)?;
        }
        Self::trusted(container, settings, particles, starts)
    }

    /// As [`new`](Self::new) without a look at the particles, which saves instructions and flash: for those that a fluid moved or that were
    /// looked at when they were added, and no more than `I` counts. One that is outside after all gives wrong numbers; nothing panics.
    ///
    /// # Errors
    /// [`Error::CapacityExceeded`] and [`Error::NotRepresentable`] for the container, as `new`.
    pub fn trusted(
        container: &'a C,
        settings: Settings,
        particles: &'a mut [Particle<T, D>],
        starts: &'a mut [I],
    ) -> Result<Self, Error> {
        const { assert!(D == 2 || D == 3, "two or three dimensions") };
        let limit = T::MAX - T::ONE;
        let fits = |length: T| length <= limit && length.floor_to_i32() < FARTHEST;
        if !container.size().into_iter().all(fits) {
            return Err(Error::NotRepresentable { parameter: Parameter::Axis });
        }
        let counts = container.size().map(|length| length.floor_to_i32().max(0) as usize + 1);
        Ok(Self { container, settings, particles, order: CellOrder::new(counts, starts)? })
    }

    /// The particles, in an order that changes from frame to frame.
    pub fn particles(&self) -> &[Particle<T, D>] {
        self.particles
    }

    /// Moves the fluid by one frame under an acceleration in h a frame², one number an axis.
    ///
    /// Any number will do: each is held at ±[`STEEPEST`](super::STEEPEST), and NaN counts as 0.
    #[inline(always)]
    pub fn step(&mut self, acceleration: [T; D]) {
        self.step_observed(acceleration, |_| {});
    }

    /// As [`step`](Self::step), calling `observe` after each pass: to read a cycle counter.
    pub fn step_observed(&mut self, acceleration: [T; D], mut observe: impl FnMut(Pass)) {
        self.predict(acceleration);
        observe(Pass::Predict);
        self.sort();
        observe(Pass::Sort);
        for iteration in 0..self.settings.iterations.max(1) {
            if iteration == 0 {
                self.search();
                observe(Pass::Search);
            } else {
                self.density();
                observe(Pass::Density);
            }
            self.correct();
            observe(Pass::Correct);
        }
    }
}
