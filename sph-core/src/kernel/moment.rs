//! Radial moments in closed form, and the constants that follow from them (Def. 2.2 and its erratum).
//!
//! ```text
//! ∫₀ᵃ (a − q)^k q^j q^{n−1} dq = a^{k+j+n} B(k + 1, j + n) = a^{k+j+n} / (j + n) · Π_{i=1..k} i / (j + n + i)
//! ```

use super::Kernel;
use crate::{ball, quadrature};

/// One term of a profile: `coefficient` (`edge` − q)₊^`power` q^`degree`.
///
/// `degree` may be −1: the moments then start at n = 2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Term {
    /// c
    pub coefficient: f64,
    /// a, in (0, 1]
    pub edge: f64,
    /// k
    pub power: u32,
    /// j
    pub degree: i32,
}

impl Term {
    /// c (a − q)₊^k q^j
    pub const fn new(coefficient: f64, edge: f64, power: u32, degree: i32) -> Self {
        Self { coefficient, edge, power, degree }
    }

    /// ∫₀¹ term · q^{n−1} dq; infinite where it diverges.
    pub const fn moment(&self, n: u32) -> f64 {
        let lowest = self.degree as i64 + n as i64;
        if lowest <= 0 {
            return f64::INFINITY;
        }
        let power = self.power as i64;
        // B(k + 1, j + n) is symmetric: of two long products the shorter one, whose factors are 1/2 at most
        let (last, other) = if power > FEW && power > lowest { (lowest, power) } else { (power, lowest) };
        let mut moment = self.coefficient / lowest as f64;
        let mut i = 1;
        while i <= last && moment != 0.0 {
            moment *= i as f64 / (other + i) as f64;
            i += 1;
        }
        times_power(moment, self.edge, power + lowest)
    }
}

/// So many multiplications one after the other take no time; with more, other orders are shorter.
const FEW: i64 = 64;

/// x a^n, multiplied one by one where n is small.
const fn times_power(mut x: f64, a: f64, n: i64) -> f64 {
    let (mut factor, mut left) = (a, n);
    while left > 0 {
        if left <= FEW || left % 2 == 1 {
            x *= factor;
            left -= 1;
        } else {
            factor *= factor;
            left /= 2;
        }
    }
    x
}

const fn sum_of_moments(terms: &[Term], n: u32) -> f64 {
    let mut sum = 0.0;
    let mut i = 0;
    while i < terms.len() {
        sum += terms[i].moment(n);
        i += 1;
    }
    sum
}

/// What is known of a kernel in `D` dimensions when the program is compiled.
pub(crate) struct Constants<K, const D: usize>(core::marker::PhantomData<K>);

impl<K: Kernel, const D: usize> Constants<K, D> {
    const TERMS: &'static [Term] = if D == 1 { K::TERMS_IN_1D } else { K::TERMS };

    /// σ_D where the kernel lists its terms.
    const CLOSED_FORM: Option<f64> = if Self::TERMS.is_empty() {
        None
    } else {
        Some(1.0 / (ball::unit_surface(D as u32) * sum_of_moments(Self::TERMS, D as u32)))
    };

    /// σ_D = 1 / (S_D M_D)
    #[inline(always)]
    pub(crate) fn normalisation() -> f64 {
        match Self::CLOSED_FORM {
            Some(constant) => constant,
            None => normalisation::<K>(D as u32),
        }
    }
}

/// M_n = ∫₀¹ f(q) q^{n−1} dq of the form that the kernel has in `dim` dimensions.
///
/// ```
/// use sph_core::kernel::{Spiky, radial_moment};
/// assert_eq!(radial_moment::<Spiky>(3, 1), 0.25); // ∫ (1 − q)³ dq
/// ```
pub fn radial_moment<K: Kernel>(dim: u32, n: u32) -> f64 {
    let terms = if dim == 1 { K::TERMS_IN_1D } else { K::TERMS };
    if terms.is_empty() { moment_by_quadrature::<K>(dim, n) } else { sum_of_moments(terms, n) }
}

/// M_n by Gauss–Legendre quadrature, whatever terms the kernel lists.
pub(crate) fn moment_by_quadrature<K: Kernel>(dim: u32, n: u32) -> f64 {
    let profile = |q| if dim == 1 { K::profile_in_1d::<f64>(q) } else { K::profile(q) };
    let power = i64::from(n.saturating_sub(1));
    let integrand = |q: f64| times_power(profile(q), q, power);
    quadrature::integrate(integrand, 0.0, 1.0)
}

/// σ_D = 1 / (S_D M_D), such that W = σ_D h^{-D} f(q) has ∫ W d^Dx = 1.
///
/// ```
/// use sph_core::kernel::{CubicSpline, normalisation};
/// assert!((normalisation::<CubicSpline>(3) - 8.0 / core::f64::consts::PI).abs() < 1e-14);
/// ```
pub fn normalisation<K: Kernel>(dim: u32) -> f64 {
    1.0 / (ball::unit_surface(dim) * radial_moment::<K>(dim, dim))
}

/// ∫ |x|² W d^Dx for support radius 1: M_{D+2} / M_D; 1, its limit, in so many dimensions that both are below the range of f64.
pub fn second_moment<K: Kernel>(dim: u32) -> f64 {
    let whole = radial_moment::<K>(dim, dim);
    if whole == 0.0 { 1.0 } else { radial_moment::<K>(dim, dim.saturating_add(2)) / whole }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{CubicSpline, Poly6, QuinticSpline, Viscosity};

    fn assert_moment(edge: f64, power: u32, n: u32, exact: f64) {
        let found = Term::new(1.0, edge, power, 0).moment(n);
        assert!(
            (found / exact - 1.0).abs() < 1e-13,
            "edge {edge}, power {power}, n {n}: {found:e}, {exact:e}"
        );
    }

    /// ∫ (a − q)^k q^{n−1} dq = a^{k+n} B(k + 1, n), and B(k + 1, 1) = 1/(k + 1), B(k + 1, 2) = 1/((k + 1)(k + 2)).
    #[test]
    fn high_powers_and_many_dimensions_have_their_moments() {
        for k in [3, 64, 65, 200, 5000, u32::MAX] {
            let power = f64::from(k);
            assert_moment(1.0, k, 1, 1.0 / (power + 1.0));
            assert_moment(1.0, k, 2, 1.0 / ((power + 1.0) * (power + 2.0)));
            assert_moment(1.0, 1, k, 1.0 / (power * (power + 1.0)));
        }
        for k in [63, 64, 65, 100, 700] {
            assert_moment(0.5, k, 1, libm::pow(0.5, f64::from(k + 1)) / f64::from(k + 1));
        }
        assert_eq!(Term::new(1.0, 1.0, u32::MAX, 0).moment(u32::MAX), 0.0);
        assert_eq!(Term::new(1.0, 1.0, 0, -1).moment(1), f64::INFINITY);
        assert_eq!(
            Term::new(1.0, 1.0, 2, i32::MIN).moment(u32::MAX),
            2.0 / (2147483647.0 * 2147483648.0 * 2147483649.0)
        );
    }

    #[test]
    fn second_moments_grow_to_the_support_in_many_dimensions() {
        fn check<K: Kernel>() {
            let moments = [3, 10, 100, 1000, u32::MAX].map(second_moment::<K>);
            assert!(moments.is_sorted() && moments[0] > 0.0 && moments[4] <= 1.0, "{moments:?}");
        }
        check::<Poly6>();
        check::<CubicSpline>();
        check::<QuinticSpline>();
        check::<Viscosity>();
    }
}
