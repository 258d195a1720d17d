//! Gauss–Legendre quadrature, for the constants of kernels that have no closed form.
//!
//! Each panel uses eight nodes, exact for polynomials of degree 15; the interval is cut into 30 panels, so that the joints
//! of every customary spline (multiples of 1/5, 1/3 and 1/2 of the support) fall between panels, where they cost no
//! accuracy. Nodes and weights: M. Abramowitz, I. A. Stegun, *Handbook of Mathematical Functions* (1964), table 25.4.

use crate::Scalar;

const PANELS: i32 = 30;

/// Nodes on (0, 1) and weights of the eight-point rule on [−1, 1].
const RULE: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// ∫ₐᵇ f dx; the integrand is never asked for at the ends. Not finite where f, the sum of two of its values, or the integral so
/// far is not: narrow types end soon.
///
/// ```
/// let third = sph_core::quadrature::integrate(|x: f64| x * x, 0.0, 1.0);
/// assert!((third - 1.0 / 3.0).abs() < 1e-15);
/// ```
pub fn integrate<T: Scalar>(f: impl Fn(T) -> T, a: T, b: T) -> T {
    let half = (b - a) * T::ratio(1, 2 * PANELS);
    let mut integral = T::ZERO;
    for panel in 0..PANELS {
        let centre = a + half.times(2 * panel + 1);
        let mut sum = T::ZERO;
        for (node, weight) in RULE {
            let offset = half * T::from_f64(node);
            let pair = f(centre - offset) + f(centre + offset);
            if !pair.is_finite() {
                return pair;
            }
            sum += T::from_f64(weight) * pair;
        }
        integral += sum * half;
        if !integral.is_finite() {
            return integral;
        }
    }
    integral
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_exact_for_degree_fifteen() {
        let value = integrate(|x: f64| 16.0 * libm::pow(x, 15.0), 0.0, 2.0);
        assert!((value / 65536.0 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn joints_of_splines_cost_no_accuracy() {
        for joint in [0.5, 0.6, 0.2, 1.0 / 3.0, 2.0 / 3.0] {
            let value = integrate(|x: f64| (joint - x).max(0.0), 0.0, 1.0);
            assert!((value / (joint * joint / 2.0) - 1.0).abs() < 1e-14, "joint {joint}");
        }
    }

    #[test]
    fn an_empty_interval_has_no_integral() {
        assert_eq!(integrate(|x: f32| x, 2.0, 2.0), 0.0);
    }
}
