//! Numbers of some 31 digits, as the truth that intervals and bounds are held against.
//!
//! T. J. Dekker, *A floating-point technique for extending the available precision*, Numer. Math. 1971.

use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, Scalar};

/// The sum of two f64s of which the second is less than half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDouble(pub(crate) f64, pub(crate) f64);

fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let sum = a + b;
    let rounded_b = sum - a;
    DoubleDouble(sum, (a - (sum - rounded_b)) + (b - rounded_b))
}

fn two_product(a: f64, b: f64) -> DoubleDouble {
    let product = a * b;
    DoubleDouble(product, a.mul_add(b, -product))
}

impl DoubleDouble {
    /// The order of this number and one of f64.
    pub(crate) fn compare(self, other: f64) -> Ordering {
        if other.is_infinite() {
            self.0.total_cmp(&other)
        } else {
            (self - Self(other, 0.0)).0.total_cmp(&0.0)
        }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.0, other.0), two_sum(self.1, other.1));
        let sum = two_sum(high.0, high.1 + low.0);
        two_sum(sum.0, sum.1 + low.1)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let high = two_product(self.0, other.0);
        two_sum(high.0, high.1 + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - other * Self(first, 0.0);
        let second = rest.0 / other.0;
        let rest = rest - other * Self(second, 0.0);
        two_sum(first, second) + Self(rest.0 / other.0, 0.0)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl AddAssign for DoubleDouble {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        (*self - *other).0.partial_cmp(&0.0)
    }
}

impl Arithmetic for DoubleDouble {
    const ZERO: Self = Self(0.0, 0.0);
    const ONE: Self = Self(1.0, 0.0);

    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self(numerator.into(), 0.0) / Self(denominator.into(), 0.0)
    }

    fn positive_part(self) -> Self {
        if self.0 > 0.0 { self } else { Self::default() }
    }

    fn times(self, n: i32) -> Self {
        self * Self(n.into(), 0.0)
    }
}

impl Scalar for DoubleDouble {
    type Sum = Self;

    const NAME: &'static str = "double-double";
    const EPSILON: Self = Self(f64::EPSILON * f64::EPSILON, 0.0);
    const MAX: Self = Self(f64::MAX, 0.0);

    fn from_f64(value: f64) -> Self {
        Self(value, 0.0)
    }

    fn to_f64(self) -> f64 {
        self.0
    }

    fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self::default();
        }
        let root = Self(self.0.sqrt(), 0.0);
        (root + self / root) * Self(0.5, 0.0)
    }

    fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    fn floor_to_i32(self) -> i32 {
        let floor = self.0.floor_to_i32();
        if self.compare(floor.into()).is_lt() { floor - 1 } else { floor }
    }

    fn canonical_bits(self) -> u64 {
        self.0.canonical_bits()
    }

    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        C::VALUES.get(row)?.get(i).map(|&entry| Self(entry, 0.0))
    }
}

impl Accumulator<Self> for DoubleDouble {
    const ZERO: Self = Self(0.0, 0.0);

    fn add(&mut self, term: Self) {
        *self += term;
    }

    fn total(self) -> Self {
        self
    }
}
