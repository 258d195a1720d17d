//! Typical uses in two dimensions, in open space: a frame's worth of work on storage of fixed size.

use core::hint::black_box;
use sph_core::field::volumes;
use sph_core::kernel::Kernel;
use sph_core::{
    BruteForce, CellLayout, Error, Field, InlineCellGrid, KernelInfluence, Neighbours, Scalar, Sources,
    Uniform,
};

/// How many samples.
pub const SAMPLES: usize = 128;

/// The samples and what is computed for them.
pub struct Samples<T> {
    positions: [[T; 2]; SAMPLES],
    density: [T; SAMPLES],
    volumes: [T; SAMPLES],
    values: [T; SAMPLES],
    gradient: [[T; 2]; SAMPLES],
}

/// Without a grid: all the RAM there is.
pub type Brute<T> = Samples<T>;

/// With a grid: all the RAM there is.
pub struct Gridded<T> {
    samples: Samples<T>,
    grid: InlineCellGrid<u8, 65, SAMPLES>,
}

impl<T: Scalar> Samples<T> {
    /// Zeros.
    #[expect(clippy::new_without_default, reason = "for a static alone")]
    pub const fn new() -> Self {
        Self {
            positions: [[T::ZERO; 2]; SAMPLES],
            density: [T::ZERO; SAMPLES],
            volumes: [T::ZERO; SAMPLES],
            values: [T::ZERO; SAMPLES],
            gradient: [[T::ZERO; 2]; SAMPLES],
        }
    }
}

impl<T: Scalar> Gridded<T> {
    /// Zeros.
    #[expect(clippy::new_without_default, reason = "for a static alone")]
    pub const fn new() -> Self {
        Self { samples: Samples::new(), grid: InlineCellGrid::new() }
    }
}

/// ρ at every sample.
///
/// # Errors
/// As the constructors of sph-core.
pub fn density<T: Scalar, K: Kernel>(storage: &mut Gridded<T>) -> Result<(), Error> {
    let Gridded { samples: Samples { positions, density, .. }, grid } = storage;
    let w = KernelInfluence::<T, 2, K>::new(black_box(T::ONE))?;
    let search = grid.build(CellLayout::unbounded(T::ONE, [8, 8])?.open(), positions)?;
    Sources::new(search, Uniform(black_box(T::ONE)))?.density(&w, density)
}

/// ρ at every sample, then A and ∇A at each sample's position.
///
/// # Errors
/// As the constructors of sph-core.
pub fn fields<T: Scalar, K: Kernel>(storage: &mut Gridded<T>) -> Result<(), Error> {
    let Gridded { samples: Samples { positions, density, volumes, values, gradient }, grid } = storage;
    let search = grid.build(CellLayout::unbounded(T::ONE, [8, 8])?.open(), positions)?;
    with::<T, K>(search, density, volumes, values, gradient)
}

/// The same without a grid.
///
/// # Errors
/// As the constructors of sph-core.
pub fn fields_brute<T: Scalar, K: Kernel>(storage: &mut Brute<T>) -> Result<(), Error> {
    let Samples { positions, density, volumes, values, gradient } = storage;
    with::<T, K>(BruteForce::open(positions)?, density, volumes, values, gradient)
}

fn with<T: Scalar, K: Kernel>(
    search: impl Neighbours<T, 2> + Copy,
    density: &mut [T],
    volume: &mut [T; SAMPLES],
    values: &mut [T; SAMPLES],
    gradient: &mut [[T; 2]],
) -> Result<(), Error> {
    let w = KernelInfluence::<T, 2, K>::new(black_box(T::ONE))?;
    let mass = Uniform(black_box(T::ONE));
    Sources::new(search, mass)?.density(&w, density)?;
    volumes(mass, density, volume)?;
    let sources = Sources::new(search, &*volume)?;
    let field = Field::new(&sources, &*values)?;
    for (slope, x) in gradient.iter_mut().zip(search.positions()) {
        let value;
        (value, *slope) = field.interpolate_with_gradient_at(&w, x);
        black_box(value);
    }
    Ok(())
}
