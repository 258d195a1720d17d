//! A number that tells its size.

use std::cmp::Ordering;
use std::ops::Neg;
use std::panic::Location;

use sph_core::scalar::Table;
use sph_core::scalar::compact::Compact;
use sph_core::{Accumulator, Arithmetic, Scalar};

use super::lens::lens;
use super::near::TallyNear;
use super::place::Operation;
use super::recorder::{Event, record};

/// A T that tells, place by place, how large results are and which of them left its range; see [`watch`](super::watch). Its bits
/// are those of T.
///
/// Where a result leaves the range (`is_finite` is false) of operands that had not, that is a *saturation*. From there on the number has
/// beside it what it would be without an end of the range, as an f64. The saturation is *consequential* when a comparison comes out
/// otherwise than it would, when the number reaches a sum, or when the program reads it; and harmless when nothing of that
/// happens before the two are equal again, such as the square of a large distance in (1 − r²)₊. Wrapping types do not tell that
/// they left their range, so that nothing is counted for them.
///
/// ```
/// use sph_core::scalar::fixed::{I4F12, Saturating};
/// use sph_core::{Arithmetic, Scalar};
/// use sph_lab::{Tally, watch};
///
/// fn weight<T: Scalar>(distance: T) -> T {
///     (T::ONE - distance * distance).positive_part()
/// }
/// let (_, log) = watch(|| weight(Tally::<Saturating<I4F12>>::from_f64(5.0)).to_f64());
/// assert_eq!((log.saturations().harmless(), log.saturations().consequential()), (1, 0));
/// assert_eq!(log.widest().unwrap().place.line(), line!() - 4);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally<T> {
    value: T,
    /// What it would be, where there was a saturation.
    truth: f64,
    event: Event,
}

const fn constant<T>(value: T, truth: f64) -> Tally<T> {
    Tally { value, truth, event: Event::NONE }
}

impl<T: Scalar> Tally<T> {
    /// The number within.
    #[inline(always)]
    #[must_use]
    pub fn value(self) -> T {
        self.value
    }

    /// What it would be if the type had no end.
    #[inline]
    fn unbounded(self) -> f64 {
        if self.event.is_some() { self.truth } else { self.value.to_f64() }
    }

    /// Says that a program reads this number.
    #[inline]
    fn seen(self) {
        self.event.has_consequence();
    }

    /// The result of an operation that cannot leave the range.
    #[inline]
    fn with(self, value: T, exact: impl Fn(f64) -> f64) -> Self {
        if !self.event.is_some() {
            return constant(value, 0.0);
        }
        let truth = exact(self.truth);
        Self { value, truth, event: self.event }.settled()
    }

    /// Without its saturation where nothing is left of it.
    fn settled(self) -> Self {
        if T::from_f64(self.truth) == self.value && self.value.is_finite() {
            constant(self.value, 0.0)
        } else {
            self
        }
    }

    /// The result of an operation on some operands, told.
    // a call, so that code that is watched stays small
    #[inline(never)]
    #[track_caller]
    fn made<const N: usize>(
        operation: Operation,
        value: T,
        operands: [Self; N],
        exact: impl Fn([f64; N]) -> f64,
    ) -> Self {
        let location = Location::caller();
        let is_sum = matches!(operation, Operation::Add | Operation::Subtract);
        let largest = |most: f64, operand: &Self| most.max(operand.value.to_f64().abs());
        let largest_operand = if is_sum { operands.iter().fold(0.0, largest) } else { 0.0 };
        let has_vanished =
            N > 0 && !is_sum && value == T::ZERO && operands.iter().all(|one| one.value != T::ZERO);
        let before = operands.iter().find(|operand| operand.event.is_some()).map(|operand| operand.event);
        let saturates =
            before.is_none() && !value.is_finite() && operands.iter().all(|one| one.value.is_finite());
        let event = record(|recorder| {
            let number = recorder.number(location, operation);
            let record = &mut recorder.records[number as usize];
            record.add(value.to_f64(), largest_operand);
            record.vanished += u64::from(has_vanished);
            if saturates { recorder.saturated(number) } else { Event::NONE }
        });
        match (before, event) {
            (Some(event), _) => {
                let truth = exact(operands.map(Self::unbounded));
                Self { value, truth, event }.settled()
            }
            (None, Some(event)) if event.is_some() => {
                Self { value, truth: exact(operands.map(|operand| operand.value.to_f64())), event }
            }
            _ => constant(value, 0.0),
        }
    }

    /// Says that saturations have decided a comparison, where they have.
    #[inline]
    fn compared<R: PartialEq>(self, other: Self, found: R, by: impl Fn(&f64, &f64) -> R) -> R {
        if (self.event.is_some() || other.event.is_some())
            && by(&self.unbounded(), &other.unbounded()) != found
        {
            self.event.has_consequence();
            other.event.has_consequence();
        }
        found
    }
}

lens!([T: Scalar] Tally<T>: T, TallySum<T>, T::NAME, constant);

impl<T: Scalar> Neg for Tally<T> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.with(-self.value, |x| -x)
    }
}

impl<T: Scalar> PartialEq for Tally<T> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.compared(*other, self.value == other.value, f64::eq)
    }
}

impl<T: Scalar> PartialOrd for Tally<T> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.compared(*other, self.value.partial_cmp(&other.value), f64::partial_cmp)
    }

    #[inline]
    fn lt(&self, other: &Self) -> bool {
        self.compared(*other, self.value < other.value, f64::lt)
    }

    #[inline]
    fn le(&self, other: &Self) -> bool {
        self.compared(*other, self.value <= other.value, f64::le)
    }

    #[inline]
    fn gt(&self, other: &Self) -> bool {
        self.compared(*other, self.value > other.value, f64::gt)
    }

    #[inline]
    fn ge(&self, other: &Self) -> bool {
        self.compared(*other, self.value >= other.value, f64::ge)
    }
}

/// A sum of numbers that tell their size.
#[derive(Clone, Copy, Debug)]
pub struct TallySum<T: Scalar> {
    sum: T::Sum,
    exact: f64,
}

impl<T: Scalar> Accumulator<Tally<T>> for TallySum<T> {
    const ZERO: Self = Self { sum: T::Sum::ZERO, exact: 0.0 };

    #[inline]
    #[track_caller]
    fn add(&mut self, term: Tally<T>) {
        term.seen();
        let (location, value) = (Location::caller(), term.value.to_f64());
        record(|recorder| {
            let number = recorder.number(location, Operation::Term);
            recorder.records[number as usize].add(value, 0.0);
        });
        self.sum.add(term.value);
        self.exact += value;
    }

    #[inline]
    #[track_caller]
    fn total(self) -> Tally<T> {
        Tally::made(Operation::Total, self.sum.total(), [], |[]| self.exact)
    }

    #[inline]
    #[track_caller]
    fn scaled_total(self, a: Tally<T>, b: Tally<T>) -> Tally<T> {
        let value = self.sum.scaled_total(a.value, b.value);
        Tally::made(Operation::Total, value, [a, b], |[a, b]| a * b * self.exact)
    }
}

impl<T: Compact> Compact for Tally<T> {
    type Near = TallyNear<T::Near>;

    #[inline]
    #[track_caller]
    fn offset(self, other: Self) -> Self::Near {
        self.seen();
        other.seen();
        TallyNear::made(Operation::Subtract, self.value.offset(other.value))
    }

    #[inline]
    fn near(self) -> Self::Near {
        self.seen();
        TallyNear(self.value.near())
    }

    #[inline]
    #[track_caller]
    fn from_near(near: Self::Near) -> Self {
        Self::made(Operation::Convert, T::from_near(near.0), [], |[]| {
            sph_core::scalar::compact::NearUnit::to_f64(near.0)
        })
    }
}
