//! The number formats of a study.

use std::fmt::{Display, Formatter};

use sph_lab::{Choice, Chosen, Format, MiniFormat};

use super::measure::{Measured, Refusal, measure};
use super::set::Patch;
use super::units::Units;
use crate::kernel_choice::KernelName;

/// Fewer fraction bits than these move a particle by more than the search allows for.
pub(super) const LEAST_FRACTION: u32 = 4;

/// A number format that is chosen when the program runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NumberFormat {
    /// Fixed point.
    Fixed(Format),
    /// Floating point or posits of few bits.
    Mini(MiniFormat),
}

impl NumberFormat {
    /// All bits of a number.
    #[must_use]
    pub fn bits(self) -> u32 {
        match self {
            Self::Fixed(format) => format.bits(),
            Self::Mini(format) => format.bits(),
        }
    }

    /// The fields at the points of a patch in this format.
    pub(super) fn measure<const D: usize>(
        self,
        patch: &Patch<D>,
        kernel: KernelName,
        units: &Units<D>,
    ) -> Result<Measured, Refusal> {
        let choice = match self {
            Self::Fixed(format) => Choice::Emulated(format),
            Self::Mini(format) => Choice::Mini(format),
        };
        choice.scope(|| measure::<Chosen, D>(patch, kernel, units))
    }
}

impl Display for NumberFormat {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Fixed(format) => Display::fmt(format, f),
            Self::Mini(format) => Display::fmt(format, f),
        }
    }
}
