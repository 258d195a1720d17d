//! Every scalar: roots, conversions, overflow, and a kernel in each.

#![no_std]
#![no_main]

use fluisim_firmware as _;
use sph_core::kernel::WendlandC2;
use sph_core::scalar::fast::Fast32;
use sph_core::scalar::fixed::{Checked, I4F12, I8F24, I16F16, I32F32, Saturating, Wrapping};
use sph_core::{Arithmetic, Influence, KernelInfluence, Scalar};

/// √2 and W(h/2) for h = 1 to the given errors, and what every scalar has in common.
fn is_right<T: Scalar>(root_error: f64, kernel_error: f64) -> bool {
    let root = (T::ratio(2, 1).sqrt().to_f64() - core::f64::consts::SQRT_2).abs();
    let w = KernelInfluence::<T, 2, WendlandC2>::new(T::ONE).unwrap();
    let half = w.influence(T::ratio(1, 4)).to_f64();
    let kernel = (half - 0.1875 * 7.0 / core::f64::consts::PI).abs();
    let floor = T::ratio(-3, 2).floor_to_i32() == -2 && T::ratio(7, 4).floor_to_i32() == 1;
    let common = floor && (-T::ONE).positive_part() == T::ZERO && T::ratio(3, 2).pow::<2>() == T::ratio(9, 4);
    root <= root_error && kernel <= kernel_error && common
}

#[defmt_test::tests]
mod tests {
    use super::*;
    use defmt::{assert, assert_eq};

    #[test]
    fn floats_are_right() {
        assert!(is_right::<f32>(1e-7, 1e-6));
        assert!(is_right::<f64>(1e-15, 1e-15));
    }

    #[test]
    fn fast_floats_are_as_right_as_they_say() {
        assert!(is_right::<Fast32>(0.0607 * core::f64::consts::SQRT_2, 0.1));
    }

    #[test]
    fn fixed_point_is_right_to_a_few_units() {
        assert!(is_right::<Saturating<I16F16>>(1e-5, 2e-4));
        assert!(is_right::<Checked<I8F24>>(1e-7, 1e-6));
        assert!(is_right::<Wrapping<I4F12>>(3e-4, 3e-3));
        assert!(is_right::<Saturating<I32F32>>(1e-9, 1e-8));
    }

    /// 2.5 · 1.5 − 1/4 is in the range of every format, and exact.
    #[test]
    fn every_format_calculates() {
        macro_rules! calculate {
            ([$($Format:ident $name:tt $about:tt;)+]) => {$(
                type $Format = Saturating<sph_core::scalar::fixed::$Format>;
                let product = $Format::ratio(5, 2) * $Format::ratio(3, 2) - $Format::ratio(1, 4);
                assert_eq!(product.to_f64(), 3.5, $name);
            )+};
        }
        sph_core::for_each_format!(calculate);
    }

    #[test]
    fn overflow_is_what_the_type_says() {
        let held = Saturating::<I16F16>::from_f64(200.0);
        assert_eq!((held * held).to_bits(), i32::MAX);
        let checked = Checked::<I16F16>::from_f64(200.0);
        assert!(!(checked * checked - checked).is_finite());
        let wrapped = Wrapping::<I16F16>::from_f64(200.0);
        assert_eq!((wrapped * wrapped).to_f64(), 40_000.0 - 65_536.0);
    }

    #[test]
    fn zeros_and_nans_have_one_pattern_each() {
        assert_eq!((-0.0_f32).canonical_bits(), 0);
        assert_eq!(f64::NAN.canonical_bits(), (-f64::NAN).canonical_bits());
    }

    #[cfg(feature = "broken")]
    #[test]
    fn this_test_is_broken() {
        assert_eq!(1.0_f32.sqrt(), 2.0);
    }
}
