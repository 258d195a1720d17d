//! Wendland's function of smoothness C6, in two and more dimensions and in one.
//!
//! ```text
//! D ≥ 2:  f(q) = (1 − q)₊⁸ (1 + 8q + 25q² + 32q³)      f′(q) = −22 q (1 + 7q + 16q²) (1 − q)₊⁷
//! D = 1:  f(q) = (1 − q)₊⁷ (1 + 7q + 19q² + 21q³)      f′(q) = −6 q (3 + 18q + 35q²) (1 − q)₊⁶
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

/// Wendland C6; formula and source in the [module](self).
///
/// ```
/// use sph_core::kernel::{Kernel, WendlandC6};
/// assert_eq!(WendlandC6::profile(0.0_f32), 1.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WendlandC6;

/// x f′(q) / q, multiplied in an order that stays below 8 for |x| ≤ q.
#[inline(always)]
fn slope_times<T: Arithmetic>(x: T, q: T) -> T {
    let p = (T::ONE - q).positive_part();
    let t = (q * p).times(4);
    let g = p.pow::<5>() * (p * p + t * (p * T::ratio(7, 4) + t));
    (x * g).times(-22)
}

/// x f′(q) / q of the one-dimensional form.
#[inline(always)]
fn slope_times_in_1d<T: Arithmetic>(x: T, q: T) -> T {
    let p = (T::ONE - q).positive_part();
    let t = (q * p).times(4);
    let g = p.pow::<4>() * ((p * p).times(3) + t * (p * T::ratio(9, 2) + t * T::ratio(35, 16)));
    (x * g).times(-6)
}

impl Kernel for WendlandC6 {
    const SUPPORT_RATIO: (i32, i32) = (2, 1);
    const TERMS: &'static [Term] = &[
        Term::new(1.0, 1.0, 8, 0),
        Term::new(8.0, 1.0, 8, 1),
        Term::new(25.0, 1.0, 8, 2),
        Term::new(32.0, 1.0, 8, 3),
    ];
    const TERMS_IN_1D: &'static [Term] = &[
        Term::new(1.0, 1.0, 7, 0),
        Term::new(7.0, 1.0, 7, 1),
        Term::new(19.0, 1.0, 7, 2),
        Term::new(21.0, 1.0, 7, 3),
    ];

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        let p = (T::ONE - q).positive_part();
        let t = (q * p).times(4);
        let cubic = p.pow::<3>() + t * ((p * p).times(2) + t * (p * T::ratio(25, 16) + t * T::ratio(1, 2)));
        p.pow::<5>() * cubic
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        slope_times(q, q)
    }

    #[inline(always)]
    fn profile_in_1d<T: Arithmetic>(q: T) -> T {
        let p = (T::ONE - q).positive_part();
        let t = (q * p).times(4);
        let cubic =
            p.pow::<3>() + t * (p * p * T::ratio(7, 4) + t * (p * T::ratio(19, 16) + t * T::ratio(21, 64)));
        p.pow::<4>() * cubic
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
        let sigma = [55.0 / 32.0, 78.0 / (7.0 * PI), 1365.0 / (64.0 * PI), 130.0 / (PI * PI)];
        conformance::check_normalisation::<WendlandC6>(&sigma);
    }
}
