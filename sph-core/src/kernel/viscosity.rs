//! The viscosity kernel of Müller, Charypar and Gross, and its Laplacian, which viscosity forces use.
//!
//! ```text
//! f(q)  = −q³/2 + q² + 1/(2q) − 1            diverges at q = 0; no norm in one dimension
//! f′(q) = −3q²/2 + 2q − 1/(2q²)
//! ∇²W   = c_D h^{-D-2} (1 − q)₊              c_D = 2D (D + 2)(D + 3) / S_D = 12, 40/π, 45/π, …
//! ```
//!
//! In three dimensions ∇²W above is the Laplacian of W itself. In others, where that has a pole, the form 1 − q is kept and
//! c_D set so that ∫ |x|² ∇²W d^Dx = 2D, what Green's identity gives for every normalised kernel; D = 3 agrees.
//!
//! Source: M. Müller, D. Charypar, M. Gross, *Particle-based fluid simulation for interactive applications*, SCA 2003, eq. (22).

use super::{Kernel, Term};
use crate::{Arithmetic, Error, Parameter, Scalar, ball};

/// The viscosity kernel; formula and source in the [module](self).
///
/// It diverges at r = 0, so no density can be made with it and [`KernelInfluence`](crate::KernelInfluence) refuses it:
/// see [`ViscosityLaplacian`].
///
/// ```
/// use sph_core::{Error, KernelInfluence, kernel::Viscosity};
/// assert_eq!(KernelInfluence::<f32, 3, Viscosity>::new(1.0).unwrap_err(), Error::SingularKernel);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Viscosity;

impl Kernel for Viscosity {
    const TERMS: &'static [Term] = &[
        Term::new(-0.5, 1.0, 0, 3),
        Term::new(1.0, 1.0, 0, 2),
        Term::new(0.5, 1.0, 0, -1),
        Term::new(-1.0, 1.0, 0, 0),
    ];
    const SINGULAR: bool = true;

    /// f(q) for 0 < q ≤ 1.
    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        let half = T::ratio(1, 2);
        half / q - half * q.pow::<3>() + q * q - T::ONE
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        let half = T::ratio(1, 2);
        q.times(2) - (q * q).times(3) * half - half / (q * q)
    }
}

/// The Laplacian ∇²W(r) = c_D h^{-D-2} (1 − r/h)₊ of the viscosity kernel, units L^{-D-2}.
///
/// ```
/// use sph_core::kernel::ViscosityLaplacian;
/// let laplacian = ViscosityLaplacian::<f64, 3>::new(2.0).unwrap();
/// let printed = 45.0 / core::f64::consts::PI / 64.0 * (2.0 - 0.5); // 45 / (π h⁶) (h − r)
/// assert!((laplacian.at_distance(0.5) / printed - 1.0).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ViscosityLaplacian<T, const D: usize> {
    inverse_radius: T,
    constant: T,
}

impl<T: Scalar, const D: usize> ViscosityLaplacian<T, D> {
    const UNIT_CONSTANT: f64 = (2 * D * (D + 2) * (D + 3)) as f64 / ball::unit_surface(D as u32);

    /// The Laplacian for support radius h.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::NotPositive`] for such an h; [`Error::NotRepresentable`] where c_D h^{-D-2} is out of
    /// the scalar's range.
    pub fn new(support_radius: T) -> Result<Self, Error> {
        crate::check::positive(support_radius, Parameter::SupportRadius, 0)?;
        let inverse_radius = T::ONE / support_radius;
        let power = ball::power::<T, D>(inverse_radius) * inverse_radius * inverse_radius;
        let constant = ball::constant_times(Self::UNIT_CONSTANT, power);
        crate::check::representable(constant, Parameter::Normalisation)?;
        Ok(Self { inverse_radius, constant })
    }

    /// ∇²W at distance r.
    #[inline(always)]
    pub fn at_distance(&self, r: T) -> T {
        self.constant * (T::ONE - r * self.inverse_radius).positive_part()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{normalisation, radial_moment};
    use core::f64::consts::PI;

    #[test]
    fn normalisation_matches_the_literature() {
        for (dim, sigma) in [(2, 10.0 / (3.0 * PI)), (3, 15.0 / (2.0 * PI)), (4, 42.0 / (PI * PI))] {
            assert!((normalisation::<Viscosity>(dim) / sigma - 1.0).abs() < 1e-14, "D = {dim}");
        }
        assert!(radial_moment::<Viscosity>(1, 1).is_infinite());
    }

    #[test]
    fn is_continuous_and_flat_at_the_support() {
        assert_eq!(Viscosity::profile(1.0_f64), 0.0);
        assert_eq!(Viscosity::slope(1.0_f64), 0.0);
        for q in [0.1, 0.4, 0.9_f64] {
            let step = 1e-6;
            let slope = (Viscosity::profile(q + step) - Viscosity::profile(q - step)) / (2.0 * step);
            assert!((slope - Viscosity::slope(q)).abs() < 1e-7 * slope.abs().max(1.0));
            assert!(Viscosity::profile(q) > 0.0 && Viscosity::slope(q) < 0.0);
        }
    }

    /// ∇²W = f″ + (D − 1) f′/q from central differences of the slope, in three dimensions.
    #[test]
    fn laplacian_is_that_of_the_kernel_in_3d() {
        let laplacian = ViscosityLaplacian::<f64, 3>::new(1.0).unwrap();
        let sigma = normalisation::<Viscosity>(3);
        for q in [0.2, 0.5, 0.8] {
            let step = 1e-5;
            let second = (Viscosity::slope(q + step) - Viscosity::slope(q - step)) / (2.0 * step);
            let expected = sigma * (second + 2.0 * Viscosity::slope(q) / q);
            assert!((laplacian.at_distance(q) / expected - 1.0).abs() < 1e-6);
        }
        assert_eq!(laplacian.at_distance(1.5), 0.0);
    }

    #[test]
    fn laplacian_obeys_greens_identity_in_every_dimension() {
        fn second_moment<const D: usize>() -> f64 {
            let laplacian = ViscosityLaplacian::<f64, D>::new(1.0).unwrap();
            let shell = |q: f64| {
                ball::unit_surface(D as u32) * libm::pow(q, D as f64 + 1.0) * laplacian.at_distance(q)
            };
            crate::quadrature::integrate(shell, 0.0, 1.0)
        }
        let moments =
            [second_moment::<1>(), second_moment::<2>(), second_moment::<3>(), second_moment::<4>()];
        for (moment, dim) in moments.into_iter().zip(1..) {
            assert!((moment / (2.0 * dim as f64) - 1.0).abs() < 1e-14, "D = {dim}");
        }
    }
}
