//! Cubic B-spline M₄, the customary first kernel of SPH.
//!
//! ```text
//! f(q)  = 2 (1 − q)₊³ −   (1 − 2q)₊³
//! f′(q) = 6 (1 − 2q)₊² − 6 (1 − q)₊²
//! ```
//!
//! Source: J. J. Monaghan, *Smoothed particle hydrodynamics*, Annu. Rev. Astron. Astrophys. 30 (1992) 543, there with smoothing
//! length h / 2.

use super::{Kernel, Term};
use crate::Arithmetic;

/// M₄; formula and source in the [module](self).
///
/// ```
/// use sph_core::kernel::{Kernel, CubicSpline};
/// assert_eq!(CubicSpline::profile(0.5_f32), 0.25);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CubicSpline;

impl Kernel for CubicSpline {
    const SUPPORT_RATIO: (i32, i32) = (2, 1);
    const TERMS: &'static [Term] = &[Term::new(2.0, 1.0, 3, 0), Term::new(-8.0, 0.5, 3, 0)];

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        let outer = (T::ONE - q).positive_part();
        let inner = (T::ONE - q.times(2)).positive_part();
        outer.pow::<3>().times(2) - inner.pow::<3>()
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        let outer = (T::ONE - q).positive_part();
        let inner = (T::ONE - q.times(2)).positive_part();
        (inner.pow::<2>() - outer.pow::<2>()).times(6)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::conformance;
    use core::f64::consts::PI;

    #[test]
    fn normalisation_matches_the_literature() {
        let sigma = [4.0 / 3.0, 40.0 / (7.0 * PI), 8.0 / PI, 1120.0 / (31.0 * PI * PI)];
        conformance::check_normalisation::<CubicSpline>(&sigma);
    }
}
