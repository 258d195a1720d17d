//! A fixed scene, computed with sph-core and digested bit by bit: the same source on every processor.
//!
//! The scene comes from integers alone: jittered samples about a box, masses and values from a linear congruential
//! generator, each an exact fraction. What is computed at its points is digested with FNV-1a over
//! [`Scalar::canonical_bits`]; the digests must be the same wherever and however the source was compiled.

#![no_std]

mod erased;
mod fluid;
mod fnv;
mod kernels;
mod scene;

pub use fnv::Fnv;
pub use scene::{POINTS, QUANTITIES, Scene};

use core::fmt;
use erased::{Erased, Search};
use scene::SIDE_CELLS;
use sph_core::scalar::fixed::{I8F24, I16F16, Saturating};
use sph_core::{BruteForce, CellLayout, Error, InlineCellGrid, Scalar};

/// One digest, and what of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// The scalar's name.
    pub scalar: &'static str,
    /// The number of dimensions.
    pub dim: usize,
    /// The neighbour search, or the kernel that needs none.
    pub by: &'static str,
    /// The quantity.
    pub quantity: &'static str,
    /// FNV-1a of its bits.
    pub digest: u64,
}

impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scalar, dim, by, quantity, digest } = self;
        write!(f, "{scalar} {dim}d {by} {quantity} {digest:016x}")
    }
}

/// Every digest of every scalar.
///
/// # Errors
/// As [`items`].
pub fn all(mut emit: impl FnMut(Item)) -> Result<(), Error> {
    items::<f32>(&mut emit)?;
    items::<f64>(&mut emit)?;
    items::<Saturating<I16F16>>(&mut emit)?;
    items::<Saturating<I8F24>>(&mut emit)?;
    fluids(emit)
}

/// The digests of a moving fluid, in f32 and two fixed-point scalars.
///
/// # Errors
/// As [`items`].
pub fn fluids(mut emit: impl FnMut(Item)) -> Result<(), Error> {
    fluid::digest::<f32, 2, 36>(&mut emit)?;
    fluid::digest::<Saturating<I16F16>, 2, 36>(&mut emit)?;
    fluid::digest::<Saturating<I8F24>, 2, 36>(&mut emit)?;
    fluid::digest::<f32, 3, 216>(&mut emit)?;
    fluid::digest::<Saturating<I16F16>, 3, 216>(&mut emit)?;
    fluid::digest::<Saturating<I8F24>, 3, 216>(&mut emit)
}

/// Every digest of one scalar.
///
/// # Errors
/// The scene is in the range of every scalar that this is meant for; an error says that one is not.
pub fn items<T: Scalar>(mut emit: impl FnMut(Item)) -> Result<(), Error> {
    in_dimensions::<T, 2>(&mut emit)?;
    in_dimensions::<T, 3>(&mut emit)
}

fn in_dimensions<T: Scalar, const D: usize>(emit: &mut impl FnMut(Item)) -> Result<(), Error> {
    kernels::digest::<T, D>(emit)?;
    let mut scene = Scene::<T, D>::empty();
    scene.fill()?;
    by_search("brute", &scene, &BruteForce::new(scene.positions())?, emit)?;
    let mut storage = grid_storage();
    by_search("grid", &scene, &storage.build(grid_layout()?, scene.positions())?, emit)
}

/// Storage for the scene's cell grid.
pub const fn grid_storage() -> InlineCellGrid<u8, 65, 64> {
    InlineCellGrid::new()
}

/// The layout of the scene's cell grid.
///
/// # Errors
/// As [`CellLayout::unbounded`].
pub fn grid_layout<T: Scalar, const D: usize>() -> Result<CellLayout<T, D>, Error> {
    CellLayout::unbounded(Scene::<T, D>::support_radius(), [SIDE_CELLS; D])
}

fn by_search<T: Scalar, const D: usize>(
    by: &'static str,
    scene: &Scene<T, D>,
    search: &dyn Search<T, D>,
    emit: &mut impl FnMut(Item),
) -> Result<(), Error> {
    let mut digests = [Fnv::new(); QUANTITIES.len()];
    for point in 0..POINTS {
        scene.at(Erased(search), point, |quantity, bits| digests[quantity].add(bits))?;
    }
    for (quantity, digest) in QUANTITIES.into_iter().zip(digests) {
        emit(Item { scalar: T::NAME, dim: D, by, quantity, digest: digest.get() });
    }
    Ok(())
}
