//! The n-th central difference (Thm 4.1) and what is made of it: partial derivatives and gradients of any field.
//!
//! ```text
//! f⁽ⁿ⁾(x) = lim_{s→0} (2s)^{-n} Σ_{k=0..n} (−1)^k C(n, k) f(x + (n − 2k) s)
//! ```
//!
//! (The paper's h is the step s here; h is a support radius elsewhere.) The truncation error is n s² f⁽ⁿ⁺²⁾(x) / 6 + O(s⁴):
//! second order, and exact for polynomials of degree n + 1. The sum's rounding error is about ε |f| / s^n, so the best step
//! is near ε^{1/(n+2)}: [`step_for`].

use crate::{Accumulator, Scalar};

/// The highest derivative that [`nth`] takes: all C(33, k) are below 2³¹, and C(34, 17) is not.
pub const HIGHEST: u32 = 33;

/// f⁽ⁿ⁾(x) with the step s: (2s)^{-n} Σ (−1)^k C(n, k) f(x + (n − 2k) s), summed from k = 0 on; n = 0 gives f(x).
///
/// Where a term C(n, k) f is not finite, because f is not or a narrow type's range ends, so is the result.
/// Nor is it where the quotient by (2s)^n leaves the range, or where n > [`HIGHEST`]: then it is 1/0 in T, and f is not asked.
/// Units of f per unit of x to the n.
///
/// ```
/// use sph_core::difference;
/// let third = difference::nth(|x: f64| x * x * x, 3, 5.0, 0.5);
/// assert_eq!(third, 6.0); // exact for degree ≤ n + 1
/// ```
pub fn nth<T: Scalar>(f: impl Fn(T) -> T, n: u32, x: T, step: T) -> T {
    if n > HIGHEST {
        return T::ONE / T::ZERO;
    }
    let mut sum = <T::Sum as Accumulator<T>>::ZERO;
    let mut binomial: i64 = 1;
    for k in 0..=n {
        let term = f(x + step.times(n as i32 - 2 * k as i32)).times(binomial as i32);
        if !term.is_finite() {
            return term; // held at the end of a narrow type's range, a sum of both signs would hide it
        }
        sum.add(if k % 2 == 0 { term } else { -term });
        binomial = binomial * (n - k) as i64 / (k as i64 + 1);
    }
    let width = step.times(2);
    (0..n).fold(sum.total(), |quotient, _| quotient / width)
}

/// f⁽ⁿ⁾(x) with the step chosen by the scalar's precision, [`step_for`].
///
/// ```
/// use sph_core::difference;
/// let slope = difference::nth_auto(|x: f64| x.sin(), 1, 1.0);
/// assert!((slope - 1.0_f64.cos()).abs() < 1e-9);
/// ```
pub fn nth_auto<T: Scalar>(f: impl Fn(T) -> T, n: u32, x: T) -> T {
    nth(f, n, x, step_for(n, x))
}

/// ∂f/∂x_axis at x by the central difference of a field f: ℝ^D → ℝ.
pub fn partial<T: Scalar, const D: usize>(f: impl Fn(&[T; D]) -> T, x: &[T; D], axis: usize, step: T) -> T {
    let along = |coordinate: T| {
        let mut moved = *x;
        if let Some(component) = moved.get_mut(axis) {
            *component = coordinate;
        }
        f(&moved)
    };
    x.get(axis).map_or(T::ZERO, |&coordinate| nth(along, 1, coordinate, step))
}

/// ∇f at x by central differences along each axis.
///
/// ```
/// use sph_core::difference;
/// let gradient = difference::gradient(|x: &[f64; 2]| x[0] * x[1], &[2.0, 3.0], 0.25);
/// assert_eq!(gradient, [3.0, 2.0]);
/// ```
pub fn gradient<T: Scalar, const D: usize>(f: impl Fn(&[T; D]) -> T, x: &[T; D], step: T) -> [T; D] {
    core::array::from_fn(|axis| partial(&f, x, axis, step))
}

/// The step for an n-th difference at x: [`relative_step`] times max(1, |x|).
pub fn step_for<T: Scalar>(n: u32, x: T) -> T {
    relative_step::<T>(n) * x.abs().max(T::ONE)
}

/// A power of two near ε^{1/(n+2)}, ε the scalar's [`Scalar::EPSILON`], where truncation and rounding errors balance; that of
/// [`HIGHEST`] for a larger n.
pub fn relative_step<T: Scalar>(n: u32) -> T {
    let half = T::ratio(1, 2);
    let mut step = half;
    // step^{n+2} > ε, compared without leaving the range of a narrow type
    while (0..n.min(HIGHEST) + 2).fold(T::ONE, |power, _| power * step) > T::EPSILON && step > T::EPSILON {
        step = step * half;
    }
    step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_grows_with_x_beyond_one() {
        for n in [1, 2, 5] {
            let step = relative_step::<f64>(n);
            let steps = [0.0, 0.25, 1.0, 8.0, -8.0].map(|x| step_for(n, x));
            assert_eq!(steps, [step, step, step, 8.0 * step, 8.0 * step]);
        }
    }

    /// Degree ≤ n + 1 leaves nothing to the truncation error, at any step.
    #[test]
    fn is_exact_on_polynomials_of_degree_n_plus_one() {
        for n in 0..=6_u32 {
            for degree in 0..=(n + 1) {
                let x = 0.75;
                let falling: f64 = (0..n).map(|i| degree as f64 - i as f64).product();
                let exact = if degree < n { 0.0 } else { falling * libm::pow(x, (degree - n) as f64) };
                let found = nth(|x: f64| libm::pow(x, degree as f64), n, x, 0.5);
                assert!(
                    (found - exact).abs() <= 1e-12 * exact.abs().max(1.0),
                    "n = {n}, degree {degree}: {found}"
                );
            }
        }
    }

    #[test]
    fn converges_with_order_two() {
        for n in 1..=3 {
            let exact = [libm::cos(0.7), -libm::sin(0.7), -libm::cos(0.7)][n as usize - 1];
            let error = |step: f64| (nth(libm::sin, n, 0.7, step) - exact).abs();
            let order = libm::log2(error(0.1) / error(0.05));
            assert!((order - 2.0).abs() < 0.1, "n = {n}: order {order}");
        }
    }

    #[test]
    fn chosen_steps_balance_truncation_and_rounding() {
        for (n, tolerance) in [(1, 1e-10), (2, 1e-7), (3, 1e-5)] {
            let exact = [libm::cos(0.7), -libm::sin(0.7), -libm::cos(0.7)][n as usize - 1];
            assert!((nth_auto(libm::sin, n, 0.7) - exact).abs() < tolerance, "n = {n}");
        }
        assert!((nth_auto(|x: f32| x * x * x, 1, 2.0) - 12.0).abs() < 2e-3);
    }

    /// x^33 has the 33rd derivative 33!.
    #[test]
    fn the_highest_is_as_good_as_others_and_one_more_is_not_finite() {
        let factorial: f64 = (1..=33).map(f64::from).product();
        let found = nth(|x: f64| libm::pow(x, 33.0), HIGHEST, 0.0, 0.5);
        assert!((found / factorial - 1.0).abs() < 1e-12, "{found}");
        let never = |_: f64| -> f64 { panic!("f is not asked") };
        for n in [HIGHEST + 1, 1000, u32::MAX] {
            assert_eq!(nth(never, n, 1.0, 0.5), f64::INFINITY, "n = {n}");
            assert_eq!(nth_auto(never, n, 1.0), f64::INFINITY, "n = {n}");
        }
    }

    #[test]
    fn zeroth_difference_is_the_function() {
        assert_eq!(nth(|x: f32| x + 1.0, 0, 2.0, 0.1), 3.0);
    }

    #[test]
    fn partials_differentiate_one_axis_alone() {
        let f = |x: &[f64; 3]| x[0] * x[0] + 10.0 * x[1] - x[2];
        assert_eq!(gradient(f, &[3.0, 1.0, 2.0], 0.5), [6.0, 10.0, -1.0]);
        assert_eq!(partial(f, &[3.0, 1.0, 2.0], 7, 0.5), 0.0);
    }
}
