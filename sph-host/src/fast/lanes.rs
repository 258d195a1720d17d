//! Sixteen numbers at once: the type that sph-core's kernels are evaluated on here.

use std::hint::black_box;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use sph_core::Arithmetic;
use sph_core::Lane;

use super::evaluate::total;
use super::simd::{BLOCK, Real};

/// Sixteen numbers, on each of which every operation works.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lanes<T>(pub(crate) [T; BLOCK]);

impl<T: Real> Lanes<T> {
    /// The same number sixteen times.
    #[inline(always)]
    pub(crate) fn splat(value: T) -> Self {
        Self([value; BLOCK])
    }

    /// The root of each.
    #[inline(always)]
    pub(super) fn root(self) -> Self {
        self.each(
            #[inline(always)]
            |a| a.root(),
        )
    }

    /// The smaller of each two.
    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        self.both(
            other,
            #[inline(always)]
            |a, b| if a < b { a } else { b },
        )
    }

    /// The larger of each two.
    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        self.both(
            other,
            #[inline(always)]
            |a, b| if a > b { a } else { b },
        )
    }

    #[inline(always)]
    fn each(self, f: impl Fn(T) -> T) -> Self {
        Self(std::array::from_fn(
            #[inline(always)]
            |k| f(self.0[k]),
        ))
    }

    #[inline(always)]
    fn both(self, other: Self, f: impl Fn(T, T) -> T) -> Self {
        Self(std::array::from_fn(
            #[inline(always)]
            |k| f(self.0[k], other.0[k]),
        ))
    }
}

macro_rules! operator {
    ($Operator:ident $method:ident, $operator:tt) => {
        impl<T: Real> $Operator for Lanes<T> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.both(
                    other,
                    #[inline(always)]
                    |a, b| a $operator b,
                )
            }
        }
    };
}

operator!(Add add, +);
operator!(Sub sub, -);
operator!(Mul mul, *);
operator!(Div div, /);

impl<T: Real> Neg for Lanes<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.each(
            #[inline(always)]
            |a| -a,
        )
    }
}

impl<T: Real> AddAssign for Lanes<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real> SubAssign for Lanes<T> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<T: Real> Arithmetic for Lanes<T> {
    const ZERO: Self = Self([T::ZERO; BLOCK]);
    const ONE: Self = Self([T::ONE; BLOCK]);

    #[inline(always)]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::splat(T::ratio(numerator, denominator))
    }

    #[inline(always)]
    fn positive_part(self) -> Self {
        self.max(Self::ZERO)
    }

    #[inline(always)]
    fn times(self, n: i32) -> Self {
        self.each(
            #[inline(always)]
            |a| a.times(n),
        )
    }
}

/// Sums in sixteen columns.
impl<T: Real> Lane<T> for Lanes<T> {
    type Sum = Self;
    const EMPTY: Self = Self::ZERO;

    #[inline(always)]
    fn splat(value: T) -> Self {
        Self([value; BLOCK])
    }

    #[inline(always)]
    fn add_to(self, sum: &mut Self) {
        *sum += self;
    }

    #[inline(always)]
    fn total(sum: Self) -> T {
        total(black_box(sum.0))
    }

    #[inline(always)]
    fn where_above_zero(self, condition: Self) -> Self {
        self.both(
            condition,
            #[inline(always)]
            |a, condition| if condition > T::ZERO { a } else { T::ZERO },
        )
    }
}
