//! The scalars by name.

use sph_core::Scalar;

use crate::named_enum::named_enum;

/// Calls a macro with the scalars that the command offers: those of sph-core's list without formats that are compiled for
/// firmware alone, since every scalar here is compiled for all sums in all dimensions.
macro_rules! offered {
    ([$($list:tt)+] $($then:tt)+) => {
        $crate::scalar_choice::offered! { @ [] ($($then)+) $($list)+ }
    };
    (@ $kept:tt $then:tt I4F12: $Scalar:ty, $about:tt; $($rest:tt)*) => {
        $crate::scalar_choice::offered! { @ $kept $then $($rest)* }
    };
    (@ $kept:tt $then:tt I12F20: $Scalar:ty, $about:tt; $($rest:tt)*) => {
        $crate::scalar_choice::offered! { @ $kept $then $($rest)* }
    };
    (@ $kept:tt $then:tt I20F12: $Scalar:ty, $about:tt; $($rest:tt)*) => {
        $crate::scalar_choice::offered! { @ $kept $then $($rest)* }
    };
    (@ $kept:tt $then:tt I16F48: $Scalar:ty, $about:tt; $($rest:tt)*) => {
        $crate::scalar_choice::offered! { @ $kept $then $($rest)* }
    };
    (@ [$($kept:tt)*] $then:tt $Name:ident: $Scalar:ty, $about:tt; $($rest:tt)*) => {
        $crate::scalar_choice::offered! { @ [$($kept)* $Name: $Scalar, $about;] $then $($rest)* }
    };
    (@ $kept:tt ($callback:ident $($context:tt)*)) => {
        $crate::scalar_choice::$callback! { $kept $($context)* }
    };
}

/// The enum of the offered scalars.
macro_rules! choices {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => {
        named_enum! {
            /// A number type by its name.
            ScalarName { $($Name, <$Scalar as Scalar>::NAME, $about;)+ }
        }
    };
}
sph_core::for_each_scalar!(offered; choices);

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
        sph_core::for_each_scalar!($crate::scalar_choice::offered; with_scalar $name, $T => $body)
    };
}

pub(crate) use {choices, offered, with_scalar};

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
