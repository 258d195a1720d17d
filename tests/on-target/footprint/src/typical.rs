//! Typical uses in two dimensions with Wendland's C2 kernel: a frame's worth of work on storage of fixed size.

use core::hint::black_box;
use sph_core::field::volumes;
use sph_core::kernel::WendlandC2;
use sph_core::{CellLayout, Error, Field, InlineCellGrid, KernelInfluence, Scalar, Sources, Uniform};

/// How many samples.
pub const SAMPLES: usize = 128;

/// The samples and their cells: all the RAM there is.
pub struct Storage<T> {
    positions: [[T; 2]; SAMPLES],
    density: [T; SAMPLES],
    values: [T; SAMPLES],
    gradient: [[T; 2]; SAMPLES],
    grid: InlineCellGrid<u8, 65, SAMPLES>,
}

impl<T: Scalar> Storage<T> {
    /// Zeros.
    pub const fn new() -> Self {
        Self {
            positions: [[T::ZERO; 2]; SAMPLES],
            density: [T::ZERO; SAMPLES],
            values: [T::ZERO; SAMPLES],
            gradient: [[T::ZERO; 2]; SAMPLES],
            grid: InlineCellGrid::new(),
        }
    }
}

impl<T: Scalar> Default for Storage<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// ρ at every sample.
///
/// # Errors
/// As the constructors of sph-core.
pub fn density<T: Scalar>(storage: &mut Storage<T>) -> Result<(), Error> {
    let w = KernelInfluence::<T, 2, WendlandC2>::new(black_box(T::ONE))?;
    let layout = CellLayout::unbounded(T::ONE, [8, 8])?;
    let search = storage.grid.build(layout, &storage.positions)?;
    Sources::new(search, Uniform(black_box(T::ONE)))?.density(&w, &mut storage.density)
}

/// ρ at every sample, then A and ∇A at each sample's position.
///
/// # Errors
/// As the constructors of sph-core.
pub fn fields<T: Scalar>(storage: &mut Storage<T>) -> Result<(), Error> {
    let w = KernelInfluence::<T, 2, WendlandC2>::new(black_box(T::ONE))?;
    let layout = CellLayout::unbounded(T::ONE, [8, 8])?;
    let search = storage.grid.build(layout, &storage.positions)?;
    let mass = Uniform(black_box(T::ONE));
    Sources::new(search, mass)?.density(&w, &mut storage.density)?;
    let mut volume = [T::ZERO; SAMPLES];
    volumes(mass, &storage.density, &mut volume)?;
    let sources = Sources::new(search, &volume)?;
    let field = Field::new(&sources, &storage.values)?;
    for (out, x) in storage.gradient.iter_mut().zip(&storage.positions) {
        let (value, gradient) = field.interpolate_with_gradient_at(&w, x);
        *out = gradient.map(|component| component + black_box(value));
    }
    Ok(())
}
