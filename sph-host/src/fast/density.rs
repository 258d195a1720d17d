//! ρ_i = Σ m_j W(x_i − x_j) at every particle (Thm 3.2).

use std::marker::PhantomData;
use std::ops::Range;

use rayon::prelude::*;
use sph_core::kernel::Kernel;
use sph_core::{Error, KernelInfluence, Parameter, PerSample};

use super::collect::{Collect, Found, Span};
use super::evaluate::SumProfiles;
use super::set::{Cells, check_length};
use super::simd::Real;

/// Particles that a thread takes at a time.
const CHUNK: usize = 2048;
/// Particles whose neighbours are gathered before they are summed over: what is gathered fits the first cache.
const GROUP: usize = 64;

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
        let work = sorted.par_chunks_mut(CHUNK).enumerate();
        work.for_each_init(Scratch::default, |scratch, (chunk, out)| {
            for (group, out) in out.chunks_mut(GROUP).enumerate() {
                let first = chunk * CHUNK + group * GROUP;
                self.group::<K>(first..first + out.len(), constant, masses.as_deref(), out, scratch);
            }
        });
        let mut density = vec![T::ZERO; self.len()];
        for (&index, &value) in self.sorted.order.iter().zip(&sorted) {
            density[index as usize] = value;
        }
        density
    }

    /// The densities of some consecutive particles.
    fn group<K: Kernel>(
        &self,
        range: Range<usize>,
        constant: T,
        masses: Option<&[T]>,
        out: &mut [T],
        Scratch { found, spans, picked }: &mut Scratch<T>,
    ) {
        let (points, places) = (&self.sorted, masses.is_some());
        let search = Collect { cells: self, own_limits: None, points, range, places, found, spans };
        let end = T::dispatch(self.level, search);
        if let Some(masses) = masses {
            picked.clear();
            picked.resize(end, T::ZERO);
            for span in spans.iter() {
                for (out, &place) in picked[span.particles()].iter_mut().zip(&found.places[span.particles()])
                {
                    *out = masses[place as usize];
                }
            }
        }
        let inverse = T::ONE / self.radius;
        let sums = SumProfiles {
            squares: &found.squares,
            inverse_square: inverse * inverse,
            coefficients: masses.map(|_| &picked[..]),
            spans,
            constant,
            out,
            kernel: PhantomData::<K>,
            line: D == 1,
        };
        T::dispatch(self.level, sums);
    }
}

/// Memory that is used again.
#[derive(Default)]
struct Scratch<T> {
    found: Found<T>,
    spans: Vec<Span>,
    picked: Vec<T>,
}
