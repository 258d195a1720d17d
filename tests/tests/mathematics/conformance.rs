//! The kernel laws (Def. 1.1) for a kernel from outside the crate, and broken on purpose.

use sph_core::kernel::conformance::{Law, check};
use sph_core::kernel::{CubicSpline, Kernel, Term, WendlandC2};
use sph_core::{Arithmetic, KernelInfluence, Scalar};

/// f = (1 − q)₊² (1 + 2q), f′ = −6q (1 − q)₊: a kernel of a user, with nothing but what is asked for.
#[derive(Clone, Copy, Debug)]
struct Outside;

impl Kernel for Outside {
    fn profile<T: Arithmetic>(q: T) -> T {
        let p2 = (T::ONE - q).positive_part().pow::<2>();
        p2 + (q * p2).times(2)
    }

    fn slope<T: Arithmetic>(q: T) -> T {
        (q * (T::ONE - q).positive_part()).times(-6)
    }
}

/// ∫ (1 − q)² (1 + 2q) q^{D−1} dq = 1/2, 3/20, 1/15: σ = 1, 10/(3π), 15/(4π).
#[test]
fn a_kernel_from_outside_obeys_and_is_normalised() {
    use core::f64::consts::PI;
    assert_eq!(check::<Outside, f64>(), Ok(()));
    assert_eq!(check::<Outside, f32>(), Ok(()));
    let sigma = KernelInfluence::<f64, 1, Outside>::new(1.0).unwrap().normalisation();
    assert!((sigma - 1.0).abs() < 1e-14);
    let sigma = KernelInfluence::<f64, 2, Outside>::new(1.0).unwrap().normalisation();
    assert!((sigma / (10.0 / (3.0 * PI)) - 1.0).abs() < 1e-14);
    let sigma = KernelInfluence::<f32, 3, Outside>::new(1.0).unwrap().normalisation();
    assert!((f64::from(sigma) / (15.0 / (4.0 * PI)) - 1.0).abs() < 1e-6);
}

/// Makes a kernel that errs in one thing, and holds that the law which says so is the one reported.
macro_rules! broken {
    ($name:ident, $law:ident, profile: $profile:expr, slope: $slope:expr $(, $item:item)*) => {
        #[test]
        fn $name() {
            #[derive(Clone, Copy, Debug)]
            struct Broken;
            impl Kernel for Broken {
                fn profile<T: Arithmetic>(q: T) -> T {
                    #[allow(clippy::redundant_closure_call)]
                    ($profile)(q)
                }
                fn slope<T: Arithmetic>(q: T) -> T {
                    #[allow(clippy::redundant_closure_call)]
                    ($slope)(q)
                }
                $($item)*
            }
            assert_eq!(check::<Broken, f64>().map_err(|violation| violation.law), Err(Law::$law));
            assert_eq!(check::<Broken, f32>().map_err(|violation| violation.law), Err(Law::$law));
        }
    };
}

/// (1 − q)₊
fn p<T: Arithmetic>(q: T) -> T {
    (T::ONE - q).positive_part()
}

broken!(half_the_slope_breaks_the_slope_law, Slope,
    profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<2>() * T::ratio(-3, 2));

broken!(a_slope_one_percent_off_breaks_the_slope_law, Slope,
    profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<2>() * T::ratio(-303, 100));

// the defect of a peer: spiky's slope with the power of poly6's
broken!(the_wrong_power_of_spiky_breaks_the_slope_law, Slope,
    profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<3>().times(-3));

broken!(a_slope_of_the_wrong_sign_breaks_a_law, NonIncreasing,
    profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<2>().times(3));

// p³ − p²/50 is below zero for p < 1/50
broken!(a_negative_lobe_is_negative, NonNegative,
    profile: |q: T| p(q).pow::<3>() - p(q).pow::<2>() * T::ratio(1, 50),
    slope: |q: T| p(q) * T::ratio(1, 25) - p(q).pow::<2>().times(3));

// 1 − q + q²/4 is zero at q = 2 only
broken!(a_tail_beyond_the_support_is_caught, CompactSupport,
    profile: |q: T| T::ONE - q + q * q * T::ratio(1, 4), slope: |q: T| q * T::ratio(1, 2) - T::ONE);

// a gradient that does not vanish beyond the support
broken!(a_slope_that_does_not_end_is_caught, CompactSupport,
    profile: |q: T| p(q), slope: |_: T| -T::ONE);

// 1 − q without its positive part: negative beyond the support
broken!(an_uncut_profile_is_caught, CompactSupport,
    profile: |q: T| (T::ONE - q).pow::<2>(), slope: |q: T| (q - T::ONE).times(2));

/// 1 for x > 0 and 0 for x = 0, all but exactly.
fn is_positive<T: Arithmetic>(x: T) -> T {
    x / (x + T::ratio(1, 1 << 24) * T::ratio(1, 1 << 24))
}

// a jump by 3 %, between two of the places that are looked at
broken!(a_jump_is_not_continuous, Continuous,
    profile: |q: T| p(q).pow::<3>() + is_positive((T::ratio(301, 1001) - q).positive_part()) * T::ratio(3, 100),
    slope: |q: T| p(q).pow::<2>().times(-3));

// 1 / (1 + 9 q²) cut off at q = 1, where it is still 1/10
broken!(a_kernel_cut_off_at_its_support_is_not_continuous, Continuous,
    profile: |q: T| is_positive(p(q)) / (T::ONE + (q * q).times(9)),
    slope: |q: T| is_positive(p(q)) * q.times(-18) / (T::ONE + (q * q).times(9)).pow::<2>());

broken!(terms_of_another_profile_break_the_moments, Moments,
    profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<2>().times(-3),
    const TERMS: &'static [Term] = &[Term::new(1.0, 1.0, 4, 0)];);

broken!(a_term_off_by_a_millionth_breaks_the_moments, Moments,
    profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<2>().times(-3),
    const TERMS: &'static [Term] = &[Term::new(1.0, 0.999_999, 3, 0)];);

broken!(a_profile_of_the_square_that_forgets_the_root_disagrees, Agreement,
profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<2>().times(-3),
fn profile_of_square<T: Scalar, const D: usize>(s: T) -> T {
    p(s).pow::<3>()
});

broken!(a_slope_vector_that_is_not_along_x_disagrees, Agreement,
profile: |q: T| p(q).pow::<3>(), slope: |q: T| p(q).pow::<2>().times(-3),
fn slope_vector<T: Scalar, const D: usize>(u: &[T; D], s: T) -> [T; D] {
    u.map(|component| (component * p(s.sqrt()).pow::<2>()).times(-3))
});

/// The form of one dimension is checked as well: D = 1 is named.
#[test]
fn a_wrong_form_in_one_dimension_is_reported_for_that_dimension() {
    #[derive(Clone, Copy, Debug)]
    struct Broken;
    impl Kernel for Broken {
        fn profile<T: Arithmetic>(q: T) -> T {
            WendlandC2::profile(q)
        }
        fn slope<T: Arithmetic>(q: T) -> T {
            WendlandC2::slope(q)
        }
        fn profile_in_1d<T: Arithmetic>(q: T) -> T {
            CubicSpline::profile(q)
        }
    }
    let violation = check::<Broken, f64>().unwrap_err();
    assert_eq!((violation.law, violation.dim), (Law::Slope, 1));
}
