//! The scalars by name. A fixed-point format is emulated, with the bits of its compiled type, so that every format can be had; so are
//! floating-point formats of 16 bits.

use std::fmt::{Display, Formatter};

use sph_core::{Scalar, for_each_float, for_each_format};
use sph_lab::{Choice, Chosen, Emulated, Format, Mini, MiniFormat, Overflow};

/// What follows from the list of the scalars that are no fixed-point formats.
macro_rules! choices {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => {
        /// A number type by its name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum ScalarName {
            $(#[doc = $about] $Name,)+
            /// Fixed point, saturating.
            Fixed(Format),
            /// Floating point of 16 bits.
            Mini(MiniFormat),
        }

        impl ScalarName {
            /// Those that are compiled for the host, the default first.
            pub const FLOATS: &'static [Self] = &[$(Self::$Name),+];

            /// The name, such as `f64` or `i16f16`.
            #[must_use]
            pub fn name(self) -> String {
                match self {
                    $(Self::$Name => <$Scalar as Scalar>::NAME.to_owned(),)+
                    Self::Fixed(format) => format.to_string(),
                    Self::Mini(format) => format.to_string(),
                }
            }

            /// What it is, in one line.
            #[must_use]
            pub fn about(self) -> &'static str {
                match self {
                    $(Self::$Name => $about,)+
                    Self::Fixed(_) => "fixed point, saturating",
                    Self::Mini(_) => "floating point of 16 bits",
                }
            }
        }
    };
}
for_each_float!(choices);

/// The names of the formats that sph-core shows by name.
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
        let mini = || name.parse().ok().map(Self::Mini);
        float.or_else(mini).or_else(|| {
            let format: Format = name.parse().ok()?;
            (format.overflow() == Overflow::Saturating).then_some(Self::Fixed(format))
        })
    }

    /// Those of 16 bits with a floating point.
    pub fn minis() -> impl Iterator<Item = Self> {
        MiniFormat::ALL.into_iter().map(Self::Mini)
    }

    /// Those that are compiled for the host, and the formats that sph-core shows by name.
    pub fn compiled() -> impl Iterator<Item = Self> {
        let formats = COMPILED.iter().filter_map(|name| Self::of_name(name));
        Self::FLOATS.iter().copied().chain(formats)
    }

    /// Prepares a thread to calculate in this scalar: what each thread of a pool does when it starts.
    pub(crate) fn enter(self) {
        if let Some(choice) = self.choice() {
            choice.enter();
        }
    }

    /// What [`Chosen`] has to be to stand for it; none for a scalar that is compiled for the host.
    pub(crate) fn choice(self) -> Option<Choice> {
        match self {
            Self::Fixed(format) => Some(Choice::Emulated(format)),
            Self::Mini(format) => Some(Choice::Mini(format)),
            _ => None,
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
    match (T::NAME, Choice::current()) {
        (Chosen::NAME, Choice::Emulated(format)) => format.to_string(),
        (Chosen::NAME, Choice::Mini(format)) => format.to_string(),
        (Emulated::NAME, _) => Format::current().to_string(),
        (Mini::NAME, _) => MiniFormat::current().to_string(),
        (name, _) => name.to_owned(),
    }
}

/// Evaluates an expression with `T` standing for the type of a [`ScalarName`]: [`Chosen`] for all that are not compiled for the host,
/// so that what is generic over the scalar is compiled for one type more, not for each. Work of other threads in it needs
/// [`ScalarName::enter`] on each.
macro_rules! with_scalar {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+] $name:expr, $T:ident => $body:expr) => {
        match $name {
            $($crate::scalar_choice::ScalarName::$Name => {
                type $T = $Scalar;
                $body
            })+
            $crate::scalar_choice::ScalarName::Fixed(format) => {
                sph_lab::Choice::Emulated(format).scope(|| {
                    type $T = sph_lab::Chosen;
                    $body
                })
            }
            $crate::scalar_choice::ScalarName::Mini(format) => {
                sph_lab::Choice::Mini(format).scope(|| {
                    type $T = sph_lab::Chosen;
                    $body
                })
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
        for mini in ScalarName::minis() {
            assert_eq!(mini.name(), with_scalar!(mini, T => name_of::<T>()));
            assert_eq!(ScalarName::of_name(&mini.name()), Some(mini));
        }
        for none in ["wrapping-i16f16", "i0f16", "i40f40", "emulated", "f8"] {
            assert_eq!(ScalarName::of_name(none), None);
        }
    }
}
