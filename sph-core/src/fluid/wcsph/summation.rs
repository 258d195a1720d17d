//! How the sums of all particles are done.

use super::{Forces, Scheme, Search, Seen, State};
use crate::{Error, Influence, Scalar};

/// Does the sums over the neighbours of all particles, the first of which are fluid: as many as there is room for results.
pub trait Summation<T, const D: usize, W> {
    /// dρ/dt of the fluid.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutsideDomain`] for a particle that is nowhere, and what the search itself reports.
    fn rates(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        seen: &[Seen<T, D>],
        rates: &mut [T],
    ) -> Result<(), Error>;

    /// First the walls as they are seen, then the forces on the fluid.
    ///
    /// # Errors
    /// As [`rates`](Self::rates).
    fn forces(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        seen: &mut [Seen<T, D>],
        forces: &mut [Forces<T, D>],
    ) -> Result<(), Error>;
}

/// How a loop over particles is run: one after another, or spread over threads. Each result depends on its number alone, so
/// every executor gives the same bits.
pub trait Executor {
    /// `out[i] = f(i)`
    fn fill<U: Send>(&self, out: &mut [U], f: impl Fn(usize) -> U + Sync);
}

/// One after another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sequential;

impl Executor for Sequential {
    #[inline(always)]
    fn fill<U: Send>(&self, out: &mut [U], f: impl Fn(usize) -> U + Sync) {
        for (i, slot) in out.iter_mut().enumerate() {
            *slot = f(i);
        }
    }
}

/// A search, and sums pair by pair in the order in which it finds them.
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OneByOne<S, E> {
    /// Finds the neighbours.
    pub search: S,
    /// Runs the loops over particles.
    pub executor: E,
}

impl<T, const D: usize, W, S, E> Summation<T, D, W> for OneByOne<S, E>
where
    T: Scalar,
    W: Influence<T, D> + Sync,
    S: Search<T, D>,
    E: Executor,
{
    fn rates(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        seen: &[Seen<T, D>],
        rates: &mut [T],
    ) -> Result<(), Error> {
        let fluid = rates.len();
        let pairs = self.search.find(&scheme.layout, positions, fluid)?;
        let state = State { fluid, seen };
        self.executor.fill(rates, |i| scheme.density_rate(&pairs, &state, i).unwrap_or(T::ZERO));
        Ok(())
    }

    fn forces(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        seen: &mut [Seen<T, D>],
        forces: &mut [Forces<T, D>],
    ) -> Result<(), Error> {
        let fluid = forces.len();
        let pairs = self.search.find(&scheme.layout, positions, fluid)?;
        if let Some((of_fluid, of_walls)) = seen.split_at_mut_checked(fluid) {
            self.executor.fill(of_walls, |wall| scheme.wall(&pairs, of_fluid, fluid.wrapping_add(wall)));
        }
        let state = State { fluid, seen };
        self.executor.fill(forces, |i| scheme.forces(&pairs, &state, i).unwrap_or(Forces::NONE));
        Ok(())
    }
}
