//! The longest stable time step.
//!
//! ```text
//! Δt = min( C_c L / ((1 + 0.6 α) c₀ + |v|_max),  C_ν L² / ν,  C_a √(L / |a|_max) )
//! ```
//!
//! Source: J. J. Monaghan, Annu. Rev. Astron. Astrophys. 30 (1992) 543, sect. 10.3; J. P. Morris, P. J. Fox, Y. Zhu, J. Comput. Phys.
//! 136 (1997) 214, eqs. (30)–(32).

use super::Scheme;
use crate::{Influence, Scalar};

/// How much of each limit a step takes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Limits<T> {
    /// C_c, of the time in which sound crosses L.
    pub courant: T,
    /// C_ν, of the time in which momentum diffuses over L.
    pub viscous: T,
    /// C_a, of the time in which the greatest acceleration crosses L.
    pub acceleration: T,
}

impl<T: Scalar> Default for Limits<T> {
    /// 1/4, 1/8, 1/4
    fn default() -> Self {
        Self { courant: T::ratio(1, 4), viscous: T::ratio(1, 8), acceleration: T::ratio(1, 4) }
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// The longest step for a greatest speed and a greatest acceleration.
    ///
    /// ```
    /// use sph_core::fluid::{EquationOfState, wcsph::{Limits, Liquid, Scheme}};
    /// use sph_core::{CellLayout, KernelInfluence, kernel::WendlandC2};
    ///
    /// let liquid = Liquid {
    ///     equation_of_state: EquationOfState::linear(1.0_f64, 10.0)?,
    ///     gravity: [0.0, -1.0],
    ///     artificial_viscosity: 0.0,
    ///     kinematic_viscosity: 0.0,
    ///     density_diffusion: 0.1,
    ///     shift_speed: 0.0,
    /// };
    /// let influence = KernelInfluence::<f64, 2, WendlandC2>::new(0.2)?;
    /// let layout = CellLayout::bounded(&[0.0, 0.0], &[1.0, 1.0], [5, 5])?;
    /// let scheme = Scheme { liquid, influence, layout, mass: 0.01 };
    /// assert_eq!(scheme.longest_step(&Limits::default(), 0.0, 1.0), 0.25 * 0.1 / 10.0);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn longest_step(&self, limits: &Limits<T>, greatest_speed: T, greatest_acceleration: T) -> T {
        let length = self.length();
        let liquid = &self.liquid;
        let sound = liquid.equation_of_state.sound_speed();
        let wave = sound + liquid.artificial_viscosity * T::ratio(3, 5) * sound + greatest_speed;
        let mut step = limits.courant * length / wave;
        if liquid.kinematic_viscosity > T::ZERO {
            step = step.min(limits.viscous * length * length / liquid.kinematic_viscosity);
        }
        if greatest_acceleration > T::ZERO {
            step = step.min(limits.acceleration * (length / greatest_acceleration).sqrt());
        }
        step
    }
}
