//! Equations of state: the pressure of a weakly compressible liquid from its density alone.
//!
//! ```text
//! Tait    p = B ((ρ/ρ₀)⁷ − 1),  B = c₀² ρ₀ / 7      e = B/ρ₀ ((s⁶ − 1)/6 + 1/s − 1),  s = ρ/ρ₀
//! linear  p = c₀² (ρ − ρ₀)                          e = c₀² (ln s + 1/s − 1)
//! ```
//!
//! c₀ is the speed of sound at ρ₀ and e the energy of compression per mass, ∫ p/ρ² dρ from ρ₀ on. With c₀ ten times the fastest
//! flow the density varies by a hundredth.
//!
//! Sources: J. J. Monaghan, *Simulating free surface flows with SPH*, J. Comput. Phys. 110 (1994) 399, eq. (3.1); J. P. Morris,
//! P. J. Fox, Y. Zhu, J. Comput. Phys. 136 (1997) 214, eq. (11).

use crate::{Error, Parameter, Scalar, check};

/// The exponent of the Tait equation for water.
const EXPONENT: u32 = 7;

/// How pressure follows from density.
///
/// ```
/// use sph_core::fluid::EquationOfState;
/// let water = EquationOfState::tait(1000.0_f64, 20.0)?;
/// let p = water.pressure(1001.0);
/// assert!((p / 400.0 - 1.003).abs() < 1e-4); // c₀² (ρ − ρ₀) and a little more
/// assert!((water.density(p) - 1001.0).abs() < 1e-9);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EquationOfState<T> {
    rest_density: T,
    sound_speed: T,
    stiffness: T,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Kind {
    Tait,
    Linear,
}

impl<T: Scalar> EquationOfState<T> {
    /// The Tait equation with exponent 7.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::NotPositive`] for such a ρ₀ or c₀; [`Error::NotRepresentable`] where B is not.
    pub fn tait(rest_density: T, sound_speed: T) -> Result<Self, Error> {
        Self::new(rest_density, sound_speed, Kind::Tait, T::ratio(1, EXPONENT as i32))
    }

    /// Pressure in proportion to the excess density.
    ///
    /// # Errors
    /// As [`tait`](Self::tait).
    pub fn linear(rest_density: T, sound_speed: T) -> Result<Self, Error> {
        Self::new(rest_density, sound_speed, Kind::Linear, T::ONE)
    }

    fn new(rest_density: T, sound_speed: T, kind: Kind, part: T) -> Result<Self, Error> {
        check::positive(rest_density, Parameter::Density, 0)?;
        check::positive(sound_speed, Parameter::SoundSpeed, 0)?;
        let stiffness = sound_speed * sound_speed * rest_density * part;
        check::representable(stiffness, Parameter::SoundSpeed)?;
        Ok(Self { rest_density, sound_speed, stiffness, kind })
    }

    /// ρ₀
    #[inline]
    pub fn rest_density(&self) -> T {
        self.rest_density
    }

    /// c₀
    #[inline]
    pub fn sound_speed(&self) -> T {
        self.sound_speed
    }

    /// p(ρ), zero at ρ₀ and negative below.
    #[inline(always)]
    pub fn pressure(&self, density: T) -> T {
        let ratio = density / self.rest_density;
        match self.kind {
            Kind::Tait => self.stiffness * (ratio.pow::<EXPONENT>() - T::ONE),
            Kind::Linear => self.stiffness * (ratio - T::ONE),
        }
    }

    /// The density whose pressure is p; 0 where the Tait equation has none (p ≤ −B).
    pub fn density(&self, pressure: T) -> T {
        let excess = pressure / self.stiffness;
        let ratio = match self.kind {
            Kind::Tait => seventh_root_of_one_plus(excess),
            Kind::Linear => T::ONE + excess,
        };
        self.rest_density * ratio
    }

    /// e(ρ), energy of compression per mass: zero at ρ₀, positive elsewhere; infinite at ρ = 0 in floats.
    pub fn energy(&self, density: T) -> T {
        let ratio = density / self.rest_density;
        let scale = self.stiffness / self.rest_density;
        let expansion = T::ONE / ratio - T::ONE;
        let compression = match self.kind {
            Kind::Tait => (ratio.pow::<{ EXPONENT - 1 }>() - T::ONE) / T::ratio(EXPONENT as i32 - 1, 1),
            Kind::Linear => T::from_f64(libm::log(ratio.to_f64())),
        };
        scale * (compression + expansion)
    }
}

/// (1 + z)^{1/7} by Newton's method from 1 + z/7, which is never below the root, so that the steps fall towards it.
fn seventh_root_of_one_plus<T: Scalar>(z: T) -> T {
    const STEPS: u32 = 40;
    let target = T::ONE + z;
    if !target.is_above_zero() {
        return T::ZERO;
    }
    let mut root = T::ONE + z * T::ratio(1, EXPONENT as i32);
    for _ in 0..STEPS {
        let slope = root.pow::<{ EXPONENT - 1 }>().times(EXPONENT as i32);
        let next = root - (root * root.pow::<{ EXPONENT - 1 }>() - target) / slope;
        let falls = next < root;
        if !falls {
            break;
        }
        root = next;
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    fn both() -> [EquationOfState<f64>; 2] {
        [EquationOfState::tait(1000.0, 30.0).unwrap(), EquationOfState::linear(1000.0, 30.0).unwrap()]
    }

    #[test]
    fn pressures_match_the_closed_forms() {
        let [tait, linear] = both();
        assert_eq!([tait.pressure(1000.0), linear.pressure(1000.0)], [0.0; 2]);
        let exact = 900.0 * 1000.0 / 7.0 * (libm::pow(1.01, 7.0) - 1.0);
        assert!((tait.pressure(1010.0) / exact - 1.0).abs() < 1e-13);
        assert!((linear.pressure(1010.0) / 9000.0 - 1.0).abs() < 1e-13);
        for state in both() {
            let slope = (state.pressure(1000.1) - state.pressure(999.9)) / 0.2;
            assert!((slope / 900.0 - 1.0).abs() < 1e-6, "dp/dρ = c₀² at ρ₀: {slope}");
        }
    }

    #[test]
    fn density_is_the_inverse_of_pressure() {
        for state in both() {
            for density in [600.0, 990.0, 1000.0, 1000.001, 1010.0, 2000.0] {
                let found = state.density(state.pressure(density));
                assert!((found / density - 1.0).abs() < 1e-12, "{state:?} {density}: {found}");
            }
        }
        let single = EquationOfState::tait(1.0_f32, 10.0).unwrap();
        assert!((single.density(single.pressure(1.02)) - 1.02).abs() < 3e-7);
        assert_eq!(both()[0].density(-1e9), 0.0);
    }

    #[test]
    fn the_energy_is_the_work_of_compression() {
        for state in both() {
            for density in [950.0, 1005.0, 1100.0] {
                let work = crate::quadrature::integrate(|r| state.pressure(r) / (r * r), 1000.0, density);
                let energy = state.energy(density);
                assert!(energy > 0.0 && (energy / work - 1.0).abs() < 1e-9, "{density}: {energy} {work}");
            }
            assert_eq!(state.energy(1000.0), 0.0);
        }
    }

    #[test]
    fn refuses_what_is_no_liquid() {
        assert!(EquationOfState::tait(0.0, 1.0).is_err());
        assert!(EquationOfState::linear(1.0, f32::NAN).is_err());
        assert!(EquationOfState::tait(1.0_f32, 1e30).is_err());
    }
}
