//! Quintic B-spline M₆.
//!
//! ```text
//! f(q)  =    (1 − q)₊⁵ −  6 (2/3 − q)₊⁵ + 15 (1/3 − q)₊⁵
//! f′(q) = −5 (1 − q)₊⁴ + 30 (2/3 − q)₊⁴ − 75 (1/3 − q)₊⁴
//! ```
//!
//! Evaluated with m = (1 − 3q/2)₊ and n = (1 − 3q)₊, whose zeros every scalar has exactly and whose coefficients are small:
//! f = (1 − q)₊⁵ − 64/81 m⁵ + 5/81 n⁵.
//!
//! Source: D. J. Price, *Smoothed particle hydrodynamics and magnetohydrodynamics*, J. Comput. Phys. 231 (2012) 759, there with
//! smoothing length h / 3.

use super::{Kernel, Term};
use crate::Arithmetic;

/// M₆; formula and source in the [module](self).
///
/// ```
/// use sph_core::kernel::{Kernel, QuinticSpline};
/// assert_eq!(QuinticSpline::profile(1.0_f32), 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct QuinticSpline;

impl Kernel for QuinticSpline {
    const SUPPORT_RATIO: (i32, i32) = (3, 1);
    const TERMS: &'static [Term] =
        &[Term::new(1.0, 1.0, 5, 0), Term::new(-6.0, 2.0 / 3.0, 5, 0), Term::new(15.0, 1.0 / 3.0, 5, 0)];

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        let [outer, middle, inner] = edges(q);
        outer.pow::<5>() - middle.pow::<5>() * T::ratio(64, 81) + inner.pow::<5>() * T::ratio(5, 81)
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        let [outer, middle, inner] = edges(q);
        (middle.pow::<4>() * T::ratio(32, 27) - outer.pow::<4>() - inner.pow::<4>() * T::ratio(5, 27))
            .times(5)
    }
}

/// The distances to the three joints in units that make them exact, cut at zero.
#[inline(always)]
fn edges<T: Arithmetic>(q: T) -> [T; 3] {
    [T::ONE - q, T::ONE - q * T::ratio(3, 2), T::ONE - q.times(3)].map(T::positive_part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::conformance;
    use core::f64::consts::PI;

    #[test]
    fn normalisation_matches_the_literature() {
        let sigma =
            [243.0 / 40.0, 15309.0 / (478.0 * PI), 2187.0 / (40.0 * PI), 826686.0 / (2771.0 * PI * PI)];
        conformance::check_normalisation::<QuinticSpline>(&sigma);
    }
}
