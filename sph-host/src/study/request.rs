//! What can be asked of a study.

use std::ops::RangeInclusive;

use sph_lab::{MiniFormat, Overflow, Rounding};

use super::costs::Target;
use crate::kernel_choice::KernelName;
use crate::named_enum::named_enum;
use crate::sample::{Only, ParticleSource, SupportFrom};

named_enum! {
    /// What the error is measured of.
    Quantity {
        Density, "density", "ρ = Σ m W, relative to the largest density";
        Interpolation, "interpolation", "A = Σ V A W, relative to the largest |A|";
        Gradient, "gradient", "∇A = Σ V A ∇W, relative to the largest |∇A|";
    }
}

impl Quantity {
    /// The largest relative error that a format may have where nothing else is asked for.
    #[must_use]
    pub fn usual_goal(self) -> f64 {
        match self {
            Self::Density | Self::Interpolation => 1e-3,
            Self::Gradient => 1e-2,
        }
    }

    /// One thing for each quantity, in the order of [`Quantity::ALL`].
    pub(super) fn each<R>(of: impl Fn(Self) -> R) -> [R; 3] {
        [of(Self::Density), of(Self::Interpolation), of(Self::Gradient)]
    }

    /// Its place in [`Quantity::ALL`].
    pub(super) fn index(self) -> usize {
        self as usize
    }
}

named_enum! {
    /// Which units the numbers of the formats have.
    UnitChoice {
        Auto, "auto", "the support radius and the mean density are near 1, the origin is the middle of the particles";
        File, "file", "those of the file, from its own origin";
    }
}

/// Everything that can be asked for at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The particles.
    pub particles: ParticleSource,
    /// Support radii; none: the set's own, or an error.
    pub support: Option<SupportFrom>,
    /// Particles are taken where all of these hold.
    pub only: Vec<Only>,
    /// The mass of every particle, over a column.
    pub mass: Option<f64>,
    /// 1 to 3, where the particles' own number of coordinates is not meant.
    pub dim: Option<usize>,
    /// The fields by name; none: the first numeric array that is not special, which stands for all, since errors are relative.
    pub fields: Vec<String>,
    /// The kernels to choose from.
    pub kernels: Vec<KernelName>,
    /// What the error is measured of, each with the largest that is good enough.
    pub goals: Vec<(Quantity, f64)>,
    /// How many bits a number may have.
    pub bits: RangeInclusive<u32>,
    /// How results are rounded. To nearest is always among them: the recommendation is rounded so, as compiled types are.
    pub roundings: Vec<Rounding>,
    /// What becomes of results that are out of range, that of the recommendation first.
    pub overflows: Vec<Overflow>,
    /// Floating-point formats to compare with.
    pub also: Vec<MiniFormat>,
    /// Integer bits to have beyond those that are needed.
    pub margin: u32,
    /// Whether rigorous bounds are computed.
    pub bound: bool,
    /// The units.
    pub units: UnitChoice,
    /// The processor whose instructions are told.
    pub target: Target,
    /// Threads; none: one for each core.
    pub threads: Option<usize>,
}
