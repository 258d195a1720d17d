//! Wendland's function of smoothness C4, in two and more dimensions and in one.
//!
//! ```text
//! D ≥ 2:  f(q) = (1 − q)₊⁶ (1 + 6q + 35q²/3)      f′(q) = −56/3 q (1 + 5q) (1 − q)₊⁵
//! D = 1:  f(q) = (1 − q)₊⁵ (1 + 5q + 8q²)         f′(q) = −14 q (1 + 4q) (1 − q)₊⁴
//! ```
//!
//! Evaluated as a power of p = (1 − q)₊ times a polynomial of p and t = 4 q p ≤ 1, so that no rounding error is multiplied
//! by a large coefficient, and no factor leaves [0, 8).
//!
//! Positive definite, so particles do not pair; f′(q)/q has no pole, so the gradient needs no division.
//!
//! Sources: H. Wendland, *Piecewise polynomial, positive definite and compactly supported radial functions of minimal degree*,
//! Adv. Comput. Math. 4 (1995) 389; W. Dehnen, H. Aly, *Improving convergence in smoothed particle hydrodynamics simulations
//! without pairing instability*, MNRAS 425 (2012) 1068, table 1.

use super::{Kernel, Term, root};
use crate::{Arithmetic, Scalar};

/// Wendland C4; formula and source in the [module](self).
///
/// ```
/// use sph_core::kernel::{Kernel, WendlandC4};
/// assert_eq!(WendlandC4::profile(0.0_f32), 1.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WendlandC4;

/// x f′(q) / q, multiplied in an order that stays below 8 for |x| ≤ q.
#[inline(always)]
fn slope_times<T: Arithmetic>(x: T, q: T) -> T {
    let p = (T::ONE - q).positive_part();
    let g = p.pow::<4>() * (p + (q * p).times(5));
    (x * g).times(-28) * T::ratio(2, 3)
}

/// x f′(q) / q of the one-dimensional form.
#[inline(always)]
fn slope_times_in_1d<T: Arithmetic>(x: T, q: T) -> T {
    let p = (T::ONE - q).positive_part();
    let g = p.pow::<3>() * (p + (q * p).times(4));
    (x * g).times(-14)
}

impl Kernel for WendlandC4 {
    const SUPPORT_RATIO: (i32, i32) = (2, 1);
    const TERMS: &'static [Term] =
        &[Term::new(1.0, 1.0, 6, 0), Term::new(6.0, 1.0, 6, 1), Term::new(35.0 / 3.0, 1.0, 6, 2)];
    const TERMS_IN_1D: &'static [Term] =
        &[Term::new(1.0, 1.0, 5, 0), Term::new(5.0, 1.0, 5, 1), Term::new(8.0, 1.0, 5, 2)];

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        let p = (T::ONE - q).positive_part();
        let t = (q * p).times(4);
        p.pow::<4>() * (p * p + t * (p * T::ratio(3, 2) + t * T::ratio(35, 48)))
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        slope_times(q, q)
    }

    #[inline(always)]
    fn profile_in_1d<T: Arithmetic>(q: T) -> T {
        let p = (T::ONE - q).positive_part();
        let t = (q * p).times(4);
        p.pow::<3>() * (p * p + t * (p * T::ratio(5, 4) + t * T::ratio(1, 2)))
    }

    #[inline(always)]
    fn slope_in_1d<T: Arithmetic>(q: T) -> T {
        slope_times_in_1d(q, q)
    }

    #[inline(always)]
    fn slope_vector<T: Scalar, const D: usize>(u: &[T; D], s: T) -> [T; D] {
        let q = root(s);
        u.map(|component| if D == 1 { slope_times_in_1d(component, q) } else { slope_times(component, q) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::conformance;
    use core::f64::consts::PI;

    #[test]
    fn normalisation_matches_the_literature() {
        let sigma = [3.0 / 2.0, 9.0 / PI, 495.0 / (32.0 * PI), 594.0 / (7.0 * PI * PI)];
        conformance::check_normalisation::<WendlandC4>(&sigma);
    }
}
