//! Kernels by tables in q²: how far they are from the kernels themselves, in every form and scalar.

use sph_core::kernel::{
    CubicSpline, Kernel, QuarticSpline, QuinticSpline, Tabulated, WendlandC2, WendlandC4, WendlandC6,
};
use sph_core::scalar::fixed::{I4F12, I8F24, I16F16, Saturating, Wrapping};
use sph_core::{BruteForce, Influence, KernelInfluence, Scalar, Sources, Uniform};

/// The largest errors of f, in units of f(0), and of f′, in units of its largest value.
fn errors<K: Kernel, T: Scalar, const D: usize, const N: usize>() -> (f64, f64) {
    const PLACES: i32 = 4000;
    let form =
        |q: f64| if D == 1 { (K::profile_in_1d(q), K::slope_in_1d(q)) } else { (K::profile(q), K::slope(q)) };
    let (mut of_profile, mut of_slope, mut steepest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for i in 0..=PLACES {
        let q = T::ratio(i, PLACES);
        let mut u = [T::ZERO; D];
        u[0] = q;
        let square = q * q;
        let (profile, slope) = form(q.to_f64());
        let (found, vector) = Tabulated::<K, N>::profile_and_slope_vector(&u, square);
        assert_eq!(found, Tabulated::<K, N>::profile_of_square::<T, D>(square));
        assert_eq!(vector, Tabulated::<K, N>::slope_vector(&u, square));
        assert!(found >= T::ZERO && vector[0] <= T::ZERO, "q = {q:?}");
        of_profile = of_profile.max((found.to_f64() - profile).abs() / form(0.0).0);
        of_slope = of_slope.max((vector[0].to_f64() - slope).abs());
        steepest = steepest.max(slope.abs());
    }
    (of_profile, of_slope / steepest)
}

/// The errors are as stated: no larger, and not smaller by half.
fn assert_errors<K: Kernel, T: Scalar, const D: usize, const N: usize>(of_profile: f64, of_slope: f64) {
    let found = errors::<K, T, D, N>();
    let stated = |found: f64, bound: f64| bound / 2.0 < found && found <= bound;
    let what = format!("{} in {D}D, {N} nodes, {}", crate::name::<K>(), T::NAME);
    assert!(stated(found.0, of_profile) && stated(found.1, of_slope), "{what}: {found:?}");
}

#[test]
fn errors_are_as_stated_for_every_kernel() {
    fn in_every_dimension<K: Kernel>(of_profile: f64, of_slope: f64) {
        assert_errors::<K, f64, 2, 65>(of_profile, of_slope);
        assert_errors::<K, f64, 3, 65>(of_profile, of_slope);
        assert_errors::<K, f32, 3, 65>(of_profile, of_slope);
        assert_errors::<K, Saturating<I16F16>, 2, 65>(of_profile * 1.1, of_slope * 1.1);
    }
    in_every_dimension::<CubicSpline>(5.2e-4, 1.4e-3);
    in_every_dimension::<QuarticSpline>(8.6e-4, 1.4e-3);
    in_every_dimension::<QuinticSpline>(1.2e-3, 1.7e-3);
    in_every_dimension::<WendlandC2>(9.4e-4, 4.2e-3);
    in_every_dimension::<WendlandC4>(1.3e-3, 2.8e-3);
    in_every_dimension::<WendlandC6>(1.7e-3, 3.5e-3);
}

#[test]
fn errors_are_as_stated_for_every_length() {
    assert_errors::<WendlandC2, f64, 2, 17>(1.2e-2, 3.5e-2);
    assert_errors::<WendlandC2, f32, 2, 33>(3.5e-3, 1.1e-2);
    assert_errors::<WendlandC2, f64, 2, 129>(2.5e-4, 2.1e-3);
    assert_errors::<WendlandC2, f32, 2, 257>(6.4e-5, 1.1e-3);
    assert_errors::<WendlandC2, Saturating<I8F24>, 2, 257>(6.4e-5, 1.1e-3);
}

#[test]
fn the_form_of_one_dimension_has_a_table_of_its_own() {
    assert_errors::<WendlandC2, f64, 1, 65>(5.1e-4, 2.0e-3);
    assert_errors::<WendlandC4, f32, 1, 65>(8.5e-4, 1.6e-3);
    assert_errors::<WendlandC6, f64, 1, 65>(1.3e-3, 2.3e-3);
}

#[test]
fn sixteen_bits_add_their_rounding() {
    assert_errors::<WendlandC2, Saturating<I4F12>, 2, 65>(1.5e-3, 7.4e-3);
    assert_errors::<CubicSpline, Wrapping<I4F12>, 2, 65>(1.1e-3, 2.9e-3);
}

/// A chord lies above a convex function, so a density is a little too large: on a lattice of spacing 0.27 h by 0.1 %.
#[test]
fn a_density_is_a_thousandth_too_large() {
    let positions: Vec<[f64; 2]> =
        (0..100).map(|i| [0.27 * f64::from(i % 10), 0.27 * f64::from(i / 10)]).collect();
    let sources = Sources::new(BruteForce::open(&positions).unwrap(), Uniform(0.27 * 0.27)).unwrap();
    let exact = KernelInfluence::<f64, 2, WendlandC2>::new(1.0).unwrap();
    let table = KernelInfluence::<f64, 2, Tabulated<WendlandC2, 65>>::new(1.0).unwrap();
    let error = sources.density_at(&table, &positions[44]) / sources.density_at(&exact, &positions[44]) - 1.0;
    assert!((1e-4..2e-3).contains(&error), "{error:e}");
}

/// Beyond the support, and where squares overflow, there is nothing.
#[test]
fn ends_with_the_support() {
    let w = KernelInfluence::<f32, 2, Tabulated<CubicSpline, 33>>::new(0.5).unwrap();
    for x in [[0.5, 0.0], [0.0, -0.6], [1e30, 0.0], [1e37, -1e37]] {
        assert_eq!(w.influence_at(&x), 0.0);
        assert_eq!(w.gradient_at(&x).map(f32::abs), [0.0; 2]);
    }
    assert_eq!(w.gradient_at(&[0.0, 0.0]).map(f32::abs), [0.0; 2]);
    assert_eq!(w.influence_at(&[0.0, 0.0]), w.normalisation());
}
