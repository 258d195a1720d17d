//! The fluid's short numbers, telling their size: those that the watched type has, not others in their place.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::panic::Location;

use sph_core::Arithmetic;
use sph_core::scalar::compact::{NearUnit, Pack};

use super::place::Operation;
use super::recorder::record;

/// The companion of a [`Tally`](super::Tally): an N that tells, place by place, how large results are. Short numbers wrap where they
/// leave their range and do not tell it, so that no saturation is counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct TallyNear<N>(pub(super) N);

impl<N: NearUnit> TallyNear<N> {
    /// The number within.
    #[must_use]
    pub fn value(self) -> N {
        self.0
    }

    // a call, so that code that is watched stays small
    #[inline(never)]
    #[track_caller]
    pub(super) fn made(operation: Operation, value: N) -> Self {
        let location = Location::caller();
        record(|recorder| {
            let number = recorder.number(location, operation);
            recorder.records[number as usize].add(value.to_f64(), 0.0);
        });
        Self(value)
    }
}

macro_rules! operators {
    ($($Trait:ident $method:ident $sign:tt $operation:ident;)+) => {$(
        impl<N: NearUnit> $Trait for TallyNear<N> {
            type Output = Self;

            #[inline]
            #[track_caller]
            fn $method(self, other: Self) -> Self {
                Self::made(Operation::$operation, self.0 $sign other.0)
            }
        }
    )+};
}
operators! {
    Add add + Add;
    Sub sub - Subtract;
    Mul mul * Multiply;
    Div div / Divide;
}
crate::assign::assign_operators!([N: NearUnit] TallyNear<N>);

impl<N: NearUnit> Neg for TallyNear<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<N: NearUnit> Arithmetic for TallyNear<N> {
    const ZERO: Self = Self(N::ZERO);
    const ONE: Self = Self(N::ONE);

    #[inline]
    #[track_caller]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::made(Operation::Ratio, N::ratio(numerator, denominator))
    }

    #[inline]
    fn positive_part(self) -> Self {
        Self(self.0.positive_part())
    }

    #[inline]
    #[track_caller]
    fn times(self, n: i32) -> Self {
        Self::made(Operation::Times, self.0.times(n))
    }
}

/// The numbers within.
fn within<N: Copy, const D: usize>(vector: &[TallyNear<N>; D]) -> [N; D] {
    vector.map(|number| number.0)
}

impl<N: NearUnit> NearUnit for TallyNear<N> {
    type Packed<const D: usize> = TallyPack<N::Packed<D>>;

    #[inline]
    fn all_between<const D: usize>(x: &[Self; D], low: Self, high: &[Self; D]) -> bool {
        N::all_between(&within(x), low.0, &within(high))
    }

    #[inline]
    fn to_f64(self) -> f64 {
        self.0.to_f64()
    }

    #[inline]
    fn floor(self) -> i32 {
        self.0.floor()
    }

    #[inline]
    #[track_caller]
    fn norm_squared<const D: usize>(v: &[Self; D]) -> Self {
        Self::made(Operation::Total, N::norm_squared(&within(v)))
    }

    #[inline]
    #[track_caller]
    fn mul_rounded(self, other: Self) -> Self {
        Self::made(Operation::Multiply, self.0.mul_rounded(other.0))
    }

    #[inline]
    fn clamp_abs(self, limit: Self) -> Self {
        Self(self.0.clamp_abs(limit.0))
    }
}

/// A vector of short numbers in memory, as the watched type has it.
#[derive(Clone, Copy, Debug)]
pub struct TallyPack<P>(P);

impl<N: NearUnit, P: Pack<N, D>, const D: usize> Pack<TallyNear<N>, D> for TallyPack<P> {
    const ZERO: Self = Self(P::ZERO);

    #[inline]
    fn pack(vector: [TallyNear<N>; D]) -> Self {
        Self(P::pack(within(&vector)))
    }

    #[inline]
    fn unpack(self) -> [TallyNear<N>; D] {
        self.0.unpack().map(TallyNear)
    }

    #[inline]
    fn plus(self, other: Self) -> Self {
        Self(self.0.plus(other.0))
    }

    #[inline]
    fn minus(self, other: Self) -> Self {
        Self(self.0.minus(other.0))
    }
}
