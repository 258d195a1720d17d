//! One type for every number type of this crate that is chosen when the program runs, so that code which is generic over the scalar is
//! compiled for one type instead of for each.

use std::cell::Cell;

use sph_core::{Accumulator, Arithmetic, Scalar};

use crate::{Blame, Emulated, Format, Mini, MiniFormat, Running, Tally};

/// The number type that [`Chosen`] is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// [`Emulated`] in this format.
    Emulated(Format),
    /// [`Mini`] in this format.
    Mini(MiniFormat),
    /// [`Tally`] of [`Emulated`] in this format.
    Tally(Format),
    /// [`Running`] in this format.
    Running(Format),
    /// [`Blame`], rounded as [`blame`](crate::blame) says.
    Blame,
}

/// A choice without its format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Emulated,
    Mini,
    Tally,
    Running,
    Blame,
}

thread_local! {
    static KIND: Cell<Kind> = const { Cell::new(Kind::Emulated) };
}

impl Choice {
    fn kind(self) -> Kind {
        match self {
            Self::Emulated(_) => Kind::Emulated,
            Self::Mini(_) => Kind::Mini,
            Self::Tally(_) => Kind::Tally,
            Self::Running(_) => Kind::Running,
            Self::Blame => Kind::Blame,
        }
    }

    /// The choice in use on this thread, with the format in use.
    #[must_use]
    pub fn current() -> Self {
        match KIND.get() {
            Kind::Emulated => Self::Emulated(Format::current()),
            Kind::Mini => Self::Mini(MiniFormat::current()),
            Kind::Tally => Self::Tally(Format::current()),
            Kind::Running => Self::Running(Format::current()),
            Kind::Blame => Self::Blame,
        }
    }

    /// Does some work with this choice, and its format, in use on this thread; what was before is in use again afterwards.
    pub fn scope<R>(self, work: impl FnOnce() -> R) -> R {
        struct Restore(Kind);
        impl Drop for Restore {
            fn drop(&mut self) {
                KIND.set(self.0);
            }
        }
        let _before = Restore(KIND.replace(self.kind()));
        match self {
            Self::Emulated(format) | Self::Tally(format) | Self::Running(format) => format.scope(work),
            Self::Mini(format) => format.scope(work),
            Self::Blame => work(),
        }
    }

    /// Uses this choice on this thread from now on: what each thread of a pool does when it starts.
    pub fn enter(self) {
        KIND.set(self.kind());
        match self {
            Self::Emulated(format) | Self::Tally(format) | Self::Running(format) => format.enter(),
            Self::Mini(format) => format.enter(),
            Self::Blame => {}
        }
    }
}

/// A number of the type that is in use on its thread; see [`Choice::scope`]. It has the bits of that type, and takes somewhat more time.
///
/// ```
/// use sph_core::{Arithmetic, Scalar};
/// use sph_lab::{Choice, Chosen, Emulated, Format, MiniFormat};
///
/// fn third<T: Scalar>() -> f64 {
///     (T::ONE / T::ratio(3, 1)).to_f64()
/// }
/// let format = Format::new(4, 12)?;
/// assert_eq!(Choice::Emulated(format).scope(third::<Chosen>), format.scope(third::<Emulated>));
/// assert_ne!(Choice::Mini(MiniFormat::F16).scope(third::<Chosen>), 1.0 / 3.0);
/// # Ok::<(), sph_lab::FormatError>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Chosen(Number);

/// A number of one of the types, or a constant of the trait.
#[derive(Clone, Copy, Debug, Default)]
enum Number {
    #[default]
    Zero,
    One,
    Epsilon,
    Max,
    Emulated(Emulated),
    Mini(Mini),
    Tally(Tally<Emulated>),
    Running(Running),
    Blame(Blame),
}

/// A type that a number may be of.
trait Variant: Scalar {
    /// The number in this type; 0 for one of another type, of another scope.
    fn of(number: Number) -> Self;
    /// The number, chosen.
    fn chosen(self) -> Chosen;
    /// The sum in this type; empty for one of another type.
    fn sum_of(sum: ChosenSum) -> Self::Sum;
    /// The sum, chosen.
    fn chosen_sum(sum: Self::Sum) -> ChosenSum;
}

macro_rules! variants {
    ($($Kind:ident: $Type:ty;)+) => {
        /// A sum of chosen numbers.
        #[derive(Clone, Copy, Debug)]
        pub struct ChosenSum(Sums);

        #[derive(Clone, Copy, Debug)]
        enum Sums {
            Empty,
            $($Kind(<$Type as Scalar>::Sum),)+
        }

        $(
            impl Variant for $Type {
                fn of(number: Number) -> Self {
                    match number {
                        Number::$Kind(number) => number,
                        Number::One => <Self as Arithmetic>::ONE,
                        Number::Epsilon => <Self as Scalar>::EPSILON,
                        Number::Max => <Self as Scalar>::MAX,
                        _ => <Self as Arithmetic>::ZERO,
                    }
                }

                fn chosen(self) -> Chosen {
                    Chosen(Number::$Kind(self))
                }

                fn sum_of(sum: ChosenSum) -> Self::Sum {
                    if let Sums::$Kind(sum) = sum.0 { sum } else { <Self::Sum as Accumulator<Self>>::ZERO }
                }

                fn chosen_sum(sum: Self::Sum) -> ChosenSum {
                    ChosenSum(Sums::$Kind(sum))
                }
            }
        )+

        /// Evaluates an expression with `T` standing for the type in use.
        macro_rules! with_type {
            ($T:ident => $body:expr) => {
                match KIND.get() {
                    $(Kind::$Kind => {
                        type $T = $Type;
                        $body
                    })+
                }
            };
        }
    };
}
variants! {
    Emulated: Emulated;
    Mini: Mini;
    Tally: Tally<Emulated>;
    Running: Running;
    Blame: Blame;
}

impl Chosen {
    /// The number with its bound, where that is the type.
    #[must_use]
    pub fn running(self) -> Option<Running> {
        if let Number::Running(number) = self.0 { Some(number) } else { None }
    }

    /// The number, where it is an emulated one.
    #[must_use]
    pub fn emulated(self) -> Option<Emulated> {
        if let Number::Emulated(number) = self.0 { Some(number) } else { None }
    }
}

mod operations;
