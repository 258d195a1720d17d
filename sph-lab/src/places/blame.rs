//! A number that is rounded at one place only.

use std::cell::{Cell, RefCell};
use std::ops::Neg;
use std::panic::Location;

use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, Scalar};

use super::lens::lens;
use super::place::{Operation, Place};
use crate::{Format, Rounding};

/// Where an f64 is rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Where {
    #[default]
    Nowhere,
    /// Nowhere, and places are noted.
    Noted,
    Only(Place),
    AllBut(Place),
}

/// Where, and to what.
#[derive(Clone, Copy, Debug)]
struct Plan {
    at: Where,
    /// 2^F
    units: f64,
    rounding: Rounding,
}

thread_local! {
    static PLAN: Cell<Plan> = const { Cell::new(Plan { at: Where::Nowhere, units: 1.0, rounding: Rounding::Nearest }) };
    static SEEN: RefCell<Vec<Place>> = const { RefCell::new(Vec::new()) };
}

/// An f64 that [`blame`] rounds at the places that it chooses. Its range has no end.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Blame(f64);

const fn constant(value: f64, _: f64) -> Blame {
    Blame(value)
}

impl Plan {
    fn rounds(&self, place: Place) -> bool {
        match self.at {
            Where::Nowhere => false,
            Where::Only(only) => place == only,
            Where::AllBut(other) => place != other,
            Where::Noted => {
                SEEN.with_borrow_mut(|seen| {
                    if !seen.contains(&place) {
                        seen.push(place);
                    }
                });
                false
            }
        }
    }

    fn rounded(&self, value: f64) -> f64 {
        let scaled = value * self.units;
        let whole = match self.rounding {
            Rounding::Floor => scaled.floor(),
            Rounding::TowardZero => scaled.trunc(),
            _ => scaled.round(),
        };
        whole / self.units
    }
}

impl Blame {
    #[inline(always)]
    fn value(self) -> f64 {
        self.0
    }

    #[inline(always)]
    fn seen(self) {}

    #[inline]
    fn with(self, value: f64, _: impl Fn(f64) -> f64) -> Self {
        Self(value)
    }

    // a call, so that code that is watched stays small
    #[inline(never)]
    #[track_caller]
    fn made<const N: usize>(
        operation: Operation,
        value: f64,
        _: [Self; N],
        _: impl Fn([f64; N]) -> f64,
    ) -> Self {
        let plan = PLAN.get();
        if plan.at == Where::Nowhere {
            return Self(value);
        }
        let place = Place::new(Location::caller(), operation);
        Self(if plan.rounds(place) { plan.rounded(value) } else { value })
    }
}

lens!([] Blame: f64, BlameSum, "blame", constant);
sph_core::own_companion!([] Blame, Blame(0.0));

impl Neg for Blame {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// A sum that is rounded once, in `total`.
#[derive(Clone, Copy, Debug)]
pub struct BlameSum(f64);

impl Accumulator<Blame> for BlameSum {
    const ZERO: Self = Self(0.0);

    #[inline]
    fn add(&mut self, term: Blame) {
        self.0 += term.0;
    }

    #[inline]
    #[track_caller]
    fn total(self) -> Blame {
        Blame::made(Operation::Total, self.0, [], |[]| 0.0)
    }

    #[inline]
    #[track_caller]
    fn scaled_total(self, a: Blame, b: Blame) -> Blame {
        Blame::made(Operation::Total, self.0 * a.0 * b.0, [a, b], |_| 0.0)
    }
}

/// One place, and what rounding there does.
#[derive(Clone, Debug, PartialEq)]
pub struct Blamed<R> {
    /// The place.
    pub place: Place,
    /// The result where this place alone is rounded.
    pub alone: R,
    /// The result where every other place is rounded.
    pub without: R,
}

/// Runs some work on [`Blame`] again and again, rounded to the step of a format at one place at a time, and at every place but one.
/// Returns the places in the order of files and lines. What overflow does plays no part, nor does stochastic rounding, which becomes
/// rounding to nearest.
///
/// ```
/// use sph_core::Scalar;
/// use sph_lab::{Blame, Format, blame};
///
/// let format = Format::new(4, 12)?;
/// const X: f64 = 1364.0 / 4096.0; // a number of the format, as 1000 is
/// let exact = X * X * 1000.0;
/// let error = |result: &f64| (result - exact).abs();
/// let mut places = blame(format, || {
///     let x = Blame::from_f64(X);
///     let square = x * x;
///     (square * Blame::from_f64(1000.0)).to_f64()
/// });
/// places.sort_by(|a, b| error(&b.alone).total_cmp(&error(&a.alone)));
/// assert_eq!(places[0].place.operation().sign(), "*"); // the square, whose error is multiplied by 1000
/// assert_eq!(places[0].place.line(), line!() - 5);
/// # Ok::<(), sph_lab::FormatError>(())
/// ```
pub fn blame<R>(format: Format, work: impl Fn() -> R) -> Vec<Blamed<R>> {
    struct Restore(Plan);
    impl Drop for Restore {
        fn drop(&mut self) {
            PLAN.set(self.0);
        }
    }
    let _before = Restore(PLAN.get());
    let rounded = |at| {
        let units = f64::from_bits(u64::from(1023 + format.fraction_bits()) << 52);
        PLAN.set(Plan { at, units, rounding: format.rounding() });
        work()
    };
    SEEN.take();
    rounded(Where::Noted);
    let mut places = SEEN.take();
    places.sort_by_key(Place::order);
    let blamed =
        |place| Blamed { place, alone: rounded(Where::Only(place)), without: rounded(Where::AllBut(place)) };
    places.into_iter().map(blamed).collect()
}
