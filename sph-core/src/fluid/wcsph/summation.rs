//! How the sums of all particles are done.

use super::{Forces, ParticleStates, Scheme, Search, Seen};
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

/// A search, and sums pair by pair in the order in which it finds them.
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct OneByOne<S>(pub S);

impl<T: Scalar, const D: usize, W: Influence<T, D>, S: Search<T, D>> Summation<T, D, W> for OneByOne<S> {
    fn rates(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        seen: &[Seen<T, D>],
        rates: &mut [T],
    ) -> Result<(), Error> {
        let fluid = rates.len();
        let pairs = self.0.find(&scheme.layout, positions, fluid)?;
        let state = ParticleStates { fluid, seen };
        for (i, rate) in rates.iter_mut().enumerate() {
            *rate = scheme.density_rate(&pairs, &state, i).unwrap_or(T::ZERO);
        }
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
        let pairs = self.0.find(&scheme.layout, positions, fluid)?;
        if let Some((of_fluid, of_walls)) = seen.split_at_mut_checked(fluid) {
            for (wall, seen) in of_walls.iter_mut().enumerate() {
                *seen = scheme.wall(&pairs, of_fluid, fluid.wrapping_add(wall));
            }
        }
        let state = ParticleStates { fluid, seen };
        for (i, force) in forces.iter_mut().enumerate() {
            *force = scheme.forces(&pairs, &state, i).unwrap_or(Forces::NONE);
        }
        Ok(())
    }
}
