//! The N-ball: its volume B(N, r) and the surface S_N of the unit sphere (Def. 2.1).
//!
//! ```text
//! B(N, r) = π^{N/2} / Γ(1 + N/2) · r^N          S_N = ∂B/∂r at r = 1 = N B(N, 1)
//! B(0, 1) = 1,  B(1, 1) = 2,  B(N, 1) = 2π/N · B(N − 2, 1)
//! ```
//!
//! Integer N goes by the recurrence, which is `const` and so costs a target nothing; real N by libm's gamma and power
//! functions. r in a length unit L gives L^N.

use crate::Scalar;
use core::f64::consts::PI;

/// B(N, 1), the volume of the unit ball in N dimensions; 0 from N = 453 on, where it is below the range of f64.
///
/// ```
/// const DISC: f64 = sph_core::ball::unit_volume(2);
/// assert_eq!(DISC, core::f64::consts::PI);
/// ```
pub const fn unit_volume(dimensions: u32) -> f64 {
    let mut volume = if dimensions.is_multiple_of(2) { 1.0 } else { 2.0 };
    let mut n = dimensions % 2;
    while n < dimensions && volume > 0.0 {
        n += 2;
        volume *= 2.0 * PI / n as f64;
    }
    volume
}

/// S_N = N B(N, 1), the surface of the unit sphere in N dimensions: 2, 2π, 4π, … and 0 for N = 0.
pub const fn unit_surface(dimensions: u32) -> f64 {
    dimensions as f64 * unit_volume(dimensions)
}

/// B(D, r) in any scalar.
///
/// ```
/// let disc = sph_core::ball::volume::<f32, 2>(2.0);
/// assert!((disc - 12.566371).abs() < 1e-6);
/// ```
pub fn volume<T: Scalar, const D: usize>(radius: T) -> T {
    T::from_f64(const { unit_volume(D as u32) }) * power::<T, D>(radius)
}

/// B(N, r) for real N ≥ 0, by the gamma function.
///
/// ```
/// let halfway = sph_core::ball::volume_real(2.5, 1.0);
/// assert!(sph_core::ball::unit_volume(2) < halfway && halfway < sph_core::ball::unit_volume(3));
/// ```
pub fn volume_real(dimensions: f64, radius: f64) -> f64 {
    libm::pow(PI, dimensions / 2.0) / libm::tgamma(1.0 + dimensions / 2.0) * libm::pow(radius, dimensions)
}

/// x^D by D − 1 multiplications from the left.
#[inline(always)]
#[track_caller]
pub(crate) fn power<T: Scalar, const D: usize>(x: T) -> T {
    let mut power = T::ONE;
    for _ in 0..D {
        power = power * x;
    }
    power
}

/// c x for a positive constant c that may be beyond the scalar's range where c x is not: 20 x in a type that ends at 8.
#[inline(always)]
#[track_caller]
pub(crate) fn constant_times<T: Scalar>(constant: f64, x: T) -> T {
    const PARTS: i32 = 64;
    if constant < T::MAX.to_f64() {
        x * T::from_f64(constant)
    } else {
        (x * T::from_f64(constant / PARTS as f64)).times(PARTS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// B(N, 1) for N = 0 … 10 as multiples of powers of π.
    const EXACT: [f64; 11] = [
        1.0,
        2.0,
        PI,
        4.0 / 3.0 * PI,
        PI * PI / 2.0,
        8.0 / 15.0 * PI * PI,
        PI * PI * PI / 6.0,
        16.0 / 105.0 * PI * PI * PI,
        PI * PI * PI * PI / 24.0,
        32.0 / 945.0 * PI * PI * PI * PI,
        PI * PI * PI * PI * PI / 120.0,
    ];

    #[test]
    fn both_paths_give_the_exact_volumes() {
        for (n, exact) in EXACT.into_iter().enumerate() {
            let relative = |value: f64| (value / exact - 1.0).abs();
            assert!(relative(unit_volume(n as u32)) < 1e-15, "N = {n}");
            assert!(relative(volume_real(n as f64, 1.0)) < 4e-15, "N = {n}");
            assert!(relative(volume_real(n as f64, 1.7) / libm::pow(1.7, n as f64)) < 4e-15, "N = {n}");
        }
    }

    #[test]
    fn the_volume_vanishes_in_many_dimensions() {
        assert!(unit_volume(452) > 0.0);
        assert_eq!([453, 454, 1000, u32::MAX - 1, u32::MAX].map(unit_volume), [0.0; 5]);
        assert_eq!(unit_surface(u32::MAX), 0.0);
    }

    #[test]
    fn the_surface_is_the_derivative_of_the_volume() {
        assert_eq!([1, 2, 3].map(unit_surface), [2.0, 2.0 * PI, 4.0 * PI]);
        for n in 1..=10 {
            let step = 1e-5;
            let slope =
                (volume_real(n as f64, 1.0 + step) - volume_real(n as f64, 1.0 - step)) / (2.0 * step);
            assert!((slope / unit_surface(n) - 1.0).abs() < 1e-8, "N = {n}");
        }
    }

    #[test]
    fn volume_scales_with_the_radius_in_every_dimension() {
        assert_eq!(volume::<f64, 0>(3.0), 1.0);
        assert_eq!(volume::<f64, 1>(3.0), 6.0);
        assert!((volume::<f64, 3>(3.0) / (36.0 * PI) - 1.0).abs() < 1e-15);
        assert!((volume::<f32, 4>(0.5) / (PI * PI / 32.0) as f32 - 1.0).abs() < 1e-6);
    }
}
