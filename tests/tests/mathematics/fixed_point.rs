//! Narrow scalars: the kernel laws, densities against f64, and overflow that is told.
//!
//! Units: lengths in support radii h and masses in those of a sample, so that density counts the samples in h³, 8 for
//! h = 2 Δx: the narrower the mass, the coarser the terms of the sum. I4F28 ends at 8: its length is 2h/3, so that the
//! quintic spline's constant σ₃ h⁻³ = 5.2 fits, and the density of one sample in Δx³ is 2.4.

use crate::cloud::jittered;
use crate::{each_kernel, name};
use sph_core::kernel::{CubicSpline, Kernel, QuinticSpline, ViscosityLaplacian, conformance};
use sph_core::scalar::fixed::{Checked, I4F28, I8F24, I16F16, I32F32, Saturating, Wrapping};
use sph_core::{
    Arithmetic, BruteForce, ClosureInfluence, Error, Influence, KernelInfluence, Parameter, Scalar, Sources,
    Uniform,
};

fn all_obey<T: Scalar>() {
    each_kernel!(K => assert_eq!(conformance::check::<K, T>(), Ok(()), "{} in {}", name::<K>(), T::NAME));
}

macro_rules! obey_in_every_scalar {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => { $(all_obey::<$Scalar>();)+ };
}

#[test]
fn every_kernel_obeys_the_laws_in_every_scalar() {
    sph_core::for_each_scalar!(obey_in_every_scalar);
    all_obey::<Checked<I16F16>>();
    all_obey::<Wrapping<I8F24>>();
}

/// The largest relative error of the density in T against f64, of samples as T has them whose whole neighbourhood is
/// filled: h/Δx = 2, D = 3.
fn largest_density_error<K: Kernel, T: Scalar>(h: f64) -> f64 {
    let count = 10;
    let narrow: Vec<[T; 3]> = jittered::<3>(count, 0.2, 77)
        .iter()
        .map(|x| x.map(|c| T::from_f64((c - 0.5) * count as f64 * h / 2.0)))
        .collect();
    let exact: Vec<[f64; 3]> = narrow.iter().map(|x| x.map(T::to_f64)).collect();
    let mass = 1.0;
    let in_t = Sources::new(BruteForce::new(&narrow).unwrap(), Uniform(T::from_f64(mass))).unwrap();
    let in_f64 = Sources::new(BruteForce::new(&exact).unwrap(), Uniform(mass)).unwrap();
    let w_t = KernelInfluence::<T, 3, K>::new(T::from_f64(h)).unwrap();
    let w = KernelInfluence::<f64, 3, K>::new(h).unwrap();
    let mut largest = 0.0_f64;
    let inside = count as f64 * h / 4.0 - h;
    let filled = |x: &[f64; 3]| x.iter().all(|c| c.abs() < inside);
    for (x_t, x) in narrow.iter().zip(&exact).filter(|(_, x)| filled(x)) {
        let (found, expected) = (in_t.density_at(&w_t, x_t).to_f64(), in_f64.density_at(&w, x));
        largest = largest.max((found / expected - 1.0).abs());
    }
    println!("{} in {}: {largest:.1e}", name::<K>(), T::NAME);
    largest
}

fn densities_within<T: Scalar>(h: f64, tolerance: f64) {
    each_kernel!(K => {
        // f is rounded to half a unit, and the constants σ₃ of M₅ and M₆ are 9.7 and 17.4
        let steep = matches!(name::<K>(), "QuarticSpline" | "QuinticSpline");
        let tolerance = if steep { 2.5 * tolerance } else { tolerance };
        let error = largest_density_error::<K, T>(h);
        assert!(error <= tolerance, "{} in {}: {error:e}", name::<K>(), T::NAME);
    });
}

#[test]
fn density_in_i16f16_is_within_1e_4() {
    densities_within::<Saturating<I16F16>>(1.0, 1e-4);
}

#[test]
fn density_in_i8f24_is_within_1e_6() {
    densities_within::<Saturating<I8F24>>(1.0, 4e-7);
}

#[test]
fn density_in_i4f28_is_within_1e_6() {
    densities_within::<Saturating<I4F28>>(1.5, 4e-7);
}

#[test]
fn density_in_i32f32_is_within_1e_8() {
    densities_within::<Saturating<I32F32>>(1.0, 4e-9);
}

#[test]
fn density_in_f32_is_within_1e_6() {
    densities_within::<f32>(1.0, 1e-6);
}

/// The three modes give the same bits where nothing overflows.
#[test]
fn modes_agree_where_nothing_overflows() {
    let bits = [
        largest_density_error::<CubicSpline, Saturating<I16F16>>(1.0),
        largest_density_error::<CubicSpline, Checked<I16F16>>(1.0),
        largest_density_error::<CubicSpline, Wrapping<I16F16>>(1.0),
    ];
    assert_eq!(bits[0].to_bits(), bits[1].to_bits());
    assert_eq!(bits[0].to_bits(), bits[2].to_bits());
}

/// Ten samples of mass 6 at one place: ρ = 60 · 8/π = 152.8 is beyond 128, and within each term.
#[test]
fn a_density_that_overflows_is_told_by_saturating_and_checked() {
    fn density<T: Scalar>() -> T {
        let positions = [[T::ZERO; 3]; 10];
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(T::from_f64(6.0))).unwrap();
        let w = KernelInfluence::<T, 3, CubicSpline>::new(T::ONE).unwrap();
        sources.density_at(&w, &positions[0])
    }
    let exact = 480.0 / core::f64::consts::PI;
    assert!((density::<f64>() - exact).abs() < 1e-12);
    assert!((density::<Saturating<I16F16>>().to_f64() - exact).abs() < 1e-2);
    let saturated = density::<Saturating<I8F24>>();
    assert!(!saturated.is_finite() && saturated.get() == I8F24::MAX);
    assert!(!density::<Checked<I8F24>>().is_finite());
    assert!((density::<Wrapping<I8F24>>().to_f64() - (exact - 256.0)).abs() < 1e-3);
}

/// h = 1 and the quintic spline: σ₃ = 17.4 is beyond I4F28, which the constructor says.
#[test]
fn a_constant_out_of_range_is_refused() {
    let refused = Err(Error::NotRepresentable { parameter: Parameter::Normalisation });
    let one = |_: ()| KernelInfluence::<Saturating<I4F28>, 3, QuinticSpline>::new(Saturating::from_f64(1.0));
    assert_eq!(one(()).map(|w| w.normalisation()), refused);
    let checked = KernelInfluence::<Checked<I4F28>, 3, QuinticSpline>::new(Checked::from_f64(1.0));
    assert_eq!(checked.map(|w| w.normalisation()).err(), refused.err());
    let small = KernelInfluence::<Saturating<I16F16>, 3, CubicSpline>::new(Saturating::from_f64(0.01));
    assert!(small.is_err(), "h⁻³ = 10⁶ is beyond 32768");
}

/// Constants beyond the range whose product is within it: 45/π = 14.3 of the viscosity Laplacian, S₃ = 4π of a closure.
#[test]
fn constants_beyond_the_range_are_multiplied_all_the_same() {
    type Narrow = Saturating<I4F28>;
    let h = Narrow::from_f64(2.0);
    let laplacian = ViscosityLaplacian::<Narrow, 3>::new(h).unwrap().at_distance(Narrow::ZERO).to_f64();
    assert!((laplacian / (45.0 / core::f64::consts::PI / 32.0) - 1.0).abs() < 1e-6, "{laplacian}");
    let quarter = Narrow::from_f64(0.25);
    let cone = |h: Narrow, r: Narrow| (h - r) * quarter;
    let closure = ClosureInfluence::<Narrow, 3, _>::new(h, cone).unwrap();
    // ∫ (2 − r)/4 4π r² dr = 4π/3, and ω(0) = 1/2
    let found = closure.influence(Narrow::ZERO).to_f64();
    assert!((found / (3.0 / (8.0 * core::f64::consts::PI)) - 1.0).abs() < 1e-5, "{found}");
}
