//! Sums whose parts leave the range of a narrow type although their result lies in it, and results that lie outside.

#![cfg(feature = "fixed")]

use sph_core::kernel::{Kernel, Poly6, WendlandC2};
use sph_core::scalar::fixed::{Checked, I4F12, I4F28, I16F16, Saturating, Wrapping};
use sph_core::{
    BruteForce, ClosureInfluence, Influence, KernelInfluence, Scalar, Sources, Uniform, difference,
    quadrature,
};

/// A square lattice around the origin and its spacing, such that `neighbours` samples lie within 1 of a point.
fn lattice(neighbours: f64) -> (Vec<[f64; 2]>, f64) {
    let spacing = (std::f64::consts::PI / neighbours).sqrt();
    let place = |i: i32| (f64::from(i) + 0.3) * spacing;
    let side = (1.2 / spacing) as i32;
    ((-side..side).flat_map(|i| (-side..side).map(move |j| [place(i), place(j)])).collect(), spacing)
}

/// The density at the origin by `equal_density_at` in T, and by f64 for the same samples and mass.
fn equal_density<T: Scalar, K: Kernel>(neighbours: f64, mass: f64) -> (T, f64) {
    let (positions, spacing) = lattice(neighbours);
    let narrow: Vec<[T; 2]> = positions.iter().map(|x| x.map(T::from_f64)).collect();
    let exact: Vec<[f64; 2]> = narrow.iter().map(|x| x.map(T::to_f64)).collect();
    let mass = T::from_f64(mass * spacing * spacing);
    let sources = Sources::new(BruteForce::open(&narrow).unwrap(), Uniform(mass)).unwrap();
    let found = sources.equal_density_at(&KernelInfluence::<T, 2, K>::new(T::ONE).unwrap(), &[T::ZERO; 2]);
    let sources = Sources::new(BruteForce::open(&exact).unwrap(), Uniform(mass.to_f64())).unwrap();
    (found, sources.density_at(&KernelInfluence::<f64, 2, K>::new(1.0).unwrap(), &[0.0; 2]))
}

#[test]
fn equal_density_is_right_where_the_bare_sum_leaves_the_range() {
    fn check<T: Scalar>(tolerance: f64) {
        for neighbours in [13.0, 50.0, 70.0, 200.0] {
            for (found, expected) in
                [equal_density::<T, Poly6>(neighbours, 1.0), equal_density::<T, WendlandC2>(neighbours, 1.0)]
            {
                let (found, is_finite) = (found.to_f64(), found.is_finite());
                assert!(
                    is_finite && (found - expected).abs() <= tolerance,
                    "{} with {neighbours} neighbours: {found}, expected {expected}",
                    T::NAME
                );
            }
        }
    }
    check::<Saturating<I4F12>>(2e-3);
    check::<Checked<I4F12>>(2e-3);
    check::<Wrapping<I4F12>>(2e-3);
    check::<Saturating<I4F28>>(1e-6);
    check::<Checked<I4F28>>(1e-6);
    check::<Wrapping<I4F28>>(1e-6);
}

/// m σ = 4.6 · 2.2 leaves ±8; the density, of samples near the end of the support, does not.
#[test]
fn equal_density_is_right_where_the_constant_leaves_the_range() {
    fn density<T: Scalar>() -> f64 {
        let positions = [[T::ratio(3, 5), T::ZERO], [T::ZERO, T::ratio(7, 10)]];
        let sources = Sources::new(BruteForce::open(&positions).unwrap(), Uniform(T::ratio(23, 5))).unwrap();
        let w = KernelInfluence::<T, 2, WendlandC2>::new(T::ONE).unwrap();
        sources.equal_density_at(&w, &[T::ZERO; 2]).to_f64()
    }
    let expected = density::<f64>();
    for found in [density::<Saturating<I4F12>>(), density::<Checked<I4F12>>(), density::<Wrapping<I4F12>>()] {
        assert!((found - expected).abs() < 1e-2, "{found}, expected {expected}");
    }
    assert!((density::<Checked<I4F28>>() - expected).abs() < 1e-6);
}

/// Ten times the mass: ρ = 10 is no number of ±8.
#[test]
fn an_equal_density_out_of_range_is_told() {
    let (saturated, expected) = equal_density::<Saturating<I4F12>, WendlandC2>(70.0, 10.0);
    assert!(expected > 9.5 && !saturated.is_finite(), "{saturated}");
    assert!(!equal_density::<Checked<I4F12>, WendlandC2>(70.0, 10.0).0.is_finite());
    assert!(!equal_density::<Saturating<I4F28>, Poly6>(70.0, 10.0).0.is_finite());
    assert!(!equal_density::<Checked<I4F28>, Poly6>(70.0, 10.0).0.is_finite());
}

/// 6 · 2 leaves ±8 in the fourth difference of f = 2: the terms cannot be summed, and the result says so.
#[test]
fn a_difference_whose_terms_leave_the_range_is_told() {
    fn fourth<T: Scalar>() -> T {
        difference::nth(|_: T| T::ratio(2, 1), 4, T::ZERO, T::ratio(1, 2))
    }
    assert_eq!(fourth::<f64>(), 0.0);
    assert_eq!(fourth::<Saturating<I16F16>>().to_f64(), 0.0);
    assert!(!fourth::<Saturating<I4F12>>().is_finite());
    assert!(!fourth::<Checked<I4F12>>().is_finite());
}

/// Which kernels have gradients in ±8 for h = 1, and that the check is right: where it says so, the summed gradient is.
#[test]
fn gradients_that_leave_the_range_are_found_before_they_are_summed() {
    let mut refused = Vec::new();
    macro_rules! check {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {$({
            type K = sph_core::kernel::$Kernel;
            if let Ok(w) = KernelInfluence::<Saturating<I4F28>, 2, K>::new(Saturating::from_f64(1.0)) {
                let exact = KernelInfluence::<f64, 2, K>::new(1.0).unwrap();
                let error = |i: i32| {
                    let r = f64::from(i) / 200.0;
                    let found = w.gradient_at(&[Saturating::from_f64(r), Saturating::from_f64(0.0)])[0];
                    (found.to_f64() - exact.gradient_at(&[r, 0.0])[0]).abs()
                };
                let is_right = (0..200).all(|i| error(i) < 1e-5);
                assert_eq!(w.check_gradient().is_ok(), is_right, $name);
                if !is_right {
                    refused.push($name);
                }
            }
        })+};
    }
    sph_core::for_each_kernel!(check);
    assert!(refused.contains(&"wendland-c6") && !refused.contains(&"wendland-c2"), "{refused:?}");
    println!("{refused:?}");
}

/// ∫ 5 dx over [0, 1]: two values are added before they are weighted.
#[test]
fn an_integral_whose_parts_leave_the_range_is_told() {
    fn of_five<T: Scalar>() -> T {
        quadrature::integrate(|_: T| T::ratio(5, 1), T::ZERO, T::ONE)
    }
    assert!((of_five::<Saturating<I16F16>>().to_f64() - 5.0).abs() < 1e-2);
    assert!(!of_five::<Saturating<I4F28>>().is_finite());
    assert!(!of_five::<Checked<I4F28>>().is_finite());
    let refused = ClosureInfluence::<Saturating<I4F28>, 1, _>::new(Saturating::from_f64(1.0), |_, _| {
        Saturating::from_f64(5.0)
    });
    assert!(refused.is_err());
}
