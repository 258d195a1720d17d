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
        let lowest = self.degree + n as i32;
        if lowest <= 0 {
            return f64::INFINITY;
        }
        let mut moment = self.coefficient / lowest as f64;
        let mut i = 1;
        while i <= self.power as i32 {
            moment *= i as f64 / (lowest + i) as f64;
            i += 1;
        }
        let mut edges = self.power as i32 + lowest;
        while edges > 0 {
            moment *= self.edge;
            edges -= 1;
        }
        moment
    }
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
    let integrand = |q: f64| (1..n).fold(profile(q), |product, _| product * q);
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

/// ∫ |x|² W d^Dx for support radius 1: M_{D+2} / M_D.
pub fn second_moment<K: Kernel>(dim: u32) -> f64 {
    radial_moment::<K>(dim, dim + 2) / radial_moment::<K>(dim, dim)
}
