//! Particles of one set of cells, with what sums at points weigh them by.

use sph_core::kernel::Kernel;
use sph_core::{Error, KernelInfluence};

use super::evaluate::{Evaluator, evaluator};
use super::simd::Real;
use super::sorted_cells::SortedCells;

/// The columns have a number for each particle in the order of the cells, and after the last a block of zeros.
#[derive(Clone, Debug)]
pub(super) struct Part<'a, T, const D: usize> {
    pub(super) cells: &'a SortedCells<T, D>,
    /// Where each particle has an h_j of its own.
    pub(super) own: Option<&'a OwnRadii<T>>,
    /// c_j of each plain sum.
    pub(super) coefficients: Vec<Vec<T>>,
    /// V_j; empty where there are no fields.
    pub(super) volumes: Vec<T>,
    /// V_j A_j of each field.
    pub(super) weighted_values: Vec<Vec<T>>,
}

/// What each particle of some cells has instead of one h for all, in columns as those of a [`Part`].
#[derive(Clone, Debug)]
pub(super) struct OwnRadii<T> {
    /// h_j
    pub(super) radii: Vec<T>,
    /// h_j²
    pub(super) squares: Vec<T>,
    /// 1 / h_j
    pub(super) inverses: Vec<T>,
    /// The smallest h_j.
    pub(super) least: T,
}

/// What particles carry: each slice has a number for each particle, in the order of the input.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a, T> {
    /// c_j of each plain sum: masses m_j for a density.
    pub coefficients: &'a [&'a [T]],
    /// V_j = m_j / ρ_j, units L^D; not read where there are no fields.
    pub volumes: &'a [T],
    /// A_j of each field that is estimated.
    pub values: &'a [&'a [T]],
}

impl<'a, T: Real, const D: usize> Part<'a, T, D> {
    /// Sorts what the particles carry; there is a number for each index of the cells.
    pub(super) fn new(
        cells: &'a SortedCells<T, D>,
        own: Option<&'a OwnRadii<T>>,
        samples: &Samples<'_, T>,
    ) -> Self {
        let Samples { coefficients, volumes, values } = *samples;
        let column = |slice: &&[T]| cells.sorted.column(|j| slice[j]);
        Self {
            cells,
            own,
            coefficients: coefficients.iter().map(column).collect(),
            volumes: if values.is_empty() { Vec::new() } else { column(&volumes) },
            weighted_values: values.iter().map(|a| cells.sorted.column(|j| volumes[j] * a[j])).collect(),
        }
    }

    /// σ_D h^{-D} for the cells' h.
    pub(super) fn constant(&self, kernel: &FieldKernel<T, D>) -> Result<T, Error> {
        if let Some(own) = self.own {
            (kernel.constant)(own.least)?;
        }
        (kernel.constant)(self.cells.radius)
    }
}

/// What of a kernel is needed for sums at points: the rest is compiled once for all kernels.
#[derive(Clone, Copy, Debug)]
pub(super) struct FieldKernel<T, const D: usize> {
    pub(super) evaluate: Evaluator<T>,
    /// σ_D h^{-D}
    pub(super) constant: fn(T) -> Result<T, Error>,
}

impl<T: Real, const D: usize> FieldKernel<T, D> {
    pub(super) fn new<K: Kernel>() -> Self {
        Self {
            evaluate: evaluator::<T, K>(D),
            constant: |h| Ok(KernelInfluence::<T, D, K>::new(h)?.normalisation()),
        }
    }
}
