//! A number and its truth.

use std::cmp::Ordering;
use std::ops::Neg;
use std::panic::Location;

use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, Scalar};

use super::lens::lens;
use super::place::Operation;
use super::recorder::record;

/// A T and beside it the same computation in f64, the truth: tells, place by place, the error of each operation on its own (local)
/// and the distance of its result from the truth (global), and which comparisons the truth decides otherwise; see
/// [`watch`](super::watch). T alone decides comparisons, so its bits are those of T.
///
/// In a chaotic computation the truth leaves T within a few steps and says nothing more: [`anchored`](Self::anchored) begins it
/// anew, once a frame.
///
/// ```
/// use sph_core::Scalar;
/// use sph_core::scalar::fixed::{I4F12, Saturating};
/// use sph_lab::{Shadow, watch};
///
/// type Real = Shadow<Saturating<I4F12>>;
/// let (third, log) = watch(|| Real::from_f64(1.0) / Real::from_f64(3.0));
/// assert_eq!(third.truth(), 1.0 / 3.0);
/// let quotient = log.places().iter().find(|record| record.place.operation().sign() == "/").unwrap();
/// assert!(quotient.errors.local <= 1.0 / 8192.0 && quotient.errors.local > 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Shadow<T> {
    value: T,
    truth: f64,
}

const fn constant<T>(value: T, truth: f64) -> Shadow<T> {
    Shadow { value, truth }
}

impl<T: Scalar> Shadow<T> {
    /// The number within.
    #[inline(always)]
    #[must_use]
    pub fn value(self) -> T {
        self.value
    }

    /// What it is in f64.
    #[must_use]
    pub fn truth(self) -> f64 {
        self.truth
    }

    /// The number with itself as the truth.
    #[must_use]
    pub fn anchored(self) -> Self {
        Self { value: self.value, truth: self.value.to_f64() }
    }

    #[inline(always)]
    fn seen(self) {}

    #[inline]
    fn with(self, value: T, exact: impl Fn(f64) -> f64) -> Self {
        Self { value, truth: exact(self.truth) }
    }

    // a call, so that code that is watched stays small
    #[inline(never)]
    #[track_caller]
    fn made<const N: usize>(
        operation: Operation,
        value: T,
        operands: [Self; N],
        exact: impl Fn([f64; N]) -> f64,
    ) -> Self {
        let truth = exact(operands.map(|operand| operand.truth));
        let local = exact(operands.map(|operand| operand.value.to_f64()));
        tell(Location::caller(), operation, value.to_f64(), [local, truth]);
        Self { value, truth }
    }

    /// Tells whether the truth decides a comparison otherwise.
    #[inline]
    fn compared<R: PartialEq>(self, other: Self, at: &'static Location<'static>, found: R, truth: R) -> R {
        let difference = self.value.to_f64() - other.value.to_f64();
        record(|recorder| {
            let number = recorder.number(at, Operation::Compare);
            let record = &mut recorder.records[number as usize];
            record.add(difference, 0.0);
            record.decided_otherwise += u64::from(found != truth);
        });
        found
    }
}

/// Tells a result, what the operation gives exactly on the operands as they are, and what it gives on the truth.
fn tell(location: &'static Location<'static>, operation: Operation, result: f64, [local, truth]: [f64; 2]) {
    record(|recorder| {
        let number = recorder.number(location, operation);
        let record = &mut recorder.records[number as usize];
        record.add(result, 0.0);
        let (local, global) = ((result - local).abs(), (result - truth).abs());
        record.errors.local = record.errors.local.max(local);
        record.errors.global = record.errors.global.max(global);
        record.errors.squares += global * global;
    });
}

lens!([T: Scalar] Shadow<T>: T, ShadowSum<T>, T::NAME, constant);
sph_core::own_companion!([T: Scalar] Shadow<T>, constant(T::ZERO, 0.0));

impl<T: Scalar> Neg for Shadow<T> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.with(-self.value, |x| -x)
    }
}

impl<T: Scalar> PartialEq for Shadow<T> {
    #[inline]
    #[track_caller]
    fn eq(&self, other: &Self) -> bool {
        let truth = self.truth == other.truth;
        self.compared(*other, Location::caller(), self.value == other.value, truth)
    }
}

macro_rules! comparisons {
    ($($method:ident: $Answer:ty;)+) => {$(
        #[inline]
        #[track_caller]
        fn $method(&self, other: &Self) -> $Answer {
            let truth = self.truth.$method(&other.truth);
            self.compared(*other, Location::caller(), self.value.$method(&other.value), truth)
        }
    )+};
}

impl<T: Scalar> PartialOrd for Shadow<T> {
    comparisons! {
        partial_cmp: Option<Ordering>;
        lt: bool;
        le: bool;
        gt: bool;
        ge: bool;
    }
}

/// A sum beside its truth.
#[derive(Clone, Copy, Debug)]
pub struct ShadowSum<T: Scalar> {
    sum: T::Sum,
    /// Of the terms as they are.
    local: f64,
    truth: f64,
}

impl<T: Scalar> Accumulator<Shadow<T>> for ShadowSum<T> {
    const ZERO: Self = Self { sum: T::Sum::ZERO, local: 0.0, truth: 0.0 };

    #[inline]
    fn add(&mut self, term: Shadow<T>) {
        self.sum.add(term.value);
        self.local += term.value.to_f64();
        self.truth += term.truth;
    }

    #[inline]
    #[track_caller]
    fn total(self) -> Shadow<T> {
        let value = self.sum.total();
        tell(Location::caller(), Operation::Total, value.to_f64(), [self.local, self.truth]);
        Shadow { value, truth: self.truth }
    }

    #[inline]
    #[track_caller]
    fn scaled_total(self, a: Shadow<T>, b: Shadow<T>) -> Shadow<T> {
        let value = self.sum.scaled_total(a.value, b.value);
        let truth = a.truth * b.truth * self.truth;
        let local = a.value.to_f64() * b.value.to_f64() * self.local;
        tell(Location::caller(), Operation::Total, value.to_f64(), [local, truth]);
        Shadow { value, truth }
    }
}
