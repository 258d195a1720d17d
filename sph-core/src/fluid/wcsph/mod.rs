//! Weakly compressible SPH: pressure by an [equation of state](super::eos), density by the continuity equation.
//!
//! ```text
//! dρ_i/dt = Σ m (v_i − v_j)·∇W_ij + 2 δ L c₀ Σ V_j ((ρ_i − ρ_j) + ½ (∇ρ_i + ∇ρ_j)·x_ji) F_ij
//! dv_i/dt = −Σ m (p_i/ρ_i² + p_j/ρ_j² + Π_ij) ∇W_ij + ν Σ m (1/ρ_i + 1/ρ_j) (v_i − v_j) F_ij + g
//! Π_ij    = −α c₀ L (v_ij·x_ij) / (ρ̄_ij (r² + 0.01 L²)) where v_ij·x_ij < 0, else 0
//! F_ij    = x_ij·∇W_ij / r² ≤ 0,   V_j = m/ρ_j,   L = half the support radius
//! ```
//!
//! Every sum is a gather at one particle in the order of the search, so any number of threads gives the same bits. The terms of a
//! pair are equal and opposite at its two ends: linear momentum is kept to rounding, angular momentum too where ν = 0.
//!
//! | file | sum | source |
//! |---|---|---|
//! | `continuity` | density, with the diffusion of δ-SPH | Antuono, Colagrossi, Marrone, Molteni, Comput. Phys. Commun. 181 (2010) 532; without ∇ρ: Molteni, Colagrossi, ibid. 180 (2009) 861 |
//! | `momentum` | pressure, viscosity | Monaghan, Annu. Rev. Astron. Astrophys. 30 (1992) 543; Morris, Fox, Zhu, J. Comput. Phys. 136 (1997) 214 |
//! | `gradient` | the density gradient of that diffusion | as there |
//! | `momentum` | shifting | Sun, Colagrossi, Marrone, Antuono, Zhang, Comput. Methods Appl. Mech. Eng. 348 (2019) 912, with the stress of Adami, Hu, Adams, J. Comput. Phys. 241 (2013) 292 |
//! | `wall` | pressure and velocity of wall particles | Adami, Hu, Adams, J. Comput. Phys. 231 (2012) 7057 |
//! | `step` | kick, drift, kick | the same, sect. 2.6 |
//!
//! The terms of a pair are written for a [`Lane`]: for one scalar, as [`OneByOne`] sums them here, or for several pairs side by
//! side, as another [`Summation`] may.
//!
//! Particles are numbered fluid first, then walls. Wall particles stand still, several layers deep, as many as the support
//! reaches, with the spacing and the mass of the fluid. A free surface needs nothing: the sums miss what is not there.

mod continuity;
mod gradient;
mod momentum;
mod pairs;
mod step;
mod summation;
mod time_step;
mod wall;

#[cfg(test)]
mod tests;

pub use continuity::RateSums;
pub use momentum::{ForceSums, Forces};
pub use pairs::{CellStorage, Pairs, Search};
pub use step::Particles;
pub use summation::{OneByOne, Summation};
pub use time_step::Limits;
pub use wall::WallSums;

use super::EquationOfState;
use crate::{CellLayout, Influence, Lane, Scalar};

/// The liquid, and how it is stabilised.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Liquid<T, const D: usize> {
    /// Pressure from density.
    pub equation_of_state: EquationOfState<T>,
    /// g, any acceleration that all particles feel.
    pub gravity: [T; D],
    /// α of Monaghan's artificial viscosity, between fluid particles alone: walls are smooth to it.
    pub artificial_viscosity: T,
    /// ν of the laminar viscosity. Where it is not zero, walls hold the fluid fast (no slip).
    pub kinematic_viscosity: T,
    /// δ of the density diffusion, 0.1 as a rule.
    pub density_diffusion: T,
    /// u_s, the greatest speed of the flow, that particles are shifted with into even order; zero for none, as a free surface
    /// wants it.
    pub shift_speed: T,
}

/// A liquid in SPH: the influence, the cells that particles are sorted in, the mass of each.
#[derive(Clone, Copy, Debug)]
pub struct Scheme<T, const D: usize, W> {
    /// The liquid.
    pub liquid: Liquid<T, D>,
    /// W, and with it the support radius.
    pub influence: W,
    /// The cells of the search; periodic axes are periodic for the liquid.
    pub layout: CellLayout<T, D>,
    /// m, of every particle.
    pub mass: T,
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// L, half the support radius: the length in artificial viscosity, diffusion and time steps.
    #[inline]
    pub fn length(&self) -> T {
        self.influence.support_radius() * T::ratio(1, 2)
    }
}

/// What the sums read of all particles: `fluid` of them liquid, the rest walls.
#[derive(Clone, Copy, Debug)]
pub struct ParticleStates<'a, T, const D: usize> {
    /// How many particles are fluid.
    pub fluid: usize,
    /// Each particle as its neighbours see it.
    pub seen: &'a [Seen<T, D>],
}

/// One particle as its neighbours see it, with the quotients that each of them would work out again; or several side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Seen<A, const D: usize> {
    /// v_j; of a wall particle the velocity that viscosity sees.
    pub velocity: [A; D],
    /// ρ_j
    pub density: A,
    /// p_j
    pub pressure: A,
    /// V_j = m/ρ_j
    pub volume: A,
    /// p_j/ρ_j²
    pub pressure_term: A,
    /// ∇ρ_j; zero of a wall.
    pub density_gradient: [A; D],
    /// δv_j, with which it is shifted; zero of a wall.
    pub shift_velocity: [A; D],
}

impl<T: Scalar, const D: usize> Seen<T, D> {
    /// No particle yet.
    pub const NONE: Self = Self {
        velocity: [T::ZERO; D],
        density: T::ONE,
        pressure: T::ZERO,
        volume: T::ZERO,
        pressure_term: T::ZERO,
        density_gradient: [T::ZERO; D],
        shift_velocity: [T::ZERO; D],
    };

    /// A particle of mass m, among others of its density and not shifted.
    #[inline(always)]
    pub fn new(mass: T, velocity: [T; D], density: T, pressure: T) -> Self {
        let (volume, pressure_term) = (mass / density, pressure / (density * density));
        Self { velocity, density, pressure, volume, pressure_term, ..Self::NONE }
    }
}

/// A neighbour from where a particle stands, or several side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pair<A, const D: usize> {
    /// x_ij = x_i − x_j
    pub offset: [A; D],
    /// s with ∇W_ij = s x_ij (see [`Influence::slope`]).
    pub slope: A,
}
