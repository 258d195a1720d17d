//! What a field's values can be: scalars or vectors.

use super::Summand;
use crate::{Arithmetic, Scalar};

/// The value of a field at a sample: `T`, or `[T; N]`, of which each component is estimated as a field of its own.
pub trait Quantity<T: Scalar>: Summand<T, T, Total = Self> {
    /// 0 in each component.
    const ZERO: Self;
    /// One thing for each component.
    type Each<X: Copy>: Copy;

    /// The same thing for each component.
    fn each<X: Copy>(thing: X) -> Self::Each<X>;
    /// Visits all things, each with its component.
    fn visit<X: Copy>(self, things: &mut Self::Each<X>, visit: impl FnMut(&mut X, T));
    /// The components that things become, if all become one.
    fn collect<X: Copy>(things: Self::Each<X>, component: impl FnMut(X) -> Option<T>) -> Option<Self>;
}

impl<T: Scalar> Quantity<T> for T {
    const ZERO: T = <T as Arithmetic>::ZERO;
    type Each<X: Copy> = X;

    #[inline(always)]
    fn each<X: Copy>(thing: X) -> X {
        thing
    }

    #[inline(always)]
    fn visit<X: Copy>(self, thing: &mut X, mut visit: impl FnMut(&mut X, T)) {
        visit(thing, self);
    }

    #[inline(always)]
    fn collect<X: Copy>(thing: X, mut component: impl FnMut(X) -> Option<T>) -> Option<T> {
        component(thing)
    }
}

impl<T: Scalar, const N: usize> Quantity<T> for [T; N] {
    const ZERO: Self = [<T as Arithmetic>::ZERO; N];
    type Each<X: Copy> = [X; N];

    #[inline(always)]
    fn each<X: Copy>(thing: X) -> [X; N] {
        [thing; N]
    }

    #[inline(always)]
    fn visit<X: Copy>(self, things: &mut [X; N], mut visit: impl FnMut(&mut X, T)) {
        for (thing, &component) in things.iter_mut().zip(&self) {
            visit(thing, component);
        }
    }

    #[inline(always)]
    fn collect<X: Copy>(things: [X; N], mut component: impl FnMut(X) -> Option<T>) -> Option<Self> {
        let mut all = <Self as Quantity<T>>::ZERO;
        for (out, thing) in all.iter_mut().zip(things) {
            *out = component(thing)?;
        }
        Some(all)
    }
}
