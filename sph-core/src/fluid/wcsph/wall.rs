//! Walls as particles that take pressure and velocity from the fluid before them.
//!
//! ```text
//! p_w = (Σ p_j W_wj + g·Σ ρ_j x_wj W_wj) / Σ W_wj,  not below zero       v_w = −Σ v_j W_wj / Σ W_wj
//! ```
//!
//! Source: S. Adami, X. Y. Hu, N. A. Adams, *A generalized wall boundary condition for smoothed particle hydrodynamics*,
//! J. Comput. Phys. 231 (2012) 7057, eqs. (23), (27), for walls that stand still. Suction is left out, so that fluid comes free.

use super::{Lane, Pairs, Scheme, Seen};
use crate::lane::{add_vector, join_vector, scale, splat_vector, total_vector};
use crate::vector::dot;
use crate::{Influence, Scalar};

/// The sums over the fluid that make what a wall particle shows it.
#[derive(Clone, Copy)]
pub struct WallSums<T, A: Lane<T>, const D: usize> {
    norm: A::Sum,
    pressure: A::Sum,
    velocity: [A::Sum; D],
}

impl<T: Scalar, A: Lane<T>, const D: usize> WallSums<T, A, D> {
    /// Without neighbours.
    pub const EMPTY: Self = Self { norm: A::EMPTY, pressure: A::EMPTY, velocity: [A::EMPTY; D] };

    /// Adds the sums over other fluid in reach of the same wall.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        A::join(&mut self.norm, other.norm);
        A::join(&mut self.pressure, other.pressure);
        join_vector::<T, A, D>(&mut self.velocity, &other.velocity);
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Wall particle i as the fluid in reach sees it, from that fluid.
    pub fn wall(&self, pairs: &impl Pairs<T, D>, fluid: &[Seen<T, D>], i: usize) -> Seen<T, D> {
        let mut sums = WallSums::EMPTY;
        pairs.for_each_of(i, self.influence.support_radius(), |neighbour| {
            if let Some(other) = fluid.get(neighbour.index) {
                let weight = self.influence.influence(neighbour.distance_squared);
                self.add_to_wall(&mut sums, other, &neighbour.offset, weight);
            }
        });
        self.total_wall(sums)
    }

    /// Adds a fluid particle, or several side by side, to the sums of a wall: x_wj, W_wj in any unit.
    #[inline(always)]
    pub fn add_to_wall<A: Lane<T>>(
        &self,
        sums: &mut WallSums<T, A, D>,
        other: &Seen<A, D>,
        offset: &[A; D],
        weight: A,
    ) {
        let weighed = other.density * dot(&splat_vector::<T, A, D>(&self.liquid.gravity), offset);
        weight.add_to(&mut sums.norm);
        ((other.pressure + weighed) * weight).add_to(&mut sums.pressure);
        add_vector::<T, A, D>(&mut sums.velocity, &other.velocity, weight);
    }

    /// The wall that sums over all fluid in reach make: with the pressure that the fluid would have there, the density of that
    /// pressure, and the velocity that makes that of the fluid vanish at the wall's surface. Without fluid, one at rest.
    #[inline(always)]
    pub fn total_wall<A: Lane<T>>(&self, sums: WallSums<T, A, D>) -> Seen<T, D> {
        let norm = A::total(sums.norm);
        let state = &self.liquid.equation_of_state;
        if !norm.is_above_zero() {
            return self.dry_wall();
        }
        let pressure = (A::total(sums.pressure) / norm).positive_part();
        let velocity = scale(&total_vector::<T, A, D>(&sums.velocity), -(T::ONE / norm));
        Seen::new(self.mass, velocity, state.density(pressure), pressure)
    }

    /// A wall where no fluid is near.
    pub fn dry_wall(&self) -> Seen<T, D> {
        Seen::new(self.mass, [T::ZERO; D], self.liquid.equation_of_state.rest_density(), T::ZERO)
    }
}
