//! The operations of chosen numbers: each is that of the type in use.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, Scalar};

use super::{Blame, Chosen, ChosenSum, Emulated, KIND, Kind, Mini, Number, Running, Sums, Tally, Variant};

macro_rules! operators {
    ($($Trait:ident $method:ident $sign:tt;)+) => {$(
        impl $Trait for Chosen {
            type Output = Self;

            #[track_caller]
            fn $method(self, other: Self) -> Self {
                with_type!(T => (T::of(self.0) $sign T::of(other.0)).chosen())
            }
        }
    )+};
}
operators! {
    Add add +;
    Sub sub -;
    Mul mul *;
    Div div /;
}
crate::assign::assign_operators!([] Chosen);
sph_core::own_companion!([] Chosen, Chosen(Number::Zero));

impl Neg for Chosen {
    type Output = Self;

    fn neg(self) -> Self {
        with_type!(T => (-T::of(self.0)).chosen())
    }
}

impl PartialEq for Chosen {
    #[track_caller]
    fn eq(&self, other: &Self) -> bool {
        with_type!(T => T::of(self.0) == T::of(other.0))
    }
}

macro_rules! comparisons {
    ($($method:ident: $Answer:ty;)+) => {$(
        #[track_caller]
        fn $method(&self, other: &Self) -> $Answer {
            with_type!(T => T::of(self.0).$method(&T::of(other.0)))
        }
    )+};
}

impl PartialOrd for Chosen {
    comparisons! {
        partial_cmp: Option<Ordering>;
        lt: bool;
        le: bool;
        gt: bool;
        ge: bool;
    }
}

impl Arithmetic for Chosen {
    const ZERO: Self = Self(Number::Zero);
    const ONE: Self = Self(Number::One);

    #[track_caller]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        with_type!(T => T::ratio(numerator, denominator).chosen())
    }

    #[track_caller]
    fn positive_part(self) -> Self {
        with_type!(T => T::of(self.0).positive_part().chosen())
    }

    #[track_caller]
    fn times(self, n: i32) -> Self {
        with_type!(T => T::of(self.0).times(n).chosen())
    }
}

impl Scalar for Chosen {
    type Sum = ChosenSum;

    const NAME: &'static str = "chosen";
    const EPSILON: Self = Self(Number::Epsilon);
    const MAX: Self = Self(Number::Max);

    #[track_caller]
    fn from_f64(value: f64) -> Self {
        with_type!(T => T::from_f64(value).chosen())
    }

    fn to_f64(self) -> f64 {
        with_type!(T => T::of(self.0).to_f64())
    }

    #[track_caller]
    fn sqrt(self) -> Self {
        with_type!(T => T::of(self.0).sqrt().chosen())
    }

    fn is_finite(self) -> bool {
        with_type!(T => T::of(self.0).is_finite())
    }

    fn floor_to_i32(self) -> i32 {
        with_type!(T => T::of(self.0).floor_to_i32())
    }

    fn canonical_bits(self) -> u64 {
        with_type!(T => T::of(self.0).canonical_bits())
    }

    #[track_caller]
    fn split(self, bits: u32) -> (usize, Self) {
        with_type!(T => {
            let (place, rest) = T::of(self.0).split(bits);
            (place, rest.chosen())
        })
    }

    #[track_caller]
    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        with_type!(T => T::constant::<C, ROWS, N>(row, i).map(Variant::chosen))
    }

    fn is_above_zero(self) -> bool {
        with_type!(T => T::of(self.0).is_above_zero())
    }

    #[track_caller]
    fn abs(self) -> Self {
        with_type!(T => Scalar::abs(T::of(self.0)).chosen())
    }

    #[track_caller]
    fn min(self, other: Self) -> Self {
        with_type!(T => Scalar::min(T::of(self.0), T::of(other.0)).chosen())
    }

    #[track_caller]
    fn max(self, other: Self) -> Self {
        with_type!(T => Scalar::max(T::of(self.0), T::of(other.0)).chosen())
    }
}

impl Accumulator<Chosen> for ChosenSum {
    const ZERO: Self = Self(Sums::Empty);

    #[track_caller]
    fn add(&mut self, term: Chosen) {
        with_type!(T => {
            let mut sum = T::sum_of(*self);
            sum.add(T::of(term.0));
            *self = T::chosen_sum(sum);
        });
    }

    #[track_caller]
    fn total(self) -> Chosen {
        with_type!(T => T::sum_of(self).total().chosen())
    }

    #[track_caller]
    fn scaled_total(self, a: Chosen, b: Chosen) -> Chosen {
        with_type!(T => T::sum_of(self).scaled_total(T::of(a.0), T::of(b.0)).chosen())
    }
}
