//! ρ_i = Σ m_j W(x_i − x_j) at every particle (Thm 3.2).

use std::marker::PhantomData;

use rayon::prelude::*;
use sph_core::kernel::Kernel;
use sph_core::{Error, KernelInfluence, Parameter, PerSample};

use super::collect::{Found, collect};
use super::evaluate::{Columns, profile};
use super::lanes::Lanes;
use super::set::{Cells, check_length};
use super::simd::{BLOCK, Isa, Job, Real};

/// Particles of one job.
const CHUNK: usize = 2048;

impl<T: Real, const D: usize> Cells<T, D> {
    /// ρ_i at every particle, itself included, in the order of the input. Masses are a slice, or one
    /// [`Uniform`](sph_core::Uniform) value.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is a mass for each particle; those of [`KernelInfluence::new`].
    ///
    /// ```
    /// use sph_core::{Uniform, kernel::CubicSpline};
    /// use sph_host::fast::Cells;
    /// let row: Vec<[f64; 1]> = (0..100).map(|i| [0.1 * f64::from(i)]).collect();
    /// let density = Cells::sort(&row, 0.4)?.density::<CubicSpline>(Uniform(0.1))?;
    /// assert!((density[50] - 1.0).abs() < 1e-12);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn density<K: Kernel>(&self, masses: impl PerSample<T>) -> Result<Vec<T>, Error> {
        let w = KernelInfluence::<T, D, K>::new(self.radius)?;
        if let Some(count) = masses.count() {
            check_length(count, self.len(), Parameter::Mass)?;
            let own = self.sorted.order.iter().map(|&j| masses.get(j as usize).unwrap_or(T::ZERO)).collect();
            return Ok(self.densities::<K>(w.normalisation(), Some(own)));
        }
        let mass = masses.get(0).unwrap_or(T::ZERO);
        Ok(self.densities::<K>(w.normalisation() * mass, None))
    }

    /// constant · Σ m_j f, m_j = 1 where there are no masses.
    fn densities<K: Kernel>(&self, constant: T, masses: Option<Vec<T>>) -> Vec<T> {
        let mut sorted = vec![T::ZERO; self.len()];
        sorted.par_chunks_mut(CHUNK).enumerate().for_each_init(Found::default, |found, (chunk, out)| {
            let masses = masses.as_deref();
            let kernel = PhantomData::<K>;
            T::dispatch(
                self.level,
                Density { cells: self, first: chunk * CHUNK, constant, masses, out, found, kernel },
            );
        });
        let mut density = vec![T::ZERO; self.len()];
        for (&index, &value) in self.sorted.order.iter().zip(&sorted) {
            density[index as usize] = value;
        }
        density
    }
}

/// The densities of some consecutive particles.
struct Density<'a, T, const D: usize, K> {
    cells: &'a Cells<T, D>,
    first: usize,
    constant: T,
    masses: Option<&'a [T]>,
    out: &'a mut [T],
    found: &'a mut Found<T>,
    kernel: PhantomData<K>,
}

impl<T: Real, const D: usize, K: Kernel> Job<T> for Density<'_, T, D, K> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>, const N: usize>(mut self, isa: I) {
        match self.masses {
            None => self.equal_masses::<I, N>(isa),
            Some(masses) => self.own_masses::<I, N>(isa, masses),
        }
    }
}

impl<T: Real, const D: usize, K: Kernel> Density<'_, T, D, K> {
    #[inline(always)]
    fn inverse_square(&self) -> T {
        let inverse = T::ONE / self.cells.radius;
        inverse * inverse
    }

    #[inline(always)]
    fn equal_masses<I: Isa<T>, const N: usize>(&mut self, isa: I) {
        let inverse_square = Lanes::<T, N>::splat(self.inverse_square());
        for (k, out) in self.out.iter_mut().enumerate() {
            let x = self.cells.sorted.position(self.first + k);
            let count = collect::<T, D, I, true, false>(isa, self.cells, None, &x, self.found, 0);
            let mut columns = Columns::<T, N>::ZERO;
            for squares in self.found.squares(count) {
                for group in 0..BLOCK / N {
                    columns.add(group, profile::<T, K, D, N>(Lanes::of(squares, group) * inverse_square));
                }
            }
            *out = columns.total() * self.constant;
        }
    }

    #[inline(always)]
    fn own_masses<I: Isa<T>, const N: usize>(&mut self, isa: I, masses: &[T]) {
        let inverse_square = Lanes::<T, N>::splat(self.inverse_square());
        let mut picked = Vec::new();
        for (k, out) in self.out.iter_mut().enumerate() {
            let x = self.cells.sorted.position(self.first + k);
            let count = collect::<T, D, I, true, true>(isa, self.cells, None, &x, self.found, 0);
            picked.clear();
            picked.extend(self.found.places[..count].iter().map(|&place| masses[place as usize]));
            picked.resize(count.next_multiple_of(BLOCK), T::ZERO);
            let mut columns = Columns::<T, N>::ZERO;
            for (squares, masses) in self.found.squares(count).iter().zip(picked.as_chunks::<BLOCK>().0) {
                for group in 0..BLOCK / N {
                    let f = profile::<T, K, D, N>(Lanes::of(squares, group) * inverse_square);
                    columns.add(group, Lanes::of(masses, group) * f);
                }
            }
            *out = columns.total() * self.constant;
        }
    }
}
