//! How the sums of all particles are done.

use super::{Scheme, Shape, ShapeSums, Surroundings, Wall, WallSums};
use crate::fluid::wcsph::{Pairs, Search};
use crate::lane::scale;
use crate::{Accumulator, Error, Influence, Neighbour, Scalar};

/// Does the sums over the neighbours of all particles, the first of which are fluid.
///
/// The positions are the same from one call of [`shapes`](Self::shapes) to the next: neighbours need to be found once for all.
pub trait Summation<T, const D: usize, W> {
    /// First the walls, then the shapes of the fluid.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::OutsideDomain`] for a particle that is nowhere, and what the search itself reports.
    fn shapes(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        velocities: &[[T; D]],
        shapes: &mut [Shape<T, D>],
    ) -> Result<(), Error>;

    /// P of the fluid, from the pressures of the fluid and, by them, of the walls.
    ///
    /// # Errors
    /// As [`shapes`](Self::shapes).
    fn pushes(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        shapes: &[Shape<T, D>],
        values: &[T],
        pushes: &mut [[T; D]],
    ) -> Result<(), Error>;

    /// C of the fluid, from its velocities, with what flows into walls.
    ///
    /// # Errors
    /// As [`shapes`](Self::shapes).
    fn rates(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        shapes: &[Shape<T, D>],
        velocities: &[[T; D]],
        rates: &mut [T],
    ) -> Result<(), Error>;
}

/// A search, and sums pair by pair in the order in which it finds them. Every sum searches anew.
#[derive(Debug)]
pub struct OneByOne<'a, S, T> {
    /// Finds neighbours.
    pub search: S,
    /// The walls, in the order of their numbers.
    pub walls: &'a mut [Wall<T>],
    /// A number for each wall particle.
    pub wall_values: &'a mut [T],
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    fn surroundings(&self, neighbour: &Neighbour<T, D>) -> Surroundings<T, D> {
        let slope = self.volume * self.influence.slope(neighbour.distance_squared);
        Surroundings {
            offset: neighbour.offset,
            influence: self.volume * self.influence.influence(neighbour.distance_squared),
            gradient: scale(&neighbour.offset, slope),
        }
    }

    /// Visits the surroundings of particle i: the number of each neighbour, and where it is.
    fn each_around(
        &self,
        pairs: &impl Pairs<T, D>,
        i: usize,
        mut visit: impl FnMut(usize, &Surroundings<T, D>),
    ) {
        pairs.for_each_of(i, self.influence.support_radius(), |neighbour| {
            visit(neighbour.index, &self.surroundings(&neighbour));
        });
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>, S: Search<T, D>> Summation<T, D, W>
    for OneByOne<'_, S, T>
{
    fn shapes(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        velocities: &[[T; D]],
        shapes: &mut [Shape<T, D>],
    ) -> Result<(), Error> {
        let fluid = shapes.len();
        let pairs = self.search.find(&scheme.layout, positions, fluid)?;
        for (k, wall) in self.walls.iter_mut().enumerate() {
            let mut sums = WallSums::<T, T>::EMPTY;
            scheme.each_around(&pairs, fluid.wrapping_add(k), |j, at| {
                if j < fluid {
                    scheme.add_to_wall(&mut sums, at);
                }
            });
            *wall = scheme.total_wall(sums);
        }
        for (i, (shape, own)) in shapes.iter_mut().zip(velocities).enumerate() {
            let mut sums = ShapeSums::<T, T, D>::EMPTY;
            scheme.each_around(&pairs, i, |j, at| {
                if let Some(other) = velocities.get(j) {
                    scheme.add_fluid(&mut sums, own, other, at);
                } else if let Some(wall) = self.walls.get(j.wrapping_sub(fluid)) {
                    scheme.add_wall(&mut sums, [wall.head, wall.stiffness], at);
                }
            });
            *shape = scheme.total_shape(sums);
        }
        Ok(())
    }

    fn pushes(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        shapes: &[Shape<T, D>],
        values: &[T],
        pushes: &mut [[T; D]],
    ) -> Result<(), Error> {
        let fluid = shapes.len();
        let pairs = self.search.find(&scheme.layout, positions, fluid)?;
        for (k, (value, wall)) in self.wall_values.iter_mut().zip(self.walls.iter()).enumerate() {
            let mut sum = T::Sum::ZERO;
            scheme.each_around(&pairs, fluid.wrapping_add(k), |j, at| {
                if let Some(&value) = values.get(j) {
                    sum.add(at.influence * value);
                }
            });
            *value = sum.total() * wall.weight;
        }
        for (i, ((push, shape), &own)) in pushes.iter_mut().zip(shapes).zip(values).enumerate() {
            let mut sums = [T::Sum::ZERO; D];
            scheme.each_around(&pairs, i, |j, at| {
                let value = values.get(j).or_else(|| self.wall_values.get(j.wrapping_sub(fluid)));
                if let Some(&value) = value {
                    scheme.add_push::<T>(&mut sums, value, &at.gradient);
                }
            });
            *push = scheme.total_push::<T>(own, shape, &sums);
        }
        Ok(())
    }

    fn rates(
        &mut self,
        scheme: &Scheme<T, D, W>,
        positions: &[[T; D]],
        shapes: &[Shape<T, D>],
        velocities: &[[T; D]],
        rates: &mut [T],
    ) -> Result<(), Error> {
        let fluid = shapes.len();
        let pairs = self.search.find(&scheme.layout, positions, fluid)?;
        for (k, (value, wall)) in self.wall_values.iter_mut().zip(self.walls.iter()).enumerate() {
            let mut flow = T::Sum::ZERO;
            scheme.each_around(&pairs, fluid.wrapping_add(k), |j, at| {
                if let Some(velocity) = velocities.get(j) {
                    scheme.add_flow::<T>(&mut flow, velocity, &at.gradient);
                }
            });
            *value = -(flow.total() * wall.weight);
        }
        for (i, ((rate, shape), own)) in rates.iter_mut().zip(shapes).zip(velocities).enumerate() {
            let (mut flow, mut of_walls) = (T::Sum::ZERO, T::Sum::ZERO);
            scheme.each_around(&pairs, i, |j, at| {
                if let Some(velocity) = velocities.get(j) {
                    scheme.add_flow::<T>(&mut flow, velocity, &at.gradient);
                } else if let Some(&value) = self.wall_values.get(j.wrapping_sub(fluid)) {
                    of_walls.add(at.influence * value);
                }
            });
            *rate = scheme.total_rate::<T>(own, shape, flow, of_walls);
        }
        Ok(())
    }
}
