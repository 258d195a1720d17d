//! An emulated format gives the bits that its compiled type gives: operation by operation on hostile bits, and field by field.

use proptest::prelude::*;
use sph_core::kernel::{CubicSpline, Poly6, WendlandC2};
use sph_core::scalar::compact::Compact;
use sph_core::scalar::fixed::types::{I1F7, I1F15, I1F31, I2F62, I3F13, I4F4, I8F0, I16F0, I32F0, I64F0};
use sph_core::scalar::fixed::*;
use sph_core::{Accumulator, Scalar};
use sph_lab::{Emulated, Format};

mod fields;
#[path = "../common/random.rs"]
mod random;

/// What the operations give, as bits.
fn operations<T: Compact>(a: T, b: T, n: i32, x: f64) -> Vec<u64> {
    let flag = |flag: bool| u64::from(flag);
    let mut sum = T::Sum::ZERO;
    [a, b, a, T::ONE].into_iter().for_each(|term| sum.add(term));
    let near = a.offset(b);
    let (place, rest) = Scalar::max(a, T::ZERO).split(6);
    let numbers = [
        a + b,
        a - b,
        a * b,
        a / b,
        -a,
        a.times(n),
        T::ratio(n, 7),
        T::ratio(n, 0),
        a.positive_part(),
        a.pow::<3>(),
        a.sqrt(),
        T::from_f64(x),
        sum.total(),
        sum.scaled_total(a, b),
        Scalar::min(a, b),
        Scalar::abs(a),
        T::from_near(near),
        rest,
        T::ONE,
        T::EPSILON,
        T::MAX,
    ];
    let mut bits: Vec<u64> = numbers.into_iter().map(Scalar::canonical_bits).collect();
    bits.extend(numbers.map(|number| flag(number.is_finite())));
    bits.extend([flag(a < b), flag(a == b), flag(a >= b), place as u64, a.floor_to_i32() as u64]);
    let f64_bits = |value: f64| if value.is_nan() { 0 } else { value.to_bits() };
    bits.extend([f64_bits(a.to_f64()), f64_bits((a * b).to_f64())]);
    bits
}

/// What all three modes of a format give must be what the emulation of their names gives.
fn compare<S: Compact, W: Compact, C: Compact>(
    of: impl Fn([u64; 2]) -> ([S; 2], [W; 2], [C; 2]),
    raw: [u64; 2],
    n: i32,
    x: f64,
) {
    let ([sa, sb], [wa, wb], [ca, cb]) = of(raw);
    let compiled = [operations(sa, sb, n, x), operations(wa, wb, n, x), operations(ca, cb, n, x)];
    for (name, compiled) in [S::NAME, W::NAME, C::NAME].into_iter().zip(compiled) {
        let emulated = name.parse::<Format>().unwrap().scope(|| {
            let [a, b] = raw.map(|bits| Emulated::from_bits(bits as i64));
            operations(a, b, n, x)
        });
        assert_eq!(emulated, compiled, "{name}: {:#x} {:#x} {n} {x}", raw[0], raw[1]);
    }
}

/// The operations of some formats, in all three modes.
macro_rules! operations {
    ([$($Format:ident $name:tt $about:tt;)+] $compare:ident) => {
        fn $compare(raw: [u64; 2], n: i32, x: f64) {
            $(
                compare(
                    |raw| (
                        raw.map(|bits| Saturating::<$Format>::from_bits(bits as _)),
                        raw.map(|bits| Wrapping::<$Format>::from_bits(bits as _)),
                        raw.map(|bits| Checked::<$Format>::from_bits(bits as _)),
                    ),
                    raw,
                    n,
                    x,
                );
            )+
        }
    };
}
sph_core::for_each_format!(operations; compare_all);
operations! {
    // the ends of each word's splits, which no list shows
    [I1F7 "" ""; I4F4 "" ""; I8F0 "" ""; I1F15 "" ""; I3F13 "" ""; I16F0 "" ""; I1F31 "" ""; I32F0 "" ""; I2F62 "" ""; I64F0 "" "";]
    compare_ends
}

/// Fields in some formats, in one mode.
macro_rules! fields {
    ([$($Format:ident $name:tt $about:tt;)+] $Mode:ident $Kernel:ident) => {
        [$(fields::compare::<$Mode<$Format>, $Kernel, 2>(120)),+].into_iter().sum::<usize>()
    };
}

/// Bits with ends, small numbers and everything between.
fn bits() -> impl Strategy<Value = u64> {
    prop_oneof![
        any::<u64>(),
        any::<i16>().prop_map(|n| n as i64 as u64),
        any::<i32>().prop_map(|n| n as i64 as u64),
        prop::sample::select(vec![
            0,
            1,
            u64::MAX,
            1 << 15,
            1 << 31,
            1 << 63,
            (1 << 15) - 1,
            (1 << 31) - 1,
            (1 << 63) - 1
        ]),
    ]
}

proptest! {
    #[test]
    fn operations_have_the_bits_of_the_compiled_type(
        a in bits(),
        b in bits(),
        n in prop_oneof![-40..40_i32, any::<i32>()],
        x in prop_oneof![any::<f64>(), -1e5..1e5_f64, Just(f64::NAN), Just(f64::INFINITY)],
    ) {
        compare_all([a, b], n, x);
        compare_ends([a, b], n, x);
    }
}

/// A part of what `cargo bench -p sph-lab --bench equality` holds, which compiles for minutes.
#[test]
fn fields_have_the_bits_of_the_compiled_type() {
    let of_all_formats = sph_core::for_each_format!(fields; Saturating WendlandC2);
    assert!(of_all_formats > 7000, "{of_all_formats}");
    let of_narrow = fields!([I4F12 "" ""; I4F28 "" "";] Wrapping Poly6)
        + fields!([I4F12 "" ""; I16F16 "" "";] Checked CubicSpline)
        + fields!([I1F15 "" ""; I3F13 "" "";] Saturating Poly6);
    assert!(of_narrow > 3000, "{of_narrow}");
}

#[test]
fn a_scope_ends_with_its_work() {
    let before = Format::current();
    let inside: Format = "checked-i4f12".parse().unwrap();
    inside.scope(|| {
        assert_eq!(Format::current(), inside);
        let _ = std::panic::catch_unwind(|| Format::new(2, 62).unwrap().scope(|| panic!("within")));
        assert_eq!(Format::current(), inside);
    });
    assert_eq!(Format::current(), before);
}

#[test]
fn formats_that_cannot_be_are_refused() {
    for (name, part) in [
        ("i0f16", "at least 1 integer bit"),
        ("i3f4", "8 to 64"),
        ("i40f25", "8 to 64"),
        ("i99999999999f1", "a format such as"),
        ("i4294967295f4294967295", "8 to 64"),
        ("f16", "a format such as"),
        ("i+4f12", "a format such as"),
        ("", "a format such as"),
    ] {
        let message = name.parse::<Format>().unwrap_err().to_string();
        assert!(message.contains(part) && message.starts_with(name), "{name}: {message}");
    }
}
