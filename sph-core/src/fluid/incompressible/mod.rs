//! Incompressible SPH: the pressure by a constraint that is solved in every step, so that the step is as long as the flow allows and
//! not as sound does.
//!
//! ```text
//! δ_i     = Σ V W_ij                           relative density, 1 on the lattice of the fluid
//! C_i(u)  = Σ V (u_i − u_j)·∇W_ij              dδ_i/dt under velocities u; walls stand still
//! P_i(q)  = −Σ V (q_i + q_j) ∇W_ij             acceleration by pressures q = p/ρ₀
//!
//! v′ = v* + P(q) Δt,    x′ = x + v′ Δt         with q ≥ 0,   C(v′) Δt + χ(δ) (δ − 1) ≤ 0,   one of the two zero at every particle
//! ```
//!
//! v* has gravity and viscosity. χ(δ), a part of an excess or of a lack of density, brings the volume back in some five or twenty
//! steps: what an unfinished solution leaves, and what C, which lets the fluid expand, does not see. P is minus the adjoint of C,
//! forces between particles are central, and positions move along velocities alone: momentum and angular momentum are kept to rounding.
//! It is least squares over values that are not negative, solved by projected gradients with momentum.
//!
//! | file | what | source |
//! |---|---|---|
//! | `shape`, `pressure` | the constraint, in pairs | J. Bender, D. Koschier, *Divergence-free smoothed particle hydrodynamics*, Symp. Computer Animation (2015) 147; M. Ihmsen, J. Cornelis, B. Solenthaler, C. Horvath, M. Teschner, *Implicit incompressible SPH*, IEEE Trans. Vis. Comput. Graph. 20 (2014) 426 |
//! | `wall` | the pressure of wall particles | S. Adami, X. Y. Hu, N. A. Adams, J. Comput. Phys. 231 (2012) 7057 |
//! | `solve` | projected gradients with momentum, Jacobi's diagonal | A. Beck, M. Teboulle, SIAM J. Imaging Sci. 2 (2009) 183; restarts: B. O'Donoghue, E. Candès, Found. Comput. Math. 15 (2015) 715 |
//! | `step` | velocities, then positions | S. J. Cummins, M. Rudman, J. Comput. Phys. 152 (1999) 584; χ as J. Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1 stabilises a constraint |
//!
//! The terms of a pair are written for a [`Lane`](crate::Lane): for one scalar, as [`OneByOne`] sums them here, or for several pairs side by
//! side, as another [`Summation`] may. Particles are numbered fluid first, then walls, which stand still, several layers deep, as
//! many as the support reaches, with the spacing of the fluid. A free surface needs nothing: a particle with less than half the
//! density has no pressure.

mod pressure;
mod shape;
mod solve;
mod step;
mod summation;
mod wall;

pub use shape::{Shape, ShapeSums, Surroundings};
pub use step::{Outcome, Particles};
pub use summation::{OneByOne, Summation};
pub use wall::{Wall, WallSums};

use crate::{CellLayout, Influence, Scalar};

/// A liquid in SPH: what it feels, the influence, the cells that particles are sorted in, the size of each.
#[derive(Clone, Copy, Debug)]
pub struct Scheme<T, const D: usize, W> {
    /// ρ₀
    pub rest_density: T,
    /// g, any acceleration that all particles feel.
    pub gravity: [T; D],
    /// α c₀ L of Monaghan's artificial viscosity, in L²/T, between fluid particles that approach each other.
    pub viscosity: T,
    /// W, and with it the support radius.
    pub influence: W,
    /// The cells of the search; periodic axes are periodic for the liquid.
    pub layout: CellLayout<T, D>,
    /// The distance of particles on the first lattice.
    pub spacing: T,
    /// V, one over the sum of W over that lattice.
    pub volume: T,
    /// The box that particles are put back into, from where to where along each axis.
    pub inside: [[T; 2]; D],
    /// How the constraints are solved.
    pub tuning: Tuning<T>,
}

/// How the constraints are solved, and how long a step is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Tuning<T> {
    /// What the constraint may be off in a step in one row of particles, and so much more for each spacing that the fastest particle
    /// moves: 4·10⁻⁴ and 10⁻². The mean over all at which the solution ends is that over the number of rows, the D-th root of the
    /// number of particles: in a deep fluid that begins to fall, the lowest row alone is pressed.
    pub tolerances: [T; 2],
    /// Iterations at least.
    pub least_iterations: u32,
    /// Iterations at most.
    pub most_iterations: u32,
    /// χ of a lack of density: the part that a step may close, without which the fluid swells. 0.05.
    pub closing: T,
    /// χ of an excess of density: the part that a step opens. 0.2.
    pub opening: T,
    /// ω, one over the greatest eigenvalue, see [`Scheme::estimate_relaxation`].
    pub relaxation: T,
    /// Spacings that the fastest particle moves in a step: 0.6.
    pub courant: T,
    /// g Δt²/Δx at most: 0.003. It binds at rest, where nothing else does.
    pub acceleration: T,
}

impl<T: Scalar> Default for Tuning<T> {
    fn default() -> Self {
        Self {
            tolerances: [T::from_f64(4e-4), T::from_f64(1e-2)],
            least_iterations: 2,
            most_iterations: 200,
            closing: T::ratio(1, 20),
            opening: T::ratio(1, 5),
            relaxation: T::ratio(1, 5),
            courant: T::ratio(3, 5),
            acceleration: T::ratio(3, 1000),
        }
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// L, half the support radius.
    #[inline]
    pub fn length(&self) -> T {
        self.influence.support_radius() * T::ratio(1, 2)
    }

    /// The longest step while the fastest particle has this speed; [`Scalar::MAX`] at rest without gravity.
    pub fn longest_step(&self, greatest_speed: T) -> T {
        let Tuning { courant, acceleration, .. } = self.tuning;
        let mut step = T::MAX;
        if greatest_speed > T::ZERO {
            step = step.min(courant * self.spacing / greatest_speed);
        }
        let gravity = crate::vector::norm_squared(&self.gravity).sqrt();
        if gravity > T::ZERO {
            step = step.min((acceleration * self.spacing / gravity).sqrt());
        }
        if self.viscosity > T::ZERO {
            step = step.min(T::ratio(2, 5) * self.length() * self.length() / self.viscosity);
        }
        step
    }
}
