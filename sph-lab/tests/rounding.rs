//! Roundings that no compiled type has, against what each promises.

use proptest::prelude::*;
use sph_core::{Accumulator, Arithmetic, Scalar};
use sph_lab::{Emulated, Format, FormatError, Overflow, Rounding};

fn format(rounding: Rounding) -> Format {
    Format::new(8, 12).unwrap().with_rounding(rounding)
}

/// The results of every operation that rounds, and the exact ones, in units.
fn results(a: i64, b: i64) -> Vec<(f64, f64)> {
    let (x, y) = (Emulated::from_bits(a), Emulated::from_bits(b));
    let (a, b, one) = (a as f64, b as f64, 4096.0);
    let mut sum = <Emulated as Scalar>::Sum::ZERO;
    sum.add(x);
    let third = 1.0 / 3.0;
    let mut found = vec![
        (x * y, a * b / one),
        (Scalar::sqrt(x), (a * one).sqrt()),
        (Emulated::from_f64(a * third), a * third * one),
        (Emulated::ratio(a as i32, 7), a * one / 7.0),
        (sum.scaled_total(y, Emulated::ONE), a * b / one),
    ];
    if b != 0.0 {
        found.push((x / y, a * one / b));
    }
    // what is out of range tells nothing of rounding
    let within = found.into_iter().filter(|(number, _)| number.is_finite());
    within.map(|(number, exact)| (number.to_bits() as f64, exact)).collect()
}

proptest! {
    #[test]
    fn every_rounding_keeps_its_side(a in 0..20_000_i64, b in -20_000..20_000_i64) {
        let each = |rounding| format(rounding).scope(|| results(a, b));
        for (found, exact) in each(Rounding::Nearest) {
            prop_assert!((found - exact).abs() <= 0.5 + 1e-6, "{found} {exact}");
        }
        for (found, exact) in each(Rounding::Floor) {
            prop_assert!(found <= exact + 1e-6 && found > exact - 1.0 - 1e-6, "{found} {exact}");
        }
        for (found, exact) in each(Rounding::TowardZero) {
            prop_assert!(found.abs() <= exact.abs() + 1e-6 && (found - exact).abs() < 1.0 + 1e-6, "{found} {exact}");
        }
        for (found, exact) in each(Rounding::Stochastic { seed: 3 }) {
            prop_assert!((found - exact).abs() < 1.0 + 1e-6, "{found} {exact}");
        }
    }
}

/// The mean of n roundings of a number whose part behind the unit is p has the deviation √(p (1 − p) / n).
#[test]
fn the_mean_of_stochastic_roundings_is_exact() {
    const ROUNDINGS: usize = 40_000;
    for (a, b) in [(4097, 1), (1234, -777), (19_999, 3), (5, 1000), (12_345, 6_789)] {
        let mut sums: Vec<(f64, f64)> = Vec::new();
        format(Rounding::Stochastic { seed: 1 }).scope(|| {
            for _ in 0..ROUNDINGS {
                let found = results(a, b);
                sums.resize(found.len(), (0.0, 0.0));
                for (sum, (found, exact)) in sums.iter_mut().zip(found) {
                    *sum = (sum.0 + found, exact);
                }
            }
        });
        for (number, (sum, exact)) in sums.into_iter().enumerate() {
            let part = exact - exact.floor();
            let deviation = (part * (1.0 - part) / ROUNDINGS as f64).sqrt();
            let error = (sum / ROUNDINGS as f64 - exact).abs();
            assert!(error <= 5.0 * deviation + 1e-6, "result {number} of {a}, {b}: {error} {deviation}");
        }
    }
}

#[test]
fn stochastic_rounding_is_the_same_for_the_same_seed_and_leaves_exact_results_alone() {
    let many = |seed| {
        format(Rounding::Stochastic { seed }).scope(|| {
            let x = Emulated::from_f64(0.3);
            (0..100).map(|_| (x * x).to_bits()).collect::<Vec<_>>()
        })
    };
    assert_eq!(many(5), many(5));
    let interrupted = format(Rounding::Stochastic { seed: 5 }).scope(|| {
        let x = Emulated::from_f64(0.3);
        let product = |n: usize| {
            if n == 50 {
                many(6);
            }
            (x * x).to_bits()
        };
        (0..100).map(product).collect::<Vec<_>>()
    });
    assert_eq!(interrupted, many(5), "a scope within leaves the chances of the outer one alone");
    assert_ne!(many(5), many(6));
    format(Rounding::Stochastic { seed: 9 }).scope(|| {
        for _ in 0..1000 {
            let half = Emulated::ratio(1, 2);
            assert_eq!((half * half).to_f64(), 0.25);
            assert_eq!(Scalar::sqrt(half * half), half);
            assert_eq!((half / Emulated::from_f64(0.25)).to_f64(), 2.0);
            assert_eq!(Emulated::from_f64(-1.75).to_f64(), -1.75);
        }
    });
}

#[test]
fn names_come_back() {
    for name in ["nearest", "floor", "zero", "stochastic"] {
        assert_eq!(name.parse::<Rounding>().unwrap().to_string(), name);
    }
    for name in ["saturating", "wrapping", "checked"] {
        assert_eq!(name.parse::<Overflow>().unwrap().to_string(), name);
    }
    assert_eq!("up".parse::<Rounding>(), Err(FormatError::Rounding("up".into())));
    assert_eq!("".parse::<Overflow>().unwrap_err().to_string(), ": expected saturating, wrapping or checked");
}
