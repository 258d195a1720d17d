//! The part of a plane wall in the density and in the push of a particle at distance d from it, in units of h.
//!
//! ```text
//! χ(d) = ∫_{x > d} W d^Dx                     W of poly6
//! G(d) = n ∫_{x > d} (1 − |x|²)³ x d^Dx       n = 2^D particles in h^D: what fluid behind the wall would push with
//! ```
//!
//! G = g (1 − d²)^{(D + 7)/2} with g₂ = 256/630 and g₃ = π/5. In two dimensions the power is 9/2, taken as the mean of the
//! powers 4 and 5. χ is a polynomial of 1 − d that is within 0.0015 of the integral.

use crate::Arithmetic;

/// χ(d) for d ≥ 0 in two or three dimensions; 0 from d = 1 on.
#[inline(always)]
pub fn share<N: Arithmetic, const D: usize>(d: N) -> N {
    let t = (N::ONE - d).positive_part();
    let ratio = |n| N::ratio(n, 10_000);
    let bracket = if D == 2 {
        ratio(21) + t * (ratio(13_826) - t * ratio(8_847))
    } else {
        ratio(-2_269) + t * (ratio(17_604) - t * ratio(10_335))
    };
    t.pow::<3>() * bracket
}

/// G(d) for |d| in two or three dimensions; 0 from |d| = 1 on.
#[inline(always)]
pub fn push<N: Arithmetic, const D: usize>(d: N) -> N {
    let e = (N::ONE - d * d).positive_part();
    let e4 = e.pow::<4>();
    if D == 2 { N::ratio(128, 630) * (e4 + e4 * e) } else { N::ratio(6_283, 10_000) * (e4 * e) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Kernel, Poly6, normalisation};
    use crate::quadrature::integrate;

    /// ∫_{x > d} f(|x|) x^power over the half-space, in cylindrical coordinates.
    fn integral<const D: usize>(d: f64, power: u32) -> f64 {
        integrate(
            |x: f64| {
                let radius = libm::sqrt(1.0 - x * x);
                let ring = |y: f64| if D == 2 { 2.0 } else { 2.0 * core::f64::consts::PI * y };
                let disc = integrate(|y| ring(y) * Poly6::profile(libm::sqrt(x * x + y * y)), 0.0, radius);
                disc * libm::pow(x, power.into())
            },
            d,
            1.0,
        )
    }

    fn check<const D: usize>() {
        let particles = libm::pow(2.0, D as f64);
        for step in 0..20 {
            let d = f64::from(step) / 20.0;
            let exact = integral::<D>(d, 0) * normalisation::<Poly6>(D as u32);
            assert!((share::<f64, D>(d) - exact).abs() < 0.002, "share at {d}: {exact}");
            let exact = integral::<D>(d, 1) * particles;
            assert!((push::<f64, D>(d) - exact).abs() < 0.004, "push at {d}: {exact}");
        }
        assert_eq!((share::<f64, D>(1.5), push::<f64, D>(1.5)), (0.0, 0.0));
        assert!((share::<f64, D>(0.0) - 0.5).abs() < 2e-3);
    }

    #[test]
    fn are_the_integrals_over_the_half_space() {
        check::<2>();
        check::<3>();
    }
}
