//! Sums over pairs of particles, each pair evaluated once.

use std::marker::PhantomData;
use std::ops::Range;

use sph_core::kernel::Kernel;
use sph_core::{Arithmetic, Lane};

use super::blocks::{reserve, squares};
use super::evaluate::profile;
use super::shared_neighbourhood::{GROUP, SharedNeighbourhood};
use super::simd::{BLOCK, Isa, Job, Real, Register};
use super::sorted_cells::SortedCells;

/// Copies what is in reach of a group and comes no earlier than it.
pub(super) struct Gather<'a, T, const D: usize> {
    pub(super) cells: &'a SortedCells<T, D>,
    pub(super) group: Range<usize>,
    pub(super) shared: &'a mut SharedNeighbourhood<T, D>,
}

impl<T: Real, const D: usize> Job<T> for Gather<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        self.shared.gather(isa, self.cells, self.group.clone(), self.group.start);
    }
}

/// Memory that is used again, a number for each particle of a shared neighbourhood.
#[derive(Clone, Debug)]
pub(super) struct PairScratch<T, const D: usize> {
    pub(super) shared: SharedNeighbourhood<T, D>,
    /// m_j, where these are not all 1.
    masses: Vec<T>,
    /// The sums at each particle of the neighbourhood.
    pub(super) sums: Vec<T>,
}

impl<T, const D: usize> Default for PairScratch<T, D> {
    fn default() -> Self {
        Self { shared: SharedNeighbourhood::default(), masses: Vec::new(), sums: Vec::new() }
    }
}

/// Sums m_j f(q) over the neighbourhood of a group: for the particles of the group, which come first in it, and for the others.
pub(super) struct Pairs<'a, T, K, const D: usize> {
    pub(super) cells: &'a SortedCells<T, D>,
    pub(super) group: Range<usize>,
    pub(super) masses: Option<&'a [T]>,
    pub(super) scratch: &'a mut PairScratch<T, D>,
    pub(super) kernel: PhantomData<K>,
}

impl<T: Real, K: Kernel, const D: usize> Job<T> for Pairs<'_, T, K, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        if self.masses.is_some() { self.all::<I, true>() } else { self.all::<I, false>() }
    }
}

impl<T: Real, K: Kernel, const D: usize> Pairs<'_, T, K, D> {
    #[inline(always)]
    fn all<I: Isa<T>, const MASSES: bool>(self) {
        let PairScratch { shared, masses, sums } = self.scratch;
        let (axes, places) = shared.padded();
        let length = places.len();
        reserve(sums, length);
        reserve(masses, length);
        let (masses, sums) = (&mut masses[..length], &mut sums[..length]);
        if let Some(all) = self.masses {
            for (mass, &place) in masses.iter_mut().zip(shared.places()) {
                *mass = all[place as usize];
            }
            masses[shared.places().len()..].fill(T::ZERO);
        }
        sums.fill(T::ZERO);
        let inverse = T::ONE / self.cells.radius;
        let inverse_square = I::Reg::splat(inverse * inverse);
        let width = I::Reg::WIDTH;
        let mut own = [T::ZERO; GROUP];
        for (i, own) in own.iter_mut().enumerate().take(self.group.len()) {
            let mut x = [I::Reg::ZERO; D];
            for axis in 0..D {
                x[axis] = I::Reg::splat(axes[axis][i]);
            }
            let mass = I::Reg::splat(masses[i]);
            let mut columns = I::parts(I::Reg::ZERO);
            for (block, sums) in sums.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
                for part in 0..I::PARTS {
                    let first = block * BLOCK + part * width;
                    let squares: I::Reg = squares(
                        &axes,
                        first,
                        #[inline(always)]
                        |axis, y| x[axis] - y,
                    );
                    let q = (squares * inverse_square).min(I::Reg::ONE).root();
                    let f = profile::<_, K>(q, D == 1);
                    let sums = &mut sums[part * width..];
                    let (column, sum) = (&mut columns.as_mut()[part], I::Reg::load(sums));
                    if MASSES {
                        *column += I::Reg::load_at(masses, first) * f;
                        (sum + mass * f).store(sums);
                    } else {
                        *column += f;
                        (sum + f).store(sums);
                    }
                }
            }
            *own = I::total_of_parts(columns);
        }
        for (sum, own) in sums.iter_mut().zip(own).take(self.group.len()) {
            *sum = own;
        }
    }
}
