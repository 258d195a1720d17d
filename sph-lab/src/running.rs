//! A fixed-point number, and how far at most it is from the exact result.

use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, Scalar};

use crate::{Emulated, EmulatedSum};

/// An [`Emulated`] number and a bound on its distance from the result of exact arithmetic on the same inputs, conversion and rounding
/// of every operation included (J. H. Wilkinson's running error analysis). The bound holds for certain.
///
/// The error of each operation itself is known, not estimated: the exact result of two numbers of a format is at hand. Errors that come
/// from before are added up as if all had the worst sign. After an overflow the bound is as large as what was lost.
///
/// `<` means *possibly less*, so that a search visits a particle that exact arithmetic may have in reach: its influence is near 0, and
/// the bound has what it may be. The number has the bits of `Emulated` but for such particles; [`bound_of`](Self::bound_of) bounds the
/// error of `Emulated`. [`undecided`](Self::undecided) counts comparisons that the bounds leave open.
///
/// ```
/// use sph_core::{Arithmetic, Scalar};
/// use sph_lab::{Format, Running};
///
/// Format::new(4, 12)?.scope(|| {
///     let tenth = Running::from_f64(0.1);
///     let square = tenth * tenth;
///     assert!((square.to_f64() - 0.01).abs() <= square.bound());
///     assert!(square.bound() < 1e-4);
/// });
/// # Ok::<(), sph_lab::FormatError>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Running {
    value: Emulated,
    bound: f64,
}

thread_local! {
    static UNDECIDED: Cell<u64> = const { Cell::new(0) };
}

/// A bound after a few operations of f64 on numbers that are not negative, each of which may have rounded down.
fn up(bound: f64) -> f64 {
    bound * (1.0 + 16.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

/// How far a number is at most from an exact result that f64 gives with a few roundings of the sizes of these parts.
fn distance(value: Emulated, exact: f64, size: f64) -> f64 {
    let found = value.to_f64();
    let rounding = 4.0 * f64::EPSILON * size.max(found.abs());
    let distance = (found - exact).abs();
    if distance.is_nan() { f64::INFINITY } else { up(distance + rounding) }
}

impl Running {
    /// The number within.
    #[must_use]
    pub fn value(self) -> Emulated {
        self.value
    }

    /// How far it is at most from the exact result.
    #[must_use]
    pub fn bound(self) -> f64 {
        self.bound
    }

    /// How far the number that `Emulated` gives is at most from the exact result.
    #[must_use]
    pub fn bound_of(self, emulated: Emulated) -> f64 {
        let apart = (self.value.to_f64() - emulated.to_f64()).abs();
        up(self.bound + apart + f64::EPSILON * (self.size() + apart))
    }

    /// A number that is known up to some distance.
    #[must_use]
    pub fn known_up_to(value: Emulated, distance: f64) -> Self {
        let bound = if distance.is_nan() { f64::INFINITY } else { distance.abs() };
        Self { value, bound }
    }

    /// Comparisons of this thread so far that the bounds leave open.
    #[must_use]
    pub fn undecided() -> u64 {
        UNDECIDED.get()
    }

    /// |value|
    fn size(self) -> f64 {
        self.value.to_f64().abs()
    }

    /// The result of an operation: `exact` on the numbers as they are, `carried` from their bounds.
    fn made(value: Emulated, exact: f64, size: f64, carried: f64) -> Self {
        let bound = up(distance(value, exact, size) + up(carried));
        Self { value, bound: if bound.is_nan() { f64::INFINITY } else { bound } }
    }

    /// The answer of a comparison, counted where the bounds leave it open.
    fn possibly(self, other: Self, answer: bool) -> bool {
        let difference = (self.value.to_f64() - other.value.to_f64()).abs();
        if difference <= self.bound + other.bound && self.bound + other.bound > 0.0 {
            UNDECIDED.set(UNDECIDED.get() + 1);
        }
        answer
    }

    /// The least and the greatest that the exact result may be.
    fn ends(self) -> (f64, f64) {
        let value = self.value.to_f64();
        ((value - self.bound).next_down(), (value + self.bound).next_up())
    }
}

impl Add for Running {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let exact = self.value.to_f64() + other.value.to_f64();
        Self::made(self.value + other.value, exact, self.size() + other.size(), self.bound + other.bound)
    }
}

impl Sub for Running {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let exact = self.value.to_f64() - other.value.to_f64();
        Self::made(self.value - other.value, exact, self.size() + other.size(), self.bound + other.bound)
    }
}

/// |ab − AB| ≤ |a| β + |b| α + α β for |a − A| ≤ α, |b − B| ≤ β.
impl Mul for Running {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let exact = self.value.to_f64() * other.value.to_f64();
        let carried = self.size() * other.bound + other.size() * self.bound + self.bound * other.bound;
        Self::made(self.value * other.value, exact, exact.abs(), carried)
    }
}

/// |a/b − A/B| ≤ (α + |a/b| β) / (|b| − β) for |a − A| ≤ α, |b − B| ≤ β < |b|.
impl Div for Running {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let exact = self.value.to_f64() / other.value.to_f64();
        let least = (other.size() - other.bound).next_down();
        let carried =
            if least > 0.0 { (self.bound + exact.abs() * other.bound) / least } else { f64::INFINITY };
        Self::made(self.value / other.value, exact, exact.abs(), carried)
    }
}

impl Neg for Running {
    type Output = Self;

    fn neg(self) -> Self {
        Self::made(-self.value, -self.value.to_f64(), 0.0, self.bound)
    }
}

crate::assign::assign_operators!([] Running);
sph_core::own_companion!([] Running, Running { value: <Emulated as Arithmetic>::ZERO, bound: 0.0 });

/// Whether the numbers are equal.
impl PartialEq for Running {
    fn eq(&self, other: &Self) -> bool {
        self.possibly(*other, self.value == other.value)
    }
}

/// `<` and `<=` are possibly so; all else is as the numbers say.
impl PartialOrd for Running {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.possibly(*other, true);
        self.value.partial_cmp(&other.value)
    }

    fn lt(&self, other: &Self) -> bool {
        self.possibly(*other, self.value < other.value || self.ends().0 < other.ends().1)
    }

    fn le(&self, other: &Self) -> bool {
        self.possibly(*other, self.value <= other.value || self.ends().0 <= other.ends().1)
    }

    fn gt(&self, other: &Self) -> bool {
        self.possibly(*other, self.value > other.value)
    }

    fn ge(&self, other: &Self) -> bool {
        self.possibly(*other, self.value >= other.value)
    }
}

impl Arithmetic for Running {
    const ZERO: Self = Self { value: <Emulated as Arithmetic>::ZERO, bound: 0.0 };
    /// 1, in a format that has it.
    const ONE: Self = Self { value: <Emulated as Arithmetic>::ONE, bound: 0.0 };

    fn ratio(numerator: i32, denominator: i32) -> Self {
        let exact = f64::from(numerator) / f64::from(denominator);
        Self::made(Emulated::ratio(numerator, denominator), exact, exact.abs(), 0.0)
    }

    /// |(x)₊ − (X)₊| ≤ |x − X|
    fn positive_part(self) -> Self {
        Self { value: self.value.positive_part(), ..self }
    }

    fn times(self, n: i32) -> Self {
        let exact = self.value.to_f64() * f64::from(n);
        Self::made(self.value.times(n), exact, exact.abs(), self.bound * f64::from(n).abs())
    }
}

impl Scalar for Running {
    type Sum = RunningSum;

    const NAME: &'static str = "running";
    const EPSILON: Self = Self { value: Emulated::EPSILON, bound: 0.0 };
    const MAX: Self = Self { value: Emulated::MAX, bound: 0.0 };

    fn from_f64(value: f64) -> Self {
        Self::made(Emulated::from_f64(value), value, 0.0, 0.0)
    }

    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    fn sqrt(self) -> Self {
        let exact = self.value.to_f64().max(0.0).sqrt();
        let (least, most) = self.ends();
        let carried =
            (most.max(0.0).sqrt() - exact).max(exact - least.max(0.0).sqrt()) + exact * f64::EPSILON;
        Self::made(self.value.sqrt(), exact, exact, carried)
    }

    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    fn floor_to_i32(self) -> i32 {
        self.value.floor_to_i32()
    }

    fn canonical_bits(self) -> u64 {
        self.value.canonical_bits()
    }

    /// No bound where the exact result may have another place.
    fn split(self, bits: u32) -> (usize, Self) {
        let (place, rest) = self.value.split(bits);
        let factor = f64::from(1_u32 << bits.min(12));
        let carried = self.bound * factor;
        let is_sure = rest.to_f64() >= carried && rest.to_f64() + carried < 1.0;
        let exact = self.value.to_f64() * factor - place as f64;
        (place, Self::made(rest, exact, place as f64 + 1.0, if is_sure { carried } else { f64::INFINITY }))
    }

    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        let exact = *C::VALUES.get(row)?.get(i)?;
        Some(Self::made(Emulated::constant::<C, ROWS, N>(row, i)?, exact, exact.abs(), 0.0))
    }

    fn is_above_zero(self) -> bool {
        self.value.is_above_zero()
    }

    /// ||x| − |X|| ≤ |x − X|
    fn abs(self) -> Self {
        if self.value < <Emulated as Arithmetic>::ZERO { -self } else { self }
    }

    fn min(self, other: Self) -> Self {
        Self { value: Scalar::min(self.value, other.value), bound: self.bound.max(other.bound) }
    }

    fn max(self, other: Self) -> Self {
        Self { value: Scalar::max(self.value, other.value), bound: self.bound.max(other.bound) }
    }
}

/// The exact sum of numbers of a format, and what their bounds add up to.
#[derive(Clone, Copy, Debug)]
pub struct RunningSum {
    sum: EmulatedSum,
    exact: f64,
    size: f64,
    bound: f64,
}

impl Accumulator<Running> for RunningSum {
    const ZERO: Self = Self { sum: EmulatedSum::ZERO, exact: 0.0, size: 0.0, bound: 0.0 };

    fn add(&mut self, term: Running) {
        self.sum.add(term.value);
        self.exact += term.value.to_f64();
        // each term may have rounded the sum by half a unit in the last place of what is there
        self.size += term.size() + self.exact.abs();
        self.bound = up(self.bound + term.bound);
    }

    fn total(self) -> Running {
        Running::made(self.sum.total(), self.exact, self.size, self.bound)
    }

    fn scaled_total(self, a: Running, b: Running) -> Running {
        let scale = (a.value.to_f64() * b.value.to_f64()).abs();
        let (sum, factors) = (self.exact.abs(), a.size() * b.bound + b.size() * a.bound + a.bound * b.bound);
        let carried = scale * self.bound + sum * factors + factors * self.bound;
        let exact = a.value.to_f64() * b.value.to_f64() * self.exact;
        Running::made(self.sum.scaled_total(a.value, b.value), exact, scale * self.size, carried)
    }
}
