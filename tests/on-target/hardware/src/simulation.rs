//! What is computed each frame, on storage of fixed size. A fluid takes this place by offering the same three things:
//! [`Simulation::BYTES`], a `const fn new`, and a `frame` that cannot panic.

use sph_core::kernel::Poly6;
use sph_core::{Arithmetic, CellLayout, Error, InlineCellGrid, KernelInfluence, Sources, Uniform};

/// The scalar: f32 where the processor computes with it, fixed point elsewhere.
#[cfg(target_abi = "eabihf")]
pub(crate) type T = f32;
/// The scalar: f32 where the processor computes with it, fixed point elsewhere.
#[cfg(not(target_abi = "eabihf"))]
pub(crate) type T = sph_core::scalar::fixed::Saturating<sph_core::scalar::fixed::I16F16>;

/// How many samples: as many as an index of `u8` can name.
const SAMPLES: usize = 255;
/// 8 by 8 cells as wide as the support radius, and one more.
const STARTS: usize = 65;

/// Samples on a lattice, pushed about, and their densities. Lengths are in units of the support radius.
pub(crate) struct Simulation {
    positions: [[T; 2]; SAMPLES],
    density: [T; SAMPLES],
    grid: InlineCellGrid<u8, STARTS, SAMPLES>,
    begun: bool,
}

impl Simulation {
    /// The RAM it takes.
    pub(crate) const BYTES: usize = size_of::<Self>();

    /// Zeros, so that it lies in `.bss` and takes no flash.
    #[expect(clippy::new_without_default, reason = "for a static alone")]
    pub(crate) const fn new() -> Self {
        Self {
            positions: [[T::ZERO; 2]; SAMPLES],
            density: [T::ZERO; SAMPLES],
            grid: InlineCellGrid::new(),
            begun: false,
        }
    }

    /// Moves the samples by `push` / 1024 of the support radius and gives the largest density.
    ///
    /// # Errors
    /// [`Error::NotFinite`] when a sample has been pushed out of the scalar's range.
    pub(crate) fn frame(&mut self, push: [i16; 2]) -> Result<T, Error> {
        if !self.begun {
            self.begun = true;
            for (i, position) in (0..).zip(&mut self.positions) {
                *position = [T::ratio(i % 16, 2), T::ratio(i / 16, 2)];
            }
        }
        for position in &mut self.positions {
            for (coordinate, push) in position.iter_mut().zip(push) {
                *coordinate += T::ratio(push.into(), 1024);
            }
        }
        let w = KernelInfluence::<T, 2, Poly6>::new(T::ONE)?;
        let layout = CellLayout::unbounded(T::ONE, [8, 8])?.open();
        let search = self.grid.build(layout, &self.positions)?;
        let sources = Sources::new(search, Uniform(T::ratio(1, 4)))?; // spacing 1/2: density near 1
        let mut largest = T::ZERO;
        for (density, x) in self.density.iter_mut().zip(&self.positions) {
            *density = sources.equal_density_at(&w, x);
            if *density > largest {
                largest = *density;
            }
        }
        Ok(largest)
    }
}
