//! Dual numbers: derivatives against closed forms, against the library's gradients, and through a fluid's steps.

use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid};
use sph_core::kernel::{Poly6, QuinticSpline, Spiky, WendlandC2};
use sph_core::{Accumulator, Arithmetic, Influence, KernelInfluence, Scalar};
use sph_lab::{Dual, Emulated, Format, Interval};

#[path = "common/derivatives.rs"]
mod derivatives;
#[path = "common/double_double.rs"]
mod double_double;
#[path = "common/random.rs"]
mod random;

/// A function, and its value and derivatives by x and y in closed form.
type Known = (fn(Dual<f64, 2>, Dual<f64, 2>) -> Dual<f64, 2>, fn(f64, f64) -> [f64; 3]);

const KNOWN: &[Known] = &[
    (|x, y| x * y + x, |x, y| [x * y + x, y + 1.0, x]),
    (|x, y| x / y - y, |x, y| [x / y - y, 1.0 / y, -x / (y * y) - 1.0]),
    (
        |x, y| (x * x + y).sqrt(),
        |x, y| {
            let root = (x * x + y).sqrt();
            [root, x / root, 0.5 / root]
        },
    ),
    (|x, y| x.pow::<5>() * -y, |x, y| [-x.powi(5) * y, -5.0 * x.powi(4) * y, -x.powi(5)]),
    (
        |x, y| (x - y).positive_part().times(3),
        |x, y| if x > y { [3.0 * (x - y), 3.0, -3.0] } else { [0.0; 3] },
    ),
    (|x, y| Scalar::max(x, y) + Scalar::min(x, y), |x, y| [x + y, 1.0, 1.0]),
    (|x, y| Scalar::abs(x - y), |x, y| [(x - y).abs(), (x - y).signum(), (y - x).signum()]),
    (|x, y| (x * y).split(3).1, |x, y| [(8.0 * x * y).fract(), 8.0 * y, 8.0 * x]),
    (|x, y| Dual::ratio(1, 3) * x + Dual::from_f64(2.0) * y, |x, y| [x / 3.0 + 2.0 * y, 1.0 / 3.0, 2.0]),
];

#[test]
fn derivatives_are_those_of_the_closed_form() {
    let mut random = random::Random(5);
    for _ in 0..200 {
        let (x, y) = (1.6 + random.signed(), 1.7 + random.signed());
        for (number, (dual, known)) in KNOWN.iter().enumerate() {
            let [a, b] = Dual::variables([x, y]);
            let found = dual(a, b);
            let [dx, dy] = found.derivatives();
            for (found, expected) in [found.value(), dx, dy].into_iter().zip(known(x, y)) {
                let error = (found - expected).abs();
                assert!(error <= 1e-12 * expected.abs().max(1.0), "{number}: {found} {expected}");
            }
        }
    }
}

#[test]
fn the_derivative_of_w_is_the_gradient() {
    macro_rules! holds {
        ($($Kernel:ident $limit:literal),+) => {$(
            for (dim, worst) in [
                derivatives::kernel::<$Kernel, 1>(3000),
                derivatives::kernel::<$Kernel, 2>(3000),
                derivatives::kernel::<$Kernel, 3>(3000),
            ].into_iter().enumerate() {
                let holds = worst.iter().all(|worst| *worst <= $limit);
                assert!(holds, "{} in {} dimensions: {worst:?} ε", stringify!($Kernel), dim + 1);
            }
        )+};
    }
    // the powers of the quintic spline cancel near r = 0: both sides round numbers 17 times as large as the steepest slope
    holds!(Poly6 8.0, Spiky 8.0, QuinticSpline 18.0, WendlandC2 8.0);
}

#[test]
fn the_derivative_of_an_interpolation_is_the_gradient() {
    for worst in [derivatives::fields::<Poly6, 1>(300), derivatives::fields::<WendlandC2, 2>(300)] {
        assert!(worst.iter().all(|worst| *worst <= 100.0), "{worst:?}");
    }
    let worst = derivatives::fields::<QuinticSpline, 3>(300);
    assert!(worst.iter().all(|worst| *worst <= 100.0), "{worst:?}");
}

/// W of poly6 in two dimensions is 4/(π h²) (1 − q²)³: its Laplacian is 4/(π h⁴) (24 q² (1 − q²) − 12 (1 − q²)²).
#[test]
fn nested_duals_have_second_derivatives() {
    type Second = Dual<Dual<f64, 2>, 2>;
    let h = 0.8;
    let w = KernelInfluence::<Second, 2, Poly6>::new(Dual::constant(Dual::constant(h))).unwrap();
    for x in [[0.0, 0.0], [0.3, -0.2], [0.5, 0.6], [0.7, 0.7]] {
        let inner = Dual::variables(x);
        let found = w.influence_at(&Dual::variables(inner));
        let laplacian: f64 = (0..2).map(|axis| found.derivatives()[axis].derivatives()[axis]).sum();
        let q2 = (x[0] * x[0] + x[1] * x[1]) / (h * h);
        let rest = (1.0 - q2).max(0.0);
        let expected = 4.0 / (std::f64::consts::PI * h.powi(4)) * (24.0 * q2 * rest - 12.0 * rest * rest);
        assert!((laplacian - expected).abs() < 1e-12, "{laplacian} {expected}");
    }
}

#[test]
fn a_dual_is_as_good_as_what_it_is_made_of() {
    let slope = Format::new(6, 20).unwrap().scope(|| {
        let x = Dual::<Emulated, 1>::variable(Emulated::from_f64(0.7), 0);
        (x * x).derivatives()[0].to_f64()
    });
    assert!((slope - 1.4).abs() < 1e-5);
    let x = Dual::<Interval, 1>::variable(Interval::around(0.7, 1e-3), 0);
    let slope = (x * x * x).derivatives()[0];
    assert!(
        slope.contains(3.0 * 0.7005 * 0.7005)
            && slope.contains(3.0 * 0.6995 * 0.6995)
            && slope.width() < 0.02
    );
    let mut sum = <Dual<f64, 1> as Scalar>::Sum::ZERO;
    sum.add(Dual::variable(2.0, 0));
    sum.add(Dual::variable(3.0, 0));
    assert_eq!((sum.total().value(), sum.total().derivatives()), (5.0, [2.0]));
    let scaled = sum.scaled_total(Dual::variable(2.0, 0), Dual::constant(1.0));
    assert_eq!((scaled.value(), scaled.derivatives()), (10.0, [5.0 + 2.0 * 2.0]));
}

/// The mean height of a pendant's fluid after some frames, gravity being tilted by an angle's sine.
fn height<T: sph_core::scalar::compact::Compact>(tilt: T) -> T {
    let mut fluid: PositionBasedFluid<T, OpenBox<T, 2>, 2, 32, 64> =
        PositionBasedFluid::new(OpenBox::new([T::ratio(6, 1), T::ratio(6, 1)]));
    for k in 0..24 {
        let at = [T::ratio(1 + 2 * (k % 6), 4), T::ratio(1 + 2 * (k / 6), 4)];
        fluid.add(Particle::new(at, [T::ZERO; 2])).unwrap();
    }
    for _ in 0..40 {
        fluid.step([tilt * T::ratio(1, 200), T::ratio(-1, 200)]);
    }
    let places = fluid.particles().iter().map(|particle| particle.position());
    let mut sum = T::ZERO;
    for [x, y] in places {
        sum += x + y;
    }
    sum / T::ratio(24, 1)
}

#[test]
fn the_derivative_goes_through_forty_frames_of_a_fluid() {
    let tilt = 0.21;
    let found = height(Dual::<f64, 1>::variable(tilt, 0));
    assert_eq!(found.value(), height(tilt), "who differentiates changes no bit");
    let [slope] = found.derivatives();
    let step = 1e-6;
    let difference = (height(tilt + step) - height(tilt - step)) / (2.0 * step);
    assert!(slope.abs() > 0.1 && (slope / difference - 1.0).abs() < 1e-6, "{slope} {difference}");
}
