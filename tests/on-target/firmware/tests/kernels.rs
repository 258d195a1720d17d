//! Ball, kernels, influence, quadrature and differences against closed forms.

#![no_std]
#![no_main]

use core::f32::consts::PI;
use fluisim_firmware as _;
use sph_core::influence::volume;
use sph_core::kernel::{
    self, CubicSpline, Kernel, Poly6, Spiky, Viscosity, ViscosityLaplacian, WendlandC2, conformance,
};
use sph_core::{
    ClosureInfluence, Error, Influence, InfluenceOf, KernelInfluence, Parameter, PerSampleInfluence, ball,
    difference, quadrature, vector,
};

fn near(a: f32, b: f32, tolerance: f32) -> bool {
    (a - b).abs() <= tolerance * b.abs().max(1.0)
}

#[defmt_test::tests]
mod tests {
    use super::*;
    use defmt::{assert, assert_eq};

    #[test]
    fn ball_has_its_volume() {
        assert!(near(ball::volume::<f32, 3>(2.0), 32.0 * PI / 3.0, 1e-6));
        assert!((ball::volume_real(4.0, 1.0) - ball::unit_volume(4)).abs() < 1e-14);
        assert_eq!(ball::unit_surface(2), 2.0 * core::f64::consts::PI);
    }

    #[test]
    fn every_kernel_obeys_the_laws() {
        macro_rules! obey {
            ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {$(
                assert!(kernel::$Kernel::SINGULAR || conformance::check::<kernel::$Kernel, f32>().is_ok(), $name);
            )+};
        }
        sph_core::for_each_kernel!(obey);
    }

    #[test]
    fn normalisation_equals_the_closed_forms() {
        let pi = core::f64::consts::PI;
        assert!((kernel::normalisation::<Poly6>(3) * 64.0 * pi / 315.0 - 1.0).abs() < 1e-14);
        assert!((kernel::normalisation::<CubicSpline>(2) * 7.0 * pi / 40.0 - 1.0).abs() < 1e-14);
        assert!((volume::shell::<Poly6>(2, 1.0) - pi / 4.0).abs() < 1e-14);
        assert!((volume::printed::<Poly6>(3, 1.0) - pi / 30.0).abs() < 1e-14);
    }

    #[test]
    fn raw_poly6_is_as_printed() {
        assert_eq!(Poly6::raw(2.0_f32, 1.0), 27.0);
        assert_eq!(Poly6::raw(2.0_f32, 2.5), 0.0);
    }

    #[test]
    fn influence_vanishes_at_the_support_and_its_gradient_at_the_centre() {
        let w = KernelInfluence::<f32, 2, WendlandC2>::new(0.5).unwrap();
        assert!(near(w.influence_at(&[0.0, 0.0]), 28.0 / PI, 1e-6));
        assert_eq!(w.influence_at(&[0.5, 0.0]), 0.0);
        assert_eq!(w.gradient_at(&[0.0, 0.0]), [0.0, 0.0]);
        assert!(w.gradient_at(&[0.2, 0.0])[0] < 0.0);
    }

    #[test]
    fn gradient_equals_the_central_difference() {
        let w = KernelInfluence::<f64, 3, CubicSpline>::new(1.0).unwrap();
        let x = [0.3, -0.2, 0.4];
        let numeric = difference::gradient(|x| w.influence_at(x), &x, 1e-5);
        let error = vector::sub(&numeric, &w.gradient_at(&x));
        assert!(vector::norm_squared(&error) < 1e-16);
    }

    #[test]
    fn a_closure_equals_its_kernel() {
        let closure = ClosureInfluence::<f32, 2, _>::new(1.5, CubicSpline::raw).unwrap();
        let w = KernelInfluence::<f32, 2, CubicSpline>::new(1.5).unwrap();
        assert!(near(closure.influence(0.25), w.influence(0.25), 1e-5));
    }

    #[test]
    fn each_sample_has_its_own_radius() {
        let w = PerSampleInfluence::<f32, 2, Spiky>::new(&[1.0, 2.0]).unwrap();
        assert_eq!(w.reach(), 2.0);
        assert!(w.of(2).is_none());
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let refused = KernelInfluence::<f32, 3, Viscosity>::new(1.0);
        assert_eq!(refused.unwrap_err(), Error::SingularKernel);
        let refused = KernelInfluence::<f32, 2, Poly6>::new(f32::NAN);
        assert_eq!(refused.unwrap_err(), Error::NotFinite { parameter: Parameter::SupportRadius, index: 0 });
    }

    #[test]
    fn viscosity_laplacian_is_as_printed() {
        let laplacian = ViscosityLaplacian::<f32, 3>::new(1.0).unwrap();
        assert!(near(laplacian.at_distance(0.5), 22.5 / PI, 1e-6));
    }

    #[test]
    fn differences_and_quadrature_are_exact_for_polynomials() {
        assert_eq!(difference::nth(|x: f64| x * x * x, 3, 5.0, 0.5), 6.0);
        assert!((difference::nth_auto(|x: f64| x * x, 1, 3.0) - 6.0).abs() < 1e-8);
        assert!(near(quadrature::integrate(|x: f32| x * x, 0.0, 3.0), 9.0, 1e-5));
    }
}
