//! The estimates of a field by name.

use crate::named_enum::named_enum;

/// Calls a macro with the list of the estimates, and then with what follows `;`. Of each: its variant, name and description,
/// sph-core's estimate of the value, the one of value and gradient, and whether masses matter to it beyond their ratios.
macro_rules! for_each_estimate {
    ($($callback:tt)::+ $(; $($context:tt)*)?) => {
        $($callback)::+! {
            [
                Plain "plain" "Σ m/ρ A W, the paper's interpolation" Plain PlainWithGradient true;
                Shepard "shepard" "divided by Σ m/ρ W: exact for constants" Shepard ShepardWithGradient false;
                Corrected "corrected" "linear moving least squares: exact for linear fields" Corrected Corrected true;
            ]
            $($($context)*)?
        }
    };
}
pub(crate) use for_each_estimate;

/// What follows from the list.
macro_rules! choices {
    ([$($Name:ident $name:literal $about:literal $Value:ident $WithGradient:ident $needs_mass:literal;)+]) => {
        named_enum! {
            /// Which sum stands for a field.
            Estimate { $($Name, $name, $about;)+ }
        }

        impl Estimate {
            /// Whether masses matter beyond their ratios.
            #[must_use]
            pub fn needs_mass(self) -> bool {
                match self {
                    $(Self::$Name => $needs_mass,)+
                }
            }
        }
    };
}
for_each_estimate!(choices);

/// Evaluates an expression with `E` standing for sph-core's estimate of the `value` of an [`Estimate`], or of value and `gradient`.
macro_rules! with_estimate {
    (
        [$($Name:ident $name:literal $about:literal $Value:ident $WithGradient:ident $needs_mass:literal;)+]
        $estimate:expr, value $E:ident => $body:expr
    ) => {
        match $estimate {
            $($crate::estimate_choice::Estimate::$Name => {
                type $E = sph_core::field::$Value;
                $body
            })+
        }
    };
    (
        [$($Name:ident $name:literal $about:literal $Value:ident $WithGradient:ident $needs_mass:literal;)+]
        $estimate:expr, gradient $E:ident => $body:expr
    ) => {
        match $estimate {
            $($crate::estimate_choice::Estimate::$Name => {
                type $E = sph_core::field::$WithGradient;
                $body
            })+
        }
    };
    ($estimate:expr, $what:ident $E:ident => $body:expr) => {
        $crate::estimate_choice::for_each_estimate!(
            $crate::estimate_choice::with_estimate; $estimate, $what $E => $body
        )
    };
}
pub(crate) use with_estimate;
