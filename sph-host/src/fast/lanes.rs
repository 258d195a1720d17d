//! N numbers at once: the type that sph-core's kernels are evaluated on here.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use sph_core::Arithmetic;
use sph_core::fluid::wcsph::Lane;

use super::evaluate::total;
use super::simd::{BLOCK, Real};
use std::hint::black_box;

/// N numbers, on each of which every operation works.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lanes<T, const N: usize>(pub(crate) [T; N]);

impl<T: Real, const N: usize> Lanes<T, N> {
    /// The same number N times.
    #[inline(always)]
    pub(crate) fn splat(value: T) -> Self {
        Self([value; N])
    }

    /// The numbers of one group of N.
    #[inline(always)]
    pub(super) fn of(values: &[T; BLOCK], group: usize) -> Self {
        Self(std::array::from_fn(
            #[inline(always)]
            |k| values[group * N + k],
        ))
    }

    /// Puts them where [`of`](Self::of) takes them from.
    #[inline(always)]
    pub(super) fn put(self, values: &mut [T; BLOCK], group: usize) {
        values[group * N..(group + 1) * N].copy_from_slice(&self.0);
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
        impl<T: Real, const N: usize> $Operator for Lanes<T, N> {
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

impl<T: Real, const N: usize> Neg for Lanes<T, N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.each(
            #[inline(always)]
            |a| -a,
        )
    }
}

impl<T: Real, const N: usize> AddAssign for Lanes<T, N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real, const N: usize> SubAssign for Lanes<T, N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<T: Real, const N: usize> Arithmetic for Lanes<T, N> {
    const ZERO: Self = Self([T::ZERO; N]);
    const ONE: Self = Self([T::ONE; N]);

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

/// Sixteen columns, whatever the width of a vector, so that every instruction set gives the same bits.
impl<T: Real> Lane<T> for Lanes<T, BLOCK> {
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
