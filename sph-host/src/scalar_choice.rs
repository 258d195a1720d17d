//! The scalars by name.

use clap::ValueEnum;

/// A number type as the command line names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ScalarName {
    /// 64-bit floating point
    F64,
    /// 32-bit floating point
    F32,
    /// 32-bit floating point with micromath's approximations
    Fast32,
    /// fixed point, 16 integer and 16 fraction bits, saturating
    I16f16,
    /// fixed point, 8 integer and 24 fraction bits, saturating
    I8f24,
    /// fixed point, 4 integer and 28 fraction bits, saturating
    I4f28,
    /// fixed point, 32 integer and 32 fraction bits, saturating
    I32f32,
}

impl ScalarName {
    /// All scalars.
    pub const ALL: &'static [Self] =
        &[Self::F64, Self::F32, Self::Fast32, Self::I16f16, Self::I8f24, Self::I4f28, Self::I32f32];

    /// The name on the command line, such as `i16f16`.
    #[must_use]
    pub fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

/// Evaluates an expression with `T` standing for the type of a [`ScalarName`].
macro_rules! with_scalar {
    ($name:expr, $T:ident => $body:expr) => {{
        use sph_core::scalar::fast::Fast32;
        use sph_core::scalar::fixed::{I4F28, I8F24, I16F16, I32F32, Saturating};
        use $crate::scalar_choice::ScalarName;
        match $name {
            ScalarName::F64 => {
                type $T = f64;
                $body
            }
            ScalarName::F32 => {
                type $T = f32;
                $body
            }
            ScalarName::Fast32 => {
                type $T = Fast32;
                $body
            }
            ScalarName::I16f16 => {
                type $T = Saturating<I16F16>;
                $body
            }
            ScalarName::I8f24 => {
                type $T = Saturating<I8F24>;
                $body
            }
            ScalarName::I4f28 => {
                type $T = Saturating<I4F28>;
                $body
            }
            ScalarName::I32f32 => {
                type $T = Saturating<I32F32>;
                $body
            }
        }
    }};
}
pub(crate) use with_scalar;
