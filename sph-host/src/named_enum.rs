//! An enum whose variants have a name and a description, from one list.

/// Defines an enum from lines `Variant, "name", "what it is";`, with all variants in order, their names and descriptions.
macro_rules! named_enum {
    ($(#[$meta:meta])* $Enum:ident { $($Variant:ident, $name:expr, $about:literal;)+ }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $Enum {
            $(#[doc = $about] $Variant,)+
        }

        impl $Enum {
            /// All of them, the default first.
            pub const ALL: &'static [Self] = &[$(Self::$Variant),+];

            /// The name, in lower case with hyphens.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$Variant => $name,)+
                }
            }

            /// What it is, in one line.
            #[must_use]
            pub fn about(self) -> &'static str {
                match self {
                    $(Self::$Variant => $about,)+
                }
            }

            /// The one of this name.
            #[must_use]
            pub fn of_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|known| known.name() == name)
            }
        }

        impl std::fmt::Display for $Enum {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }
    };
}

pub(crate) use named_enum;
