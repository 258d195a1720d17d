//! Vectors are plain arrays `[T; D]`; these are the operations the sums need. Components are added from the first axis on.

use crate::Arithmetic;

/// x − y
#[inline(always)]
#[track_caller]
pub fn sub<T: Arithmetic, const D: usize>(x: &[T; D], y: &[T; D]) -> [T; D] {
    core::array::from_fn(|axis| x[axis] - y[axis])
}

/// x + y
#[inline(always)]
#[track_caller]
pub fn add<T: Arithmetic, const D: usize>(x: &[T; D], y: &[T; D]) -> [T; D] {
    core::array::from_fn(|axis| x[axis] + y[axis])
}

/// s x
#[inline(always)]
#[track_caller]
pub fn scale<T: Arithmetic, const D: usize>(x: &[T; D], s: T) -> [T; D] {
    x.map(|component| component * s)
}

/// x · y
#[inline(always)]
#[track_caller]
pub fn dot<T: Arithmetic, const D: usize>(x: &[T; D], y: &[T; D]) -> T {
    let mut sum = T::ZERO;
    for axis in 0..D {
        sum += x[axis] * y[axis];
    }
    sum
}

/// |x|² = x · x
///
/// ```
/// assert_eq!(sph_core::vector::norm_squared(&[3.0_f32, 4.0]), 25.0);
/// ```
#[inline(always)]
#[track_caller]
pub fn norm_squared<T: Arithmetic, const D: usize>(x: &[T; D]) -> T {
    dot(x, x)
}
