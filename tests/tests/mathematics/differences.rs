//! Thm 4.1: f^[n](x) = lim (2s)^{-n} Σ (−1)^k C(n, k) f(x + (n − 2k) s).

use crate::assert_near;
use sph_core::difference;

/// sin, sin′, sin″, sin‴ at x.
fn derivatives_of_sine(n: u32, x: f64) -> f64 {
    [x.sin(), x.cos(), -x.sin(), -x.cos()][n as usize % 4]
}

/// Observed order 2.0 ± 0.1 for n = 1, 2, 3, over three halvings; the constant is n/6 f^[n+2].
#[test]
fn observed_order_is_two() {
    for n in 1..=3 {
        for x in [0.7, -1.9, 4.1] {
            let error = |step: f64| difference::nth(f64::sin, n, x, step) - derivatives_of_sine(n, x);
            for step in [0.1, 0.05, 0.025] {
                let order = (error(step) / error(step / 2.0)).log2();
                assert!((order - 2.0).abs() < 0.1, "n = {n}, x = {x}, s = {step}: order {order}");
                let leading = n as f64 / 6.0 * step * step * derivatives_of_sine(n + 2, x);
                assert!((error(step) / leading - 1.0).abs() < 0.02, "n = {n}, s = {step}");
            }
        }
    }
}

/// x^degree and its n-th derivative, with the largest term of the sum as the scale of the rounding.
fn monomial(degree: u32, n: u32, x: f64) -> f64 {
    let falling: f64 = (0..n).map(|i| degree as f64 - i as f64).product();
    if degree < n { 0.0 } else { falling * x.powi((degree - n) as i32) }
}

/// Exact on polynomials of degree ≤ n + 1, n ≤ 6, to a few roundings of the largest term 2^n |f| / (2s)^n.
#[test]
fn exact_on_polynomials_of_degree_n_plus_one() {
    for n in 0..=6_u32 {
        for degree in 0..=n + 1 {
            for x in [-2.3, 0.0, 0.6, 5.5] {
                for step in [0.25, 0.4, 1.0] {
                    let exact = monomial(degree, n, x);
                    let reach = x.abs() + n as f64 * step;
                    let rounding =
                        4.0 * (degree + 1) as f64 * reach.powi(degree as i32) / step.powi(n as i32);
                    let found = difference::nth(|x: f64| x.powi(degree as i32), n, x, step);
                    let what = format!("n = {n}, degree {degree}, x = {x}, s = {step}");
                    assert_near(found, exact, rounding * f64::EPSILON, &what);
                    let found = difference::nth(|x: f32| x.powi(degree as i32), n, x as f32, step as f32);
                    assert_near(found.into(), exact, 2.0 * rounding * f64::from(f32::EPSILON), &what);
                }
            }
        }
    }
}

/// Degree n + 2 is not exact: the error is n/6 s² (n + 2)!, so that the tests above can fail.
#[test]
fn degree_n_plus_two_has_the_error_of_the_theorem() {
    for n in 1..=6_u32 {
        let factorial: f64 = (1..=n + 2).map(f64::from).product();
        let found = difference::nth(|x: f64| x.powi(n as i32 + 2), n, 0.0, 0.5);
        let expected = n as f64 / 6.0 * 0.25 * factorial;
        assert_near(found, expected, 1e-12 * factorial, &format!("n = {n}"));
    }
}

/// The chosen step ε^{1/(n+2)} leaves an error near ε^{2/(n+2)}: within 10 of it, in f64 and f32, at |x| ≫ 1 too.
#[test]
fn chosen_step_leaves_the_error_it_promises() {
    for n in 1..=4_u32 {
        for x in [0.7, 3.3, 40.0] {
            let exact = derivatives_of_sine(n, x);
            let promise = |epsilon: f64| 10.0 * (epsilon.powf(2.0 / (n as f64 + 2.0))) * f64::max(1.0, x * x);
            let found = difference::nth_auto(f64::sin, n, x);
            assert_near(found, exact, promise(f64::EPSILON), &format!("f64, n = {n}, x = {x}"));
            if x < 10.0 {
                let exact = derivatives_of_sine(n, (x as f32).into());
                let found = difference::nth_auto(f32::sin, n, x as f32);
                assert_near(found.into(), exact, promise(f32::EPSILON.into()), &format!("f32, n = {n}"));
            }
        }
    }
    assert!((difference::relative_step::<f64>(1) / f64::EPSILON.powf(1.0 / 3.0)).log2().abs() <= 1.0);
    assert!((difference::relative_step::<f32>(2) / f32::EPSILON.powf(0.25)).log2().abs() <= 1.0);
}

/// Partials differentiate along their own axis alone, in four dimensions.
#[test]
fn gradient_of_a_quadratic_in_four_dimensions_is_exact() {
    let f = |x: &[f64; 4]| x[0] * x[1] + 3.0 * x[2] * x[2] - x[3];
    assert_eq!(difference::gradient(f, &[2.0, 5.0, 0.5, 9.0], 0.25), [5.0, 2.0, 3.0, -1.0]);
    assert_eq!(difference::partial(f, &[2.0, 5.0, 0.5, 9.0], 2, 0.25), 3.0);
}
