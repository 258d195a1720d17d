//! A number and its derivatives.

use std::array::from_fn;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, Scalar};

/// A number and its derivatives by N variables, carried along exactly (W. K. Clifford's dual numbers, forward differentiation).
///
/// Comparisons are those of the values. The derivative of (x)₊ is 0 for x ≤ 0, and that of √x is taken as 0 at 0: so ∇W is 0 at the
/// sample itself, where every kernel has its maximum. Duals nest: `Dual<Dual<f64, N>, N>` has second derivatives.
///
/// How a pendant's fluid answers to its tilt, by the same code that the firmware runs:
///
/// ```
/// use sph_core::Scalar;
/// use sph_lab::Dual;
///
/// /// Where a drop is after some frames on a slope, which friction slows.
/// fn drop<T: Scalar>(tilt: T) -> T {
///     let (mut place, mut speed) = (T::ZERO, T::ZERO);
///     for _ in 0..60 {
///         speed += (tilt - speed * T::ratio(1, 2)) * T::ratio(1, 60);
///         place += speed * T::ratio(1, 60);
///     }
///     place
/// }
/// let [slope] = drop(Dual::variable(0.3, 0)).derivatives();
/// let difference = (drop(0.3 + 1e-4) - drop(0.3 - 1e-4)) / 2e-4;
/// assert!((slope - difference).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dual<T, const N: usize> {
    value: T,
    derivatives: [T; N],
}

impl<T: Scalar, const N: usize> Dual<T, N> {
    /// A number that depends on no variable.
    #[must_use]
    pub const fn constant(value: T) -> Self {
        Self { value, derivatives: [T::ZERO; N] }
    }

    /// The variable of this number, from 0; one that depends on no variable where there are not so many.
    #[must_use]
    pub fn variable(value: T, number: usize) -> Self {
        Self { value, derivatives: from_fn(|k| if k == number { T::ONE } else { T::ZERO }) }
    }

    /// All variables at once.
    #[must_use]
    pub fn variables(values: [T; N]) -> [Self; N] {
        from_fn(|k| Self::variable(values[k], k))
    }

    /// The number.
    #[must_use]
    pub fn value(self) -> T {
        self.value
    }

    /// Its derivatives, variable by variable.
    #[must_use]
    pub fn derivatives(self) -> [T; N] {
        self.derivatives
    }

    /// a′ b + a b′
    #[inline]
    #[track_caller]
    fn slope_of_product(self, other: Self, k: usize) -> T {
        self.derivatives[k] * other.value + self.value * other.derivatives[k]
    }

    /// (a′ − (a/b) b′) / b
    #[inline]
    #[track_caller]
    fn slope_of_quotient(self, other: Self, quotient: T, k: usize) -> T {
        (self.derivatives[k] - quotient * other.derivatives[k]) / other.value
    }

    /// A value, and what each derivative is.
    #[inline]
    fn of(value: T, derivative: impl Fn(usize) -> T) -> Self {
        Self { value, derivatives: from_fn(derivative) }
    }
}

impl<T: Scalar, const N: usize> Default for Dual<T, N> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<T: Scalar, const N: usize> Add for Dual<T, N> {
    type Output = Self;

    #[inline]
    #[track_caller]
    fn add(self, other: Self) -> Self {
        Self::of(self.value + other.value, |k| self.derivatives[k] + other.derivatives[k])
    }
}

impl<T: Scalar, const N: usize> Sub for Dual<T, N> {
    type Output = Self;

    #[inline]
    #[track_caller]
    fn sub(self, other: Self) -> Self {
        Self::of(self.value - other.value, |k| self.derivatives[k] - other.derivatives[k])
    }
}

impl<T: Scalar, const N: usize> Mul for Dual<T, N> {
    type Output = Self;

    #[inline]
    #[track_caller]
    fn mul(self, other: Self) -> Self {
        Self::of(self.value * other.value, |k| self.slope_of_product(other, k))
    }
}

impl<T: Scalar, const N: usize> Div for Dual<T, N> {
    type Output = Self;

    #[inline]
    #[track_caller]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        Self::of(quotient, |k| self.slope_of_quotient(other, quotient, k))
    }
}

impl<T: Scalar, const N: usize> Neg for Dual<T, N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::of(-self.value, |k| -self.derivatives[k])
    }
}

crate::assign::assign_operators!([T: Scalar, const N: usize] Dual<T, N>);
sph_core::own_companion!([T: Scalar, const N: usize] Dual<T, N>, Dual::constant(T::ZERO));

/// Whether the values are equal.
impl<T: Scalar, const N: usize> PartialEq for Dual<T, N> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T: Scalar, const N: usize> PartialOrd for Dual<T, N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }

    fn lt(&self, other: &Self) -> bool {
        self.value < other.value
    }

    fn le(&self, other: &Self) -> bool {
        self.value <= other.value
    }

    fn gt(&self, other: &Self) -> bool {
        self.value > other.value
    }

    fn ge(&self, other: &Self) -> bool {
        self.value >= other.value
    }
}

impl<T: Scalar, const N: usize> Arithmetic for Dual<T, N> {
    const ZERO: Self = Self::constant(T::ZERO);
    const ONE: Self = Self::constant(T::ONE);

    #[inline]
    #[track_caller]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::constant(T::ratio(numerator, denominator))
    }

    #[inline]
    fn positive_part(self) -> Self {
        let is_above = self.value.is_above_zero();
        Self::of(self.value.positive_part(), |k| if is_above { self.derivatives[k] } else { T::ZERO })
    }

    #[inline]
    #[track_caller]
    fn times(self, n: i32) -> Self {
        Self::of(self.value.times(n), |k| self.derivatives[k].times(n))
    }
}

impl<T: Scalar, const N: usize> Scalar for Dual<T, N> {
    type Sum = DualSum<T, N>;

    const NAME: &'static str = T::NAME;
    const EPSILON: Self = Self::constant(T::EPSILON);
    const MAX: Self = Self::constant(T::MAX);

    #[inline]
    #[track_caller]
    fn from_f64(value: f64) -> Self {
        Self::constant(T::from_f64(value))
    }

    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    /// (√x)′ = x′ / (2 √x)
    #[inline]
    #[track_caller]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        if !root.is_above_zero() {
            return Self::constant(root);
        }
        let double = root + root;
        Self::of(root, |k| self.derivatives[k] / double)
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

    #[inline]
    #[track_caller]
    fn split(self, bits: u32) -> (usize, Self) {
        let (place, rest) = self.value.split(bits);
        let factor = 1_i32.wrapping_shl(bits);
        (place, Self::of(rest, |k| self.derivatives[k].times(factor)))
    }

    #[inline]
    #[track_caller]
    fn constant<C: Table<ROWS, M>, const ROWS: usize, const M: usize>(row: usize, i: usize) -> Option<Self> {
        T::constant::<C, ROWS, M>(row, i).map(Self::constant)
    }

    fn is_above_zero(self) -> bool {
        self.value.is_above_zero()
    }
}

/// A sum of values, and one for each derivative.
#[derive(Clone, Copy, Debug)]
pub struct DualSum<T: Scalar, const N: usize> {
    value: T::Sum,
    derivatives: [T::Sum; N],
}

impl<T: Scalar, const N: usize> Accumulator<Dual<T, N>> for DualSum<T, N> {
    const ZERO: Self = Self { value: T::Sum::ZERO, derivatives: [T::Sum::ZERO; N] };

    #[inline]
    #[track_caller]
    fn add(&mut self, term: Dual<T, N>) {
        self.value.add(term.value);
        self.derivatives.iter_mut().zip(term.derivatives).for_each(|(sum, derivative)| sum.add(derivative));
    }

    #[inline]
    #[track_caller]
    fn total(self) -> Dual<T, N> {
        Dual::of(self.value.total(), |k| self.derivatives[k].total())
    }
}
