//! Poly6 of Müller, Charypar and Gross, the paper's first example (Ex. 1.3).
//!
//! ```text
//! f(q)  = (1 − q²)₊³              raw form ω(h, r) = (h² − r²)³
//! f′(q) = −6 q (1 − q²)₊²         f has no odd power and f′(q)/q no pole: no root, no division
//! ```
//!
//! Source: M. Müller, D. Charypar, M. Gross, *Particle-based fluid simulation for interactive applications*, SCA 2003, eq. (20).

use super::{Kernel, Term};
use crate::{Arithmetic, Scalar};

/// (1 − q²)³; formula and source in the [module](self).
///
/// ```
/// use sph_core::kernel::{Kernel, Poly6};
/// assert_eq!(Poly6::profile(0.5_f32), 0.421875);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Poly6;

impl Poly6 {
    /// f in terms of t = 1 − q², which a sum over pairs has at hand: t₊³.
    #[inline(always)]
    pub fn of_complement<T: Arithmetic>(t: T) -> T {
        t.positive_part().pow::<3>()
    }
}

impl Kernel for Poly6 {
    const TERMS: &'static [Term] = &[
        Term::new(1.0, 1.0, 3, 0),
        Term::new(3.0, 1.0, 3, 1),
        Term::new(3.0, 1.0, 3, 2),
        Term::new(1.0, 1.0, 3, 3),
    ];
    const RAW_POWER: u32 = 6;

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        Self::of_complement(T::ONE - q * q)
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        (q * (T::ONE - q * q).positive_part().pow::<2>()).times(-6)
    }

    #[inline(always)]
    fn profile_of_square<T: Scalar, const D: usize>(s: T) -> T {
        Self::of_complement(T::ONE - s)
    }

    #[inline(always)]
    fn slope_vector<T: Scalar, const D: usize>(u: &[T; D], s: T) -> [T; D] {
        let p2 = (T::ONE - s).positive_part().pow::<2>();
        u.map(|component| (component * p2).times(-6))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::conformance;
    use core::f64::consts::PI;

    #[test]
    fn normalisation_matches_the_literature() {
        let sigma = [35.0 / 32.0, 4.0 / PI, 315.0 / (64.0 * PI), 20.0 / (PI * PI)];
        conformance::check_normalisation::<Poly6>(&sigma);
    }
}
