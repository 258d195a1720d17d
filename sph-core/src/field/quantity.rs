//! What a field's values can be: scalars or vectors.

use crate::{Accumulator, Scalar};

/// A value that can be weighted and summed: `T`, or `[T; N]` component by component.
pub trait Quantity<T: Scalar>: Copy {
    /// The running sum.
    type Sum: Copy;
    /// The empty sum.
    const EMPTY: Self::Sum;

    /// Adds weight · self to the sum.
    fn add_to(self, sum: &mut Self::Sum, weight: T);
    /// The sum, rounded to the scalar once.
    fn total(sum: Self::Sum) -> Self;
    /// self / divisor
    fn divided(self, divisor: T) -> Self;
}

impl<T: Scalar> Quantity<T> for T {
    type Sum = T::Sum;
    const EMPTY: T::Sum = T::Sum::ZERO;

    #[inline(always)]
    fn add_to(self, sum: &mut T::Sum, weight: T) {
        sum.add(self * weight);
    }

    #[inline(always)]
    fn total(sum: T::Sum) -> T {
        sum.total()
    }

    #[inline(always)]
    fn divided(self, divisor: T) -> T {
        self / divisor
    }
}

impl<T: Scalar, const N: usize> Quantity<T> for [T; N] {
    type Sum = [T::Sum; N];
    const EMPTY: Self::Sum = [T::Sum::ZERO; N];

    #[inline(always)]
    fn add_to(self, sum: &mut Self::Sum, weight: T) {
        for (component, sum) in self.iter().zip(sum) {
            sum.add(*component * weight);
        }
    }

    #[inline(always)]
    fn total(sum: Self::Sum) -> Self {
        sum.map(Accumulator::total)
    }

    #[inline(always)]
    fn divided(self, divisor: T) -> Self {
        self.map(|component| component / divisor)
    }
}
