//! Enclosures and bounds hold: a sample of what `cargo bench -p sph-lab --bench bounds` holds a million times.

use proptest::prelude::*;
use sph_core::kernel::{CubicSpline, Kernel, Poly6, QuinticSpline, Spiky, WendlandC2};
use sph_core::{Arithmetic, Scalar};
use sph_lab::{Emulated, Format, Interval, Rounding, Running};

#[path = "common/bounds.rs"]
mod bounds;
#[path = "common/double_double.rs"]
mod double_double;
#[path = "common/random.rs"]
mod random;

use double_double::DoubleDouble;

fn both<K: Kernel>(numbers: std::ops::Range<u64>) {
    for number in numbers {
        bounds::hold_intervals::<K, 1>(number);
        bounds::hold_intervals::<K, 2>(number);
        bounds::hold_intervals::<K, 3>(number);
        for rounding in [Rounding::Nearest, Rounding::Floor, Rounding::Stochastic { seed: 1 }] {
            let format = Format::new(9, 14).unwrap().with_rounding(rounding);
            bounds::hold_bounds::<K, 2>(number, format, &mut [[0.0; 2]; 3]);
            bounds::hold_bounds::<K, 3>(number, format, &mut [[0.0; 2]; 3]);
        }
    }
}

#[test]
fn fields_are_enclosed() {
    both::<Poly6>(0..4);
    both::<Spiky>(0..4);
    both::<CubicSpline>(0..4);
    both::<WendlandC2>(0..4);
    both::<QuinticSpline>(0..4);
}

/// The exact result of an operation in 31 digits.
type Exact = fn(DoubleDouble, DoubleDouble) -> DoubleDouble;

/// The operation in T, and exactly.
type Operation<T> = (fn(T, T) -> T, Exact);

fn operations<T: Scalar>() -> [Operation<T>; 8] {
    [
        (|a, b| a + b, |a, b| a + b),
        (|a, b| a - b, |a, b| a - b),
        (|a, b| a * b, |a, b| a * b),
        (|a, b| a / b, |a, b| a / b),
        (|a, b| (a * b).positive_part(), |a, b| (a * b).positive_part()),
        (|a, b| (a + b).times(-7), |a, b| (a + b).times(-7)),
        (|a, b| Scalar::sqrt(Scalar::abs(a - b)), |a, b| Scalar::sqrt(Scalar::abs(a - b))),
        (|a, b| Scalar::max(a, b) - Scalar::min(a, b), |a, b| Scalar::max(a, b) - Scalar::min(a, b)),
    ]
}

proptest! {
    #[test]
    fn an_operation_is_enclosed(
        a in -1e3..1e3_f64, b in -1e3..1e3_f64, width in prop_oneof![Just(0.0), 0.0..0.1_f64], at in -1.0..1.0_f64,
    ) {
        for (number, (found, exact)) in operations::<Interval>().into_iter().enumerate() {
            let found = found(Interval::around(a, width), Interval::around(b, width));
            let inside = |x: f64| DoubleDouble::from_f64((x + 0.999 * at * width).clamp(x - width, x + width));
            let exact = exact(inside(a), inside(b));
            let holds = exact.compare(found.lower()).is_ge() && exact.compare(found.upper()).is_le();
            prop_assert!(holds || exact.0.is_nan(), "operation {number}: {exact:?} {found:?}");
        }
    }

    #[test]
    fn an_operation_is_bounded(
        a in -6.0..6.0_f64, b in -6.0..6.0_f64, fraction in 3..20_u32, integer in 3..6_u32,
        rounding in prop::sample::select(vec![Rounding::Nearest, Rounding::Floor, Rounding::TowardZero]),
    ) {
        let format = Format::new(integer, fraction.max(8 - integer)).unwrap().with_rounding(rounding);
        for (number, (found, exact)) in operations::<Running>().into_iter().enumerate() {
            let (value, bound) = format.scope(|| {
                let found = found(Running::from_f64(a), Running::from_f64(b));
                (found.to_f64(), found.bound())
            });
            let error = (DoubleDouble::from_f64(value) - exact(DoubleDouble(a, 0.0), DoubleDouble(b, 0.0))).0.abs();
            prop_assert!(error <= bound || error.is_nan(), "operation {number} {format}: {error} {bound}");
        }
    }
}

#[test]
fn what_is_exact_stays_narrow() {
    let (three, half) = (Interval::ratio(3, 1), Interval::ratio(1, 2));
    assert_eq!((three + half).width(), 0.0);
    assert!((three * half).width() < 1e-15);
    assert!(Interval::ratio(1, 3).width() > 0.0);
    Format::new(4, 12).unwrap().scope(|| {
        let (three, half) = (Running::ratio(3, 1), Running::ratio(1, 2));
        assert!((three * half).bound() < 1e-14, "{:?}", three * half);
        assert!(Running::from_f64(100.0).bound() > 91.0, "what saturation lost is in the bound");
    });
}

#[test]
fn comparisons_that_are_open_are_counted_and_visited() {
    let x = Interval::around(1.0, 0.1);
    let before = Interval::undecided();
    let answers = [x < Interval::ONE, x > Interval::ONE, x > Interval::point(2.0)];
    assert_eq!(answers, [true, true, false]);
    assert_eq!(Interval::undecided() - before, 2);
    Format::new(4, 12).unwrap().scope(|| {
        let x = Running::known_up_to(Emulated::ONE, 0.1);
        let before = Running::undecided();
        assert_eq!([x < Running::ONE, x > Running::ONE], [true, false]);
        assert_eq!(Running::undecided() - before, 2);
    });
}

#[test]
fn what_is_undefined_is_the_whole_line() {
    assert_eq!(Interval::point(f64::NAN), Interval::LINE);
    assert_eq!(Interval::ratio(1, 0), Interval::LINE);
    assert_eq!(Interval::LINE * Interval::ZERO, Interval::ZERO);
    assert_eq!(Interval::LINE - Interval::LINE, Interval::LINE);
    assert!(Interval::new(2.0, 1.0).is_none() && Interval::new(f64::NAN, 1.0).is_none());
    assert!(!(Interval::point(f64::MAX) + Interval::point(f64::MAX)).is_finite());
    Format::new(4, 12).unwrap().scope(|| {
        assert_eq!((Running::ONE / Running::ZERO).bound(), f64::INFINITY);
        assert_eq!(Running::from_f64(f64::NAN).bound(), f64::INFINITY);
    });
}
