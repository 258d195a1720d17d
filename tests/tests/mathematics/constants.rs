//! Balls, volumes and normalisations: Defs 1.1, 1.2, Ex. 1.3, Defs 2.1, 2.2 with the erratum.

use core::f64::consts::PI;

use crate::each_kernel;
use sph_core::influence::volume;
use sph_core::kernel::{Kernel, Poly6, Viscosity, normalisation, second_moment};
use sph_core::{ball, quadrature};

fn relative(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// Def. 2.1: B(N, r) = π^{N/2} / Γ(1 + N/2) r^N for N = 0 … 10, by recurrence and by gamma function.
#[test]
fn ball_volumes_n_0_to_10_both_paths() {
    let numerators = [1.0, 2.0, 1.0, 4.0, 1.0, 8.0, 1.0, 16.0, 1.0, 32.0, 1.0];
    let denominators = [1.0, 1.0, 1.0, 3.0, 2.0, 15.0, 6.0, 105.0, 24.0, 945.0, 120.0];
    for n in 0..=10_usize {
        let exact = numerators[n] / denominators[n] * PI.powi(n as i32 / 2);
        assert!(relative(ball::unit_volume(n as u32), exact) < 1e-15, "N = {n}");
        for r in [0.37_f64, 1.0, 2.9] {
            assert!(relative(ball::volume_real(n as f64, r), exact * r.powi(n as i32)) < 5e-15, "N = {n}");
        }
        assert!(relative(ball::unit_surface(n as u32).max(1e-300), (n as f64 * exact).max(1e-300)) < 1e-15);
    }
    assert!(relative(ball::volume::<f64, 4>(2.9), PI * PI / 2.0 * 2.9_f64.powi(4)) < 1e-15);
}

/// Ex. 1.3: ω(h, r) = (h² − r²)³ for r ≤ h; zero beyond; Def. 1.1.
#[test]
fn poly6_raw_is_h2_minus_r2_cubed() {
    for h in [0.37_f64, 1.0, 2.9] {
        for i in 0..=30 {
            let r = h * i as f64 / 20.0;
            let expected = if r < h { (h * h - r * r).powi(3) } else { 0.0 };
            assert!((Poly6::raw(h, r) - expected).abs() <= 1e-14 * h.powi(6), "h = {h}, r = {r}");
        }
    }
}

/// Def. 2.2 and its erratum for poly6: printed ∫ B ω dr, shell ∫ B′ ω dr, D = 1 … 4, from the closed forms.
#[test]
fn both_volumes_of_poly6_are_those_of_the_table() {
    for h in [0.37_f64, 1.0, 2.9] {
        let printed = [
            h.powi(8) / 4.0,
            16.0 * PI * h.powi(9) / 315.0,
            PI * h.powi(10) / 30.0,
            8.0 * PI * PI * h.powi(11) / 1155.0,
        ];
        let shell = [
            32.0 * h.powi(7) / 35.0,
            PI * h.powi(8) / 4.0,
            64.0 * PI * h.powi(9) / 315.0,
            PI * PI * h.powi(10) / 20.0,
        ];
        for dim in 1..=4 {
            let at = dim as usize - 1;
            assert!(relative(volume::printed::<Poly6>(dim, h), printed[at]) < 5e-15, "D = {dim}, h = {h}");
            assert!(relative(volume::shell::<Poly6>(dim, h), shell[at]) < 5e-15, "D = {dim}, h = {h}");
        }
    }
}

/// Erratum by parts: ∫ B′ ω dr = ∫ B (−∂ω/∂r) dr, which ties the slope to the volume.
#[test]
fn shell_volume_equals_ball_times_minus_slope() {
    fn check<K: Kernel>() {
        for dim in 1..=4_u32 {
            let slope = |q: f64| if dim == 1 { K::slope_in_1d(q) } else { K::slope(q) };
            let by_parts =
                quadrature::integrate(|q: f64| -ball::volume_real(dim as f64, q) * slope(q), 0.0, 1.0);
            let shell = volume::shell::<K>(dim, 1.0);
            assert!(relative(by_parts, shell) < 2e-14, "{}, D = {dim}", crate::name::<K>());
        }
    }
    each_kernel!(K => check::<K>());
}

/// Def. 1.2: ∫₀ʰ ω/norm dr = 1, of the raw kernel as it is in one dimension.
#[test]
fn half_line_norm_makes_the_integral_one() {
    fn check<K: Kernel>() {
        for h in [0.37, 1.0, 2.9] {
            let norm = volume::half_line::<K>(h);
            let total = quadrature::integrate(|r| K::raw_in_1d(h, r) / norm, 0.0, h);
            assert!((total - 1.0).abs() < 1e-14, "{}, h = {h}: {total}", crate::name::<K>());
            // the line has two halves
            assert!(relative(volume::shell::<K>(1, h), 2.0 * norm) < 1e-14);
        }
    }
    each_kernel!(K => check::<K>());
}

/// σ_D of the kernels' table, D = 1 … 4, relative error ≤ 1e-14, through Def. 2.3: σ_D = h^D ω(h, r) / V / f.
#[test]
fn shell_volume_of_the_raw_form_is_the_normalisation() {
    fn check<K: Kernel>() {
        for dim in 1..=4_u32 {
            for h in [0.37_f64, 2.9] {
                let unit = h.powi((dim + K::RAW_POWER) as i32);
                let sigma = unit / volume::shell::<K>(dim, h);
                assert!(
                    relative(sigma, normalisation::<K>(dim)) < 1e-14,
                    "{}, D = {dim}",
                    crate::name::<K>()
                );
            }
        }
    }
    each_kernel!(K => check::<K>());
}

/// The viscosity kernel: σ_D = 10/(3π), 15/(2π), 42/π² from ∫ f S_D q^{D−1} dq = 1/σ_D, and no norm in one dimension.
#[test]
fn viscosity_constants() {
    for (dim, sigma) in [(2, 10.0 / (3.0 * PI)), (3, 15.0 / (2.0 * PI)), (4, 42.0 / (PI * PI))] {
        assert!(relative(normalisation::<Viscosity>(dim), sigma) < 1e-14);
    }
    assert!(!volume::half_line::<Viscosity>(1.0).is_finite());
}

/// ∫ |x|² W d^Dx = M_{D+2} / M_D, by shells.
#[test]
fn second_moments_are_their_integrals() {
    fn check<K: Kernel>() {
        for dim in 1..=4_u32 {
            let profile = |q: f64| if dim == 1 { K::profile_in_1d(q) } else { K::profile(q) };
            let shell = |q: f64| ball::unit_surface(dim) * q.powi(dim as i32 + 1) * profile(q);
            let moment = normalisation::<K>(dim) * quadrature::integrate(shell, 0.0, 1.0);
            assert!(relative(second_moment::<K>(dim), moment) < 1e-13, "{}, D = {dim}", crate::name::<K>());
        }
    }
    each_kernel!(K => check::<K>());
}
