//! What is wrong with the arguments of a constructor, in one small [`Copy`] value.
//!
//! Only constructors and whole-set operations return an [`Error`]; inner loops cannot fail.

use core::fmt;

/// The argument an [`Error`] speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Parameter {
    /// h, the radius beyond which the kernel vanishes.
    SupportRadius,
    /// Positions x_i.
    Position,
    /// Masses m_i.
    Mass,
    /// Densities ρ_i.
    Density,
    /// Volumes V_i = m_i / ρ_i.
    Volume,
    /// The values A_i of a field.
    Value,
    /// A caller's output slice.
    Output,
    /// The neighbours of one point.
    Neighbours,
    /// An axis of a domain: its bounds or its cell size.
    Axis,
    /// The cells of a grid.
    Cells,
    /// The entries of a grid, one for each sample.
    Entries,
    /// The kernel's normalisation σ_D h^{-D}.
    Normalisation,
    /// The particles of a fluid.
    Particles,
    /// Velocities v_i.
    Velocity,
    /// c₀, the speed of sound of an equation of state.
    SoundSpeed,
}

impl Parameter {
    const fn name(self) -> &'static str {
        match self {
            Self::SupportRadius => "support radius",
            Self::Position => "position",
            Self::Mass => "mass",
            Self::Density => "density",
            Self::Volume => "volume",
            Self::Value => "value",
            Self::Output => "output",
            Self::Neighbours => "neighbours",
            Self::Axis => "axis",
            Self::Cells => "cells",
            Self::Entries => "entries",
            Self::Normalisation => "normalisation",
            Self::Particles => "particles",
            Self::Velocity => "velocity",
            Self::SoundSpeed => "sound speed",
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Why a constructor or a whole-set operation refused its arguments.
///
/// ```
/// use sph_core::{Error, KernelInfluence, Parameter, kernel::CubicSpline};
/// let refused = KernelInfluence::<f32, 2, CubicSpline>::new(-1.0);
/// assert_eq!(refused.unwrap_err(), Error::NotPositive { parameter: Parameter::SupportRadius, index: 0 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A value is NaN, infinite, or a fixed-point number that overflowed.
    NotFinite {
        /// Which argument.
        parameter: Parameter,
        /// Where in it; 0 for a single value.
        index: usize,
    },
    /// A value must be greater than zero and is not.
    NotPositive {
        /// Which argument.
        parameter: Parameter,
        /// Where in it; 0 for a single value.
        index: usize,
    },
    /// Two arguments that belong together differ in length.
    LengthMismatch {
        /// The argument whose length is wrong.
        parameter: Parameter,
        /// The length it must have.
        expected: usize,
        /// The length it has.
        found: usize,
    },
    /// A bounded container is too small.
    CapacityExceeded {
        /// What was to be held.
        parameter: Parameter,
        /// How many fit.
        capacity: usize,
        /// How many there are.
        needed: usize,
    },
    /// The value has no representation in the scalar: it overflows, or underflows to zero.
    NotRepresentable {
        /// Which quantity.
        parameter: Parameter,
    },
    /// The kernel diverges at r = 0, so no density or interpolation can be made with it.
    SingularKernel,
    /// A position lies outside a periodic axis.
    OutsideDomain {
        /// The sample.
        index: usize,
        /// The axis, from 0.
        axis: usize,
    },
}

impl Error {
    /// The same error about element `index`, where the error has one.
    pub(crate) fn at(self, index: usize) -> Self {
        match self {
            Self::NotFinite { parameter, .. } => Self::NotFinite { parameter, index },
            Self::NotPositive { parameter, .. } => Self::NotPositive { parameter, index },
            other => other,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite { parameter, index } => write!(f, "{parameter} {index} is not finite"),
            Self::NotPositive { parameter, index } => {
                write!(f, "{parameter} {index} is not greater than zero")
            }
            Self::LengthMismatch { parameter, expected, found } => {
                write!(f, "{parameter}: expected {expected} values, found {found}")
            }
            Self::CapacityExceeded { parameter, capacity, needed } => {
                write!(f, "{parameter}: capacity {capacity}, needed {needed}")
            }
            Self::NotRepresentable { parameter } => {
                write!(f, "{parameter} is outside the range of the scalar: choose units nearer to 1")
            }
            Self::SingularKernel => f.write_str(
                "the kernel diverges at r = 0: it is for viscosity forces, not for density or interpolation",
            ),
            Self::OutsideDomain { index, axis } => {
                write!(f, "position {index} lies outside the periodic axis {axis}")
            }
        }
    }
}

impl core::error::Error for Error {}

/// The text of `Display`, for a probe's console.
#[cfg(feature = "defmt")]
impl defmt::Format for Parameter {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{=str}", self.name());
    }
}

/// The text of `Display`; what does not change stays on the host.
#[cfg(feature = "defmt")]
impl defmt::Format for Error {
    fn format(&self, f: defmt::Formatter<'_>) {
        match *self {
            Self::NotFinite { parameter, index } => {
                defmt::write!(f, "{} {=usize} is not finite", parameter, index);
            }
            Self::NotPositive { parameter, index } => {
                defmt::write!(f, "{} {=usize} is not greater than zero", parameter, index);
            }
            Self::LengthMismatch { parameter, expected, found } => {
                defmt::write!(f, "{}: expected {=usize} values, found {=usize}", parameter, expected, found);
            }
            Self::CapacityExceeded { parameter, capacity, needed } => {
                defmt::write!(f, "{}: capacity {=usize}, needed {=usize}", parameter, capacity, needed);
            }
            Self::NotRepresentable { parameter } => {
                defmt::write!(
                    f,
                    "{} is outside the range of the scalar: choose units nearer to 1",
                    parameter
                );
            }
            Self::SingularKernel => defmt::write!(
                f,
                "the kernel diverges at r = 0: it is for viscosity forces, not for density or interpolation"
            ),
            Self::OutsideDomain { index, axis } => {
                defmt::write!(f, "position {=usize} lies outside the periodic axis {=usize}", index, axis);
            }
        }
    }
}
