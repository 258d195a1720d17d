//! Quintic B-spline M₆.
//!
//! ```text
//! f(q)  =    (1 − q)₊⁵ −  6 (2/3 − q)₊⁵ + 15 (1/3 − q)₊⁵
//! f′(q) = −5 (1 − q)₊⁴ + 30 (2/3 − q)₊⁴ − 75 (1/3 − q)₊⁴
//! ```
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
pub struct QuinticSpline;

impl Kernel for QuinticSpline {
    const SUPPORT_RATIO: (i32, i32) = (3, 1);
    const TERMS: &'static [Term] =
        &[Term::new(1.0, 1.0, 5, 0), Term::new(-6.0, 2.0 / 3.0, 5, 0), Term::new(15.0, 1.0 / 3.0, 5, 0)];

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        let [outer, middle, inner] = edges(q);
        outer.pow::<5>() - middle.pow::<5>().times(6) + inner.pow::<5>().times(15)
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        let [outer, middle, inner] = edges(q);
        middle.pow::<4>().times(30) - outer.pow::<4>().times(5) - inner.pow::<4>().times(75)
    }
}

/// The distances to the three joints, cut at zero.
#[inline(always)]
fn edges<T: Arithmetic>(q: T) -> [T; 3] {
    [T::ONE, T::ratio(2, 3), T::ratio(1, 3)].map(|edge| (edge - q).positive_part())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::conformance;
    use core::f64::consts::PI;

    #[test]
    fn obeys_the_kernel_laws() {
        assert_eq!(conformance::check::<QuinticSpline, f64>(), Ok(()));
        assert_eq!(conformance::check::<QuinticSpline, f32>(), Ok(()));
    }

    #[test]
    fn normalisation_matches_the_literature() {
        let sigma =
            [243.0 / 40.0, 15309.0 / (478.0 * PI), 2187.0 / (40.0 * PI), 826686.0 / (2771.0 * PI * PI)];
        conformance::check_normalisation::<QuinticSpline>(&sigma);
    }
}
