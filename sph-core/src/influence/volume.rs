//! Both volumes V of Def. 2.2 and the half-line norm of Def. 1.2, for a kernel's raw form ω(h, r) = h^p f(r/h).
//!
//! ```text
//! shell    V(D, h) = ∫₀ʰ ∂B/∂r ω dr = S_D M_D h^{D+p}                ∫ ω/V d^Dx = 1: the default
//! printed  V(D, h) = ∫₀ʰ B(D, r) ω dr = B(D, 1) M_{D+1} h^{D+1+p}    as in the paper
//! half line          ∫₀ʰ ω dr = M₁ h^{1+p}                           Def. 1.2 asks for 1
//! ```
//!
//! In one dimension, and on the half line, ω is [`Kernel::raw_in_1d`]; in more it is [`Kernel::raw`].

use crate::ball;
use crate::kernel::{Kernel, radial_moment};

/// V(D, h) by shells, the volume that normalises: ∫ ω / V d^Dx = 1.
///
/// ```
/// use core::f64::consts::PI;
/// use sph_core::{influence::volume, kernel::Poly6};
/// let h: f64 = 1.5;
/// assert!((volume::shell::<Poly6>(2, h) / (PI * h.powi(8) / 4.0) - 1.0).abs() < 1e-14);
/// ```
pub fn shell<K: Kernel>(dim: u32, support_radius: f64) -> f64 {
    ball::unit_surface(dim)
        * radial_moment::<K>(dim, dim)
        * libm::pow(support_radius, f64::from(dim) + f64::from(K::RAW_POWER))
}

/// V(D, h) as the paper prints it, with B(D, r) for ∂B/∂r: one length too many, see the [erratum](super).
///
/// ```
/// use core::f64::consts::PI;
/// use sph_core::{influence::volume, kernel::Poly6};
/// let h: f64 = 1.5;
/// assert!((volume::printed::<Poly6>(2, h) / (16.0 * PI * h.powi(9) / 315.0) - 1.0).abs() < 1e-14);
/// ```
pub fn printed<K: Kernel>(dim: u32, support_radius: f64) -> f64 {
    let power = f64::from(dim) + 1.0 + f64::from(K::RAW_POWER);
    ball::unit_volume(dim) * radial_moment::<K>(dim, dim.saturating_add(1)) * libm::pow(support_radius, power)
}

/// ∫₀ʰ ω(h, r) dr, which Def. 1.2 wants to be 1: divide ω by it for a kernel normalised on the half line.
///
/// ```
/// use sph_core::{influence::volume, kernel::{Kernel, WendlandC2}, quadrature};
/// let h = 1.5;
/// let norm = volume::half_line::<WendlandC2>(h);
/// let total = quadrature::integrate(|r| WendlandC2::raw_in_1d(h, r) / norm, 0.0, h);
/// assert!((total - 1.0).abs() < 1e-14);
/// ```
pub fn half_line<K: Kernel>(support_radius: f64) -> f64 {
    radial_moment::<K>(1, 1) * libm::pow(support_radius, (1 + K::RAW_POWER) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{CubicSpline, Poly6, Viscosity, WendlandC4};
    use core::f64::consts::PI;

    #[test]
    fn any_number_of_dimensions_has_an_answer() {
        for dim in [1000, u32::MAX - 1, u32::MAX] {
            assert_eq!([shell::<Poly6>(dim, 0.5), printed::<CubicSpline>(dim, 0.5)], [0.0; 2], "{dim}");
        }
    }

    #[test]
    fn poly6_matches_the_table_of_the_erratum() {
        for h in [1.0, 0.01, 3.0_f64] {
            let power = |n: i32| libm::pow(h, n as f64);
            let printed_table = [
                power(8) / 4.0,
                16.0 * PI * power(9) / 315.0,
                PI * power(10) / 30.0,
                8.0 * PI * PI * power(11) / 1155.0,
            ];
            let shell_table = [
                32.0 * power(7) / 35.0,
                PI * power(8) / 4.0,
                64.0 * PI * power(9) / 315.0,
                PI * PI * power(10) / 20.0,
            ];
            for dim in 1..=4 {
                let i = dim as usize - 1;
                assert!(
                    (printed::<Poly6>(dim, h) / printed_table[i] - 1.0).abs() < 1e-13,
                    "printed, D = {dim}"
                );
                assert!((shell::<Poly6>(dim, h) / shell_table[i] - 1.0).abs() < 1e-13, "shell, D = {dim}");
            }
        }
    }

    #[test]
    fn both_volumes_are_the_integrals_that_define_them() {
        fn compare<K: Kernel>(dim: u32, h: f64) {
            let raw = |r: f64| if dim == 1 { K::profile_in_1d(r / h) } else { K::profile(r / h) };
            let unit = libm::pow(h, K::RAW_POWER as f64);
            let by_ball =
                crate::quadrature::integrate(|r| ball::volume_real(dim as f64, r) * unit * raw(r), 0.0, h);
            let surface = |r: f64| dim as f64 * ball::volume_real(dim as f64, r) / r;
            let by_shell = crate::quadrature::integrate(|r| surface(r) * unit * raw(r), 0.0, h);
            assert!((printed::<K>(dim, h) / by_ball - 1.0).abs() < 1e-13);
            assert!((shell::<K>(dim, h) / by_shell - 1.0).abs() < 1e-13);
        }
        for dim in 1..=4 {
            compare::<Poly6>(dim, 0.7);
            compare::<CubicSpline>(dim, 0.7);
            compare::<WendlandC4>(dim, 2.5);
        }
    }

    #[test]
    fn viscosity_has_no_volume_in_one_dimension() {
        assert!(shell::<Viscosity>(1, 1.0).is_infinite());
    }
}
