//! The estimates of sph-core by name.

use clap::ValueEnum;
use sph_core::Error;
use sph_core::field::{Corrected, Plain, PlainWithGradient, Shepard, ShepardWithGradient};
use sph_core::kernel::Kernel;

use super::fields::{Estimates, Fields};
use super::simd::Real;

/// Lists the estimates: name, what gives the value, and what gives the value and the gradient.
macro_rules! estimates {
    ($($(#[$attribute:meta])* $Name:ident: $Value:ty, $WithGradient:ty;)*) => {
        /// Which sum stands for a field.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
        pub enum EstimateName {
            $($(#[$attribute])* $Name,)*
        }

        impl EstimateName {
            /// All estimates.
            pub const ALL: &'static [Self] = &[$(Self::$Name),*];
        }

        impl<T: Real, const D: usize> Fields<'_, T, D> {
            /// The plain sums and the estimated fields at points, in any order; points that are close together in space cost less
            /// when they come together, so they are sorted first.
            ///
            /// # Errors
            /// As [`at`](Self::at).
            pub fn estimate<K: Kernel>(
                &self,
                estimate: EstimateName,
                points: &[[T; D]],
                gradient: bool,
            ) -> Result<Estimates<T>, Error> {
                match (estimate, gradient) {
                    $((EstimateName::$Name, false) => self.estimate_by::<K, Plain, $Value>(points, false),
                    (EstimateName::$Name, true) => {
                        self.estimate_by::<K, PlainWithGradient, $WithGradient>(points, true)
                    })*
                }
            }
        }
    };
}

estimates! {
    /// Σ m/ρ A W, the paper's interpolation
    #[default]
    Plain: Plain, PlainWithGradient;
    /// divided by Σ m/ρ W: exact for constants
    Shepard: Shepard, ShepardWithGradient;
    /// linear moving least squares: exact for linear fields
    Corrected: Corrected, Corrected;
}
