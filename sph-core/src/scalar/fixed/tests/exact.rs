//! Operations against exact integer arithmetic.

use super::*;
use proptest::prelude::*;

/// A count of units of any size: as many random bits as the second number leaves.
fn any_count() -> impl Strategy<Value = i64> {
    (any::<i64>(), 0..64u32).prop_map(|(bits, shift)| bits >> shift)
}

fn is_nar<F: Format, O: Overflow>(number: Fixed<F, O>) -> bool {
    O::STICKY && count(number) == -largest::<F>() - 1
}

/// Sum, difference, product, quotient and comparison of two numbers.
fn pair<F: Format, O: Overflow>(a: i64, b: i64) {
    let (x, y) = (number::<F, O>(a), number::<F, O>(b));
    let (a, b, one) = (count(x), count(y), 1i128 << F::FRAC_NBITS);
    if is_nar(x) || is_nar(y) {
        for lost in [x + y, x - y, x * y, x / y] {
            assert!(is_nar(lost), "{} of {a} and {b}", Fixed::<F, O>::NAME);
        }
        assert_eq!(x.partial_cmp(&y), None);
        assert!(x != y);
        return;
    }
    assert_eq!(x.partial_cmp(&y), a.partial_cmp(&b));
    assert_eq!(x == y, a == b);
    let added = |exact: i128| match O::NAME_INDEX {
        0 => exact.clamp(-largest::<F>() - 1, largest::<F>()),
        _ => narrowed::<F, O>(exact),
    };
    assert_eq!(count(x + y), added(a + b));
    assert_eq!(count(x - y), added(a - b));
    let (mut grown, mut shrunk) = (x, x);
    grown += y;
    shrunk -= y;
    assert_eq!((count(grown), count(shrunk)), (count(x + y), count(x - y)));
    assert_eq!(count(x * y), narrowed::<F, O>(nearest(a * b, one)), "{} {a} {b}", Fixed::<F, O>::NAME);
    if b != 0 {
        assert_eq!(count(x / y), narrowed::<F, O>(nearest(a * one, b)), "{} {a} {b}", Fixed::<F, O>::NAME);
    }
    if a != -largest::<F>() - 1 {
        assert_eq!(count(-x * y), count(-(x * y)));
        assert_eq!(count(-x / y), count(-(x / y)));
    }
    assert_eq!(count(x * y), count(y * x));
}

/// Everything of one number, and its product with an integer.
fn single<F: Format, O: Overflow>(a: i64, n: i32) {
    let x = number::<F, O>(a);
    let a = count(x);
    if is_nar(x) {
        for lost in [-x, x.abs(), x.sqrt(), x.positive_part(), x.times(n)] {
            assert!(is_nar(lost));
        }
        assert!(x.to_f64().is_nan() && x.floor_to_i32() == 0 && !x.is_finite());
        return;
    }
    assert_eq!(count(x.positive_part()), a.max(0));
    assert_eq!(count(x.times(n)), narrowed::<F, O>(a * i128::from(n)));
    let floor = (a >> F::FRAC_NBITS).clamp(i32::MIN.into(), i32::MAX.into());
    assert_eq!(i128::from(x.floor_to_i32()), floor);
    assert_eq!(x.to_f64(), a as f64 / (1u64 << F::FRAC_NBITS) as f64);
    if a.abs() <= largest::<F>() {
        assert_eq!(count(-x), -a);
        assert_eq!(count(x.abs()), a.abs());
    }
    let (root, square) = (count(x.sqrt()), a.max(0) << F::FRAC_NBITS);
    if a < 0 && O::STICKY {
        assert!(is_nar(x.sqrt()));
    } else {
        let (root, square) = (root as u128, square as u128);
        assert!(4 * square < (2 * root + 1) * (2 * root + 1), "√{a}");
        assert!(root == 0 || 4 * square > (2 * root - 1) * (2 * root - 1), "√{a}");
    }
}

fn ratio<F: Format, O: Overflow>(n: i32, d: i32) {
    if d != 0 {
        let exact = nearest(i128::from(n) << F::FRAC_NBITS, d.into());
        assert_eq!(count(Fixed::<F, O>::ratio(n, d)), narrowed::<F, O>(exact), "{n}/{d}");
    }
}

/// Against the float's own product with a power of two and its `round`, both exact.
fn from_f64<F: Format, O: Overflow>(value: f64) {
    let made = Fixed::<F, O>::from_f64(value);
    let scaled = (value * (1u64 << F::FRAC_NBITS) as f64).round();
    if value.is_nan() {
        assert!(is_nar(made) || count(made) == 0);
    } else if O::NAME_INDEX == 1 && scaled.abs() >= 1e36 {
        assert_eq!(count(made), 0, "no bit of {value} is as low as the word");
    } else {
        assert_eq!(
            count(made),
            narrowed::<F, O>(scaled.clamp(-1e37, 1e37) as i128),
            "{} {value:e}",
            Fixed::<F, O>::NAME
        );
    }
}

fn edge_pairs<F: Format, O: Overflow>() {
    for a in edges::<F>() {
        for b in edges::<F>() {
            pair::<F, O>(a, b);
            ratio::<F, O>(a as i32, b as i32);
        }
        for n in [i32::MIN, i32::MAX, -20, -1, 0, 1, 2, 20] {
            single::<F, O>(a, n);
        }
    }
}

fn edge_floats<F: Format, O: Overflow>() {
    let end = (largest::<F>() + 1) as f64 / (1u64 << F::FRAC_NBITS) as f64;
    let half_unit = Fixed::<F, O>::EPSILON.to_f64() / 2.0;
    let values =
        [end, end - half_unit, end - 3.0 * half_unit, half_unit, half_unit.next_down(), 3.0 * half_unit];
    let general = [0.0, 1.0, 0.1, 1e9, 1e18, 1e36, 1e300, f64::MAX, f64::INFINITY, 5e-324, 1e-310, f64::NAN];
    for value in values.into_iter().chain(general) {
        from_f64::<F, O>(value);
        from_f64::<F, O>(-value);
    }
}

#[test]
fn the_edges_of_every_type() {
    every!(edge_pairs());
    every!(edge_floats());
}

proptest! {
    #[test]
    fn two_operands(a in any_count(), b in any_count()) {
        every!(pair(a, b));
    }

    #[test]
    fn one_operand(a in any_count(), n in any::<i32>()) {
        every!(single(a, n));
    }

    #[test]
    fn literals(n in any::<i32>(), d in any::<i32>(), small in 1..1000) {
        every!(ratio(n, d));
        every!(ratio(n % 1000, small));
    }

    #[test]
    fn from_any_f64(bits in any::<u64>(), exponent in 950u64..1110) {
        every!(from_f64(f64::from_bits(bits)));
        every!(from_f64(f64::from_bits(bits & !(0x7ff << 52) | exponent << 52)));
    }
}

/// What fits comes back from an f64 as it went, for formats that 53 bits hold.
#[test]
fn round_trip_through_f64() {
    for count in (-(1 << 31)..1i64 << 31).step_by(999_983) {
        let x = number::<I16F16, Check>(count);
        assert_eq!(Checked::<I16F16>::from_f64(x.to_f64()).to_bits(), x.to_bits());
    }
}

/// Errors of products over symmetric inputs add up to nothing, ties included, where a bare shift loses up to half a unit
/// each.
#[test]
fn rounding_does_not_drift() {
    for (factor, drift) in [(Saturating::<I16F16>::ratio(1, 2), -5_000), (Saturating::ratio(1, 3), -9_000)] {
        let (mut rounded, mut shifted) = (0i64, 0i64);
        for a in -10_000..=10_000i64 {
            rounded += count(number::<I16F16, Saturate>(a) * factor) as i64;
            shifted += (a * count(factor) as i64) >> 16;
        }
        assert_eq!(rounded, 0);
        assert!(shifted <= drift, "{shifted}");
    }
}

/// 0.0061², where dropping eight bits of each factor first gives 1 unit for 2.44.
#[test]
fn products_keep_their_low_bits() {
    let x = Saturating::<I16F16>::from_bits(400);
    assert_eq!((x * x).to_bits(), 2);
    let dropped_first = 400 >> 8;
    assert_eq!(dropped_first * dropped_first, 1);
}
