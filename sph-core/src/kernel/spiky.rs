//! The spiky kernel, whose gradient does not vanish toward r = 0: for pressure forces.
//!
//! ```text
//! f(q)  = (1 − q)₊³
//! f′(q) = −3 (1 − q)₊²
//! ```
//!
//! Source: M. Müller, D. Charypar, M. Gross, *Particle-based fluid simulation for interactive applications*, SCA 2003, eq. (21).

use super::{Kernel, Term};
use crate::Arithmetic;

/// (1 − q)³; formula and source in the [module](self).
///
/// ```
/// use sph_core::kernel::{Kernel, Spiky};
/// assert_eq!(Spiky::profile(0.5_f32), 0.125);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Spiky;

impl Kernel for Spiky {
    const TERMS: &'static [Term] = &[Term::new(1.0, 1.0, 3, 0)];

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        (T::ONE - q).positive_part().pow::<3>()
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        (T::ONE - q).positive_part().pow::<2>().times(-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::conformance;
    use core::f64::consts::PI;

    #[test]
    fn normalisation_matches_the_literature() {
        let sigma = [2.0, 10.0 / PI, 15.0 / PI, 70.0 / (PI * PI)];
        conformance::check_normalisation::<Spiky>(&sigma);
    }
}
