//! Quartic B-spline M₅.
//!
//! ```text
//! f(q)  =    (1 − q)₊⁴ −  5 (3/5 − q)₊⁴ + 10 (1/5 − q)₊⁴
//! f′(q) = −4 (1 − q)₊³ + 20 (3/5 − q)₊³ − 40 (1/5 − q)₊³
//! ```
//!
//! Evaluated with m = (3/2 − 5q/2)₊ and n = (1 − 5q)₊, whose zeros every scalar has exactly and whose coefficients are small:
//! f = (1 − q)₊⁴ − 16/125 m⁴ + 2/125 n⁴.
//!
//! Source: D. J. Price, *Smoothed particle hydrodynamics and magnetohydrodynamics*, J. Comput. Phys. 231 (2012) 759, there with
//! smoothing length 2h / 5.

use super::{Kernel, Term};
use crate::Arithmetic;

/// M₅; formula and source in the [module](self).
///
/// ```
/// use sph_core::kernel::{Kernel, QuarticSpline};
/// assert_eq!(QuarticSpline::profile(1.0_f32), 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct QuarticSpline;

impl Kernel for QuarticSpline {
    const SUPPORT_RATIO: (i32, i32) = (5, 2);
    const TERMS: &'static [Term] =
        &[Term::new(1.0, 1.0, 4, 0), Term::new(-5.0, 0.6, 4, 0), Term::new(10.0, 0.2, 4, 0)];

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        let [outer, middle, inner] = edges(q);
        outer.pow::<4>() - middle.pow::<4>() * T::ratio(16, 125) + inner.pow::<4>() * T::ratio(2, 125)
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        let [outer, middle, inner] = edges(q);
        (middle.pow::<3>() * T::ratio(8, 25) - outer.pow::<3>() - inner.pow::<3>() * T::ratio(2, 25)).times(4)
    }
}

/// The distances to the three joints in units that make them exact, cut at zero.
#[inline(always)]
fn edges<T: Arithmetic>(q: T) -> [T; 3] {
    [T::ONE - q, T::ratio(3, 2) - q * T::ratio(5, 2), T::ONE - q.times(5)].map(T::positive_part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::conformance;
    use core::f64::consts::PI;

    #[test]
    fn normalisation_matches_the_literature() {
        let sigma = [
            3125.0 / 768.0,
            46875.0 / (2398.0 * PI),
            15625.0 / (512.0 * PI),
            5468750.0 / (35783.0 * PI * PI),
        ];
        conformance::check_normalisation::<QuarticSpline>(&sigma);
    }
}
