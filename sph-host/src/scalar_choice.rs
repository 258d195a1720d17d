//! The scalars by name. A fixed-point format is emulated, with the bits of its compiled type, so that every format can be had.

use std::fmt::{Display, Formatter};

use sph_core::{Scalar, for_each_float, for_each_format};
use sph_lab::{Emulated, Format, Overflow};

/// What follows from the list of the scalars that are no fixed-point formats.
macro_rules! choices {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => {
        /// A number type by its name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum ScalarName {
            $(#[doc = $about] $Name,)+
            /// Fixed point, saturating.
            Fixed(Format),
        }

        impl ScalarName {
            /// All but the fixed-point formats, the default first.
            pub const FLOATS: &'static [Self] = &[$(Self::$Name),+];

            /// The name, such as `f64` or `i16f16`.
            #[must_use]
            pub fn name(self) -> String {
                match self {
                    $(Self::$Name => <$Scalar as Scalar>::NAME.to_owned(),)+
                    Self::Fixed(format) => format.to_string(),
                }
            }

            /// What it is, in one line.
            #[must_use]
            pub fn about(self) -> &'static str {
                match self {
                    $(Self::$Name => $about,)+
                    Self::Fixed(_) => "fixed point, saturating",
                }
            }
        }
    };
}
for_each_float!(choices);

/// The names of the formats that sph-core has compiled types for.
macro_rules! compiled {
    ([$($Format:ident $name:tt $about:tt;)+]) => {
        /// Formats that firmware can use as they are.
        const COMPILED: &[&str] = &[$($name),+];
    };
}
for_each_format!(compiled);

impl ScalarName {
    /// The one of this name; `iAfB` is fixed point with A integer bits, the sign among them, and B fraction bits, 8 to 64 together.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        let float = Self::FLOATS.iter().copied().find(|known| known.name() == name);
        float.or_else(|| {
            let format: Format = name.parse().ok()?;
            (format.overflow() == Overflow::Saturating).then_some(Self::Fixed(format))
        })
    }

    /// The floats, and the formats that sph-core has compiled types for.
    pub fn compiled() -> impl Iterator<Item = Self> {
        let formats = COMPILED.iter().filter_map(|name| Self::of_name(name));
        Self::FLOATS.iter().copied().chain(formats)
    }

    /// Prepares a thread to calculate in this scalar: what each thread of a pool does when it starts.
    pub(crate) fn enter(self) {
        if let Self::Fixed(format) = self {
            format.enter();
        }
    }
}

impl Display for ScalarName {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.pad(&self.name())
    }
}

/// The name of the type T on this thread.
pub(crate) fn name_of<T: Scalar>() -> String {
    match T::NAME {
        Emulated::NAME => Format::current().to_string(),
        name => name.to_owned(),
    }
}

/// Evaluates an expression with `T` standing for the type of a [`ScalarName`]. Work of other threads in it needs
/// [`ScalarName::enter`] on each.
macro_rules! with_scalar {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+] $name:expr, $T:ident => $body:expr) => {
        match $name {
            $($crate::scalar_choice::ScalarName::$Name => {
                type $T = $Scalar;
                $body
            })+
            $crate::scalar_choice::ScalarName::Fixed(format) => {
                type $T = sph_lab::Emulated;
                format.scope(|| $body)
            }
        }
    };
    ($name:expr, $T:ident => $body:expr) => {
        sph_core::for_each_float!($crate::scalar_choice::with_scalar; $name, $T => $body)
    };
}

pub(crate) use with_scalar;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_types() {
        for scalar in ScalarName::compiled() {
            assert_eq!(scalar.name(), with_scalar!(scalar, T => name_of::<T>()));
            assert!(scalar.about().contains("point"));
            assert_eq!(ScalarName::of_name(&scalar.name()), Some(scalar));
        }
        assert_eq!(ScalarName::of_name("i3f13").unwrap().to_string(), "i3f13");
        for none in ["wrapping-i16f16", "i0f16", "i40f40", "emulated", "f16"] {
            assert_eq!(ScalarName::of_name(none), None);
        }
    }
}
