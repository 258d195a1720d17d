//! The scalars by name.

use clap::ValueEnum;
use sph_core::Scalar;

/// The enum of the listed scalars.
macro_rules! choices {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => {
        /// A number type as the command line names it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
        pub enum ScalarName {
            $(#[doc = $about] #[value(name = <$Scalar as Scalar>::NAME)] $Name,)+
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
        for &scalar in ScalarName::value_variants() {
            let shown = scalar.to_possible_value().unwrap();
            assert_eq!(shown.get_name(), with_scalar!(scalar, T => T::NAME));
            assert!(shown.get_help().is_some_and(|about| about.to_string().contains("point")));
        }
    }
}
