//! The scalars by name.

use sph_core::Scalar;

use crate::named_enum::named_enum;

/// The enum of the listed scalars.
macro_rules! choices {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => {
        named_enum! {
            /// A number type by its name.
            ScalarName { $($Name, <$Scalar as Scalar>::NAME, $about;)+ }
        }
    };
}
sph_core::for_each_scalar!(choices);

/// Evaluates an expression with `T` standing for the type of a [`ScalarName`].
macro_rules! with_scalar {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+] $name:expr, $T:ident => $body:expr) => {
        match $name {
            $($crate::scalar_choice::ScalarName::$Name => {
                type $T = $Scalar;
                $body
            })+
        }
    };
    ($name:expr, $T:ident => $body:expr) => {
        sph_core::for_each_scalar!($crate::scalar_choice::with_scalar; $name, $T => $body)
    };
}
pub(crate) use with_scalar;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_types() {
        for &scalar in ScalarName::ALL {
            assert_eq!(scalar.name(), with_scalar!(scalar, T => T::NAME));
            assert!(scalar.about().contains("point"));
        }
    }
}
