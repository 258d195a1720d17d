//! Walls as particles that take pressure and velocity from the fluid before them.
//!
//! ```text
//! p_w = (Σ p_j W_wj + g·Σ ρ_j x_wj W_wj) / Σ W_wj,  not below zero       v_w = −Σ v_j W_wj / Σ W_wj
//! ```
//!
//! Source: S. Adami, X. Y. Hu, N. A. Adams, *A generalized wall boundary condition for smoothed particle hydrodynamics*,
//! J. Comput. Phys. 231 (2012) 7057, eqs. (23), (27), for walls that stand still. Suction is left out, so that fluid comes free.

use super::{Pairs, Scheme, State};
use crate::field::Quantity;
use crate::fluid::EquationOfState;
use crate::vector::{dot, scale};
use crate::{Accumulator, Influence, Scalar};

/// What a wall particle shows the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WallState<T, const D: usize> {
    /// The pressure that the fluid would have there, zero where no fluid is near.
    pub pressure: T,
    /// The density of that pressure.
    pub density: T,
    /// The velocity that makes that of the fluid vanish at the wall's surface: what viscosity sees.
    pub velocity: [T; D],
}

impl<T: Scalar, const D: usize> WallState<T, D> {
    /// Where no fluid is near.
    pub(super) fn at_rest(state: &EquationOfState<T>) -> Self {
        Self { pressure: T::ZERO, density: state.rest_density(), velocity: [T::ZERO; D] }
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// The state of wall particle i from the fluid in reach; `None` where there is no such particle.
    pub fn wall(&self, pairs: &impl Pairs<T, D>, state: &State<T, D>, i: usize) -> Option<WallState<T, D>> {
        state.seen.get(i)?;
        let (mut norm, mut pressure) = (T::Sum::ZERO, T::Sum::ZERO);
        let mut velocity = <[T; D] as Quantity<T>>::EMPTY;
        pairs.for_each_of(i, self.influence.support_radius(), |neighbour| {
            if neighbour.index >= state.fluid {
                return;
            }
            let Some(other) = state.seen.get(neighbour.index) else { return };
            let weight = self.influence.influence(neighbour.distance_squared);
            let weighed = other.density * dot(&self.liquid.gravity, &neighbour.offset);
            norm.add(weight);
            pressure.add((other.pressure + weighed) * weight);
            other.velocity.add_to(&mut velocity, weight);
        });
        let norm = norm.total();
        let state = &self.liquid.equation_of_state;
        if !norm.is_above_zero() {
            return Some(WallState::at_rest(state));
        }
        let pressure = (pressure.total() / norm).positive_part();
        let velocity = scale(&<[T; D]>::total(velocity), -(T::ONE / norm));
        Some(WallState { pressure, density: state.density(pressure), velocity })
    }
}
