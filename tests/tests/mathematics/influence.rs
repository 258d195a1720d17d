//! Ω and ∇Ω: Def. 2.3, Thm 2.4 against Thm 4.1, and their moments.

use core::f64::consts::PI;

use crate::cloud::Random;
use crate::{assert_near, each_kernel, name};
use sph_core::kernel::{Kernel, Spiky, WendlandC2};
use sph_core::{ClosureInfluence, Influence, KernelInfluence, ball, difference, quadrature};

const RADII: [f64; 2] = [0.37, 2.9];

/// ∫ Ω d^Dx = ∫₀ʰ S_D r^{D−1} Ω dr = 1 at h ≠ 1, D = 1 … 4.
#[test]
fn omega_integrates_to_one_over_shells() {
    fn check<K: Kernel, const D: usize>() {
        for h in RADII {
            let w = KernelInfluence::<f64, D, K>::new(h).unwrap();
            let shell = |r: f64| ball::unit_surface(D as u32) * r.powi(D as i32 - 1) * w.influence(r * r);
            assert_near(quadrature::integrate(shell, 0.0, h), 1.0, 1e-13, name::<K>());
        }
    }
    each_kernel!(K => { check::<K, 1>(); check::<K, 2>(); check::<K, 3>(); check::<K, 4>(); });
}

/// The sums over a lattice of spacing h / `per_radius`, off the symmetric place: Σ Ω, Σ ∇Ω and Σ x_a ∂_b Ω, times Δx^D.
struct Moments<const D: usize> {
    zeroth: f64,
    slope: [f64; D],
    first: [[f64; D]; D],
}

fn lattice_moments<K: Kernel, const D: usize>(h: f64, per_radius: usize) -> Moments<D> {
    let w = KernelInfluence::<f64, D, K>::new(h).unwrap();
    let spacing = h / per_radius as f64;
    let cell = spacing.powi(D as i32);
    let side = 2 * per_radius + 2;
    let mut moments = Moments { zeroth: 0.0, slope: [0.0; D], first: [[0.0; D]; D] };
    for number in 0..side.pow(D as u32) {
        let x: [f64; D] = core::array::from_fn(|axis| {
            let cell = number / side.pow(axis as u32) % side;
            spacing * (cell as f64 - per_radius as f64 - 0.37 - 0.11 * axis as f64)
        });
        let slope = w.gradient_at(&x);
        moments.zeroth += cell * w.influence_at(&x);
        for b in 0..D {
            moments.slope[b] += cell * slope[b];
            for a in 0..D {
                moments.first[a][b] += cell * x[a] * slope[b];
            }
        }
    }
    moments
}

/// ∫ Ω = 1, ∫ ∇Ω = 0 and ∫ x_a ∂_b Ω = −δ_ab on a lattice; what is left is the lattice's error, largest for spiky's cusp.
fn check_lattice<K: Kernel, const D: usize>(per_radius: usize, tolerance: f64) {
    for h in RADII {
        let moments = lattice_moments::<K, D>(h, per_radius);
        let what = format!("{}, D = {D}, h = {h}", name::<K>());
        assert_near(moments.zeroth, 1.0, tolerance, &what);
        for b in 0..D {
            assert_near(moments.slope[b] * h, 0.0, tolerance * per_radius as f64, &what);
            for a in 0..D {
                assert_near(moments.first[a][b], if a == b { -1.0 } else { 0.0 }, 10.0 * tolerance, &what);
            }
        }
    }
}

#[test]
fn lattice_moments_in_1d() {
    each_kernel!(K => check_lattice::<K, 1>(1000, 2e-6));
}

#[test]
fn lattice_moments_in_2d() {
    each_kernel!(K => check_lattice::<K, 2>(100, 2e-6));
}

#[test]
fn lattice_moments_in_3d() {
    each_kernel!(K => check_lattice::<K, 3>(20, 5e-5));
}

#[test]
fn lattice_moments_in_4d() {
    each_kernel!(K => check_lattice::<K, 4>(8, 1e-3));
}

/// Thm 2.4 against Thm 4.1: ∇Ω equals central differences of Ω, over and beyond the support, to 1e-8 of Ω(0)/h.
#[test]
fn analytic_gradient_equals_central_differences() {
    fn check<K: Kernel, const D: usize>() {
        let mut random = Random(D as u64);
        for h in RADII {
            let w = KernelInfluence::<f64, D, K>::new(h).unwrap();
            let scale = w.influence(0.0) / h;
            for i in 10..=130 {
                let r = h * i as f64 / 100.0;
                let x = random.direction::<D>().map(|c| c * r);
                let numeric = difference::gradient(|x| w.influence_at(x), &x, h * 6e-6);
                let analytic = w.gradient_at(&x);
                let (value, slope) = w.value_and_gradient(&x, sph_core::vector::norm_squared(&x));
                assert_near(value, w.influence_at(&x), 1e-14 * scale * h, name::<K>());
                for axis in 0..D {
                    let what = format!("{}, D = {D}, q = {}", name::<K>(), r / h);
                    assert_near(analytic[axis], numeric[axis], 1e-8 * scale, &what);
                    assert_near(slope[axis], analytic[axis], 1e-14 * scale, &what);
                }
                if i > 100 {
                    assert_eq!(analytic, [0.0; D], "{} beyond its support", name::<K>());
                    assert_eq!(value, 0.0);
                }
            }
            assert_eq!(w.gradient_at(&[0.0; D]), [0.0; D], "{} at x = 0", name::<K>());
        }
    }
    each_kernel!(K => { check::<K, 1>(); check::<K, 2>(); check::<K, 3>(); check::<K, 4>(); });
}

/// x · ∇Ω < 0 inside: the derivative is by x, and Ω falls away from the sample.
#[test]
fn gradient_points_toward_the_sample() {
    fn check<K: Kernel>() {
        let w = KernelInfluence::<f32, 3, K>::new(0.37).unwrap();
        for i in 1..20 {
            let r = 0.37 * i as f32 / 20.0;
            assert!(w.gradient_at(&[0.0, r, 0.0])[1] < 0.0 && w.gradient_at(&[0.0, -r, 0.0])[1] > 0.0);
        }
    }
    each_kernel!(K => check::<K>());
}

/// ∇W_spiky = −45/(π h⁶) (h − r)² x̂ in three dimensions, −30/(π h⁵) (h − r)² x̂ in two.
#[test]
fn spiky_gradient_has_its_closed_form() {
    for h in RADII {
        let [w3, w2] =
            [KernelInfluence::<f64, 3, Spiky>::new(h).unwrap().gradient_at(&[0.2 * h, 0.0, -0.3 * h]), {
                let [x, y] =
                    KernelInfluence::<f64, 2, Spiky>::new(h).unwrap().gradient_at(&[0.2 * h, -0.3 * h]);
                [x, y, 0.0]
            }];
        let q = 0.13_f64.sqrt();
        let in_3d = -45.0 / (PI * h.powi(6)) * (h - q * h).powi(2);
        let in_2d = -30.0 / (PI * h.powi(5)) * (h - q * h).powi(2);
        for (found, factor) in [(w3[0], 0.2), (w3[2], -0.3)] {
            assert_near(found / (in_3d * factor / q), 1.0, 1e-14, "3-D");
        }
        for (found, factor) in [(w2[0], 0.2), (w2[1], -0.3)] {
            assert_near(found / (in_2d * factor / q), 1.0, 1e-14, "2-D");
        }
    }
}

/// Def. 1.1 alone: Ω made of the closure ω(h, r) is the kernel's Ω, in the form of one dimension and of more.
#[test]
fn a_closure_of_the_raw_form_is_the_kernel() {
    fn check<K: Kernel, const D: usize>() {
        let raw = |h: f64, r: f64| if D == 1 { K::raw_in_1d(h, r) } else { K::raw(h, r) };
        let closure = ClosureInfluence::<f64, D, _>::new(0.37, raw).unwrap();
        let w = KernelInfluence::<f64, D, K>::new(0.37).unwrap();
        let scale = w.influence(0.0);
        for i in 0..=50 {
            let mut x = [0.0; D];
            x[0] = -0.37 * i as f64 / 40.0;
            assert_near(closure.influence_at(&x), w.influence_at(&x), 1e-13 * scale, name::<K>());
            // a central difference rounds a cusp over its step
            if i != 0 {
                let (found, expected) = (closure.gradient_at(&x)[0], w.gradient_at(&x)[0]);
                assert_near(found, expected, 1e-8 * scale / 0.37, name::<K>());
            }
        }
    }
    each_kernel!(K => { check::<K, 1>(); check::<K, 2>(); check::<K, 3>(); });
}

/// The printed V of Def. 2.2 divides Ω and ∇Ω by one constant: ∫ Ω = V_shell / V_printed, which is 1 at no h of these.
#[test]
fn printed_volume_scales_omega_and_its_gradient_alike() {
    fn check<const D: usize>() {
        for h in RADII {
            let correct = KernelInfluence::<f64, D, WendlandC2>::new(h).unwrap();
            let printed = KernelInfluence::<f64, D, WendlandC2>::with_printed_volume(h).unwrap();
            let ratio = sph_core::influence::volume::shell::<WendlandC2>(D as u32, h)
                / sph_core::influence::volume::printed::<WendlandC2>(D as u32, h);
            assert!((ratio - 1.0).abs() > 0.1);
            let x = [0.3 * h; D];
            assert_near(printed.influence_at(&x) / correct.influence_at(&x), ratio, 1e-13 * ratio, "Ω");
            assert_near(printed.gradient_at(&x)[0] / correct.gradient_at(&x)[0], ratio, 1e-13 * ratio, "∇Ω");
        }
    }
    check::<1>();
    check::<2>();
    check::<3>();
}
