//! Every format in every mode against `i128`, and the cases that catch others' mistakes.

extern crate std;

mod exact;
mod modes;
mod sums;

use super::*;
use core::mem::size_of;

use ::fixed::types::{I1F7, I1F15, I1F31, I2F62, I3F13, I8F0, I16F0, I32F0};

/// Calls a generic check under every mode for the formats that are shown by name, and for the ends of every word's splits.
macro_rules! every {
    ($check:ident $arguments:tt) => {
        crate::for_each_format!(every; $check $arguments);
        every!(
            [I1F7 "" ""; I8F0 "" ""; I1F15 "" ""; I3F13 "" ""; I16F0 "" ""; I1F31 "" ""; I32F0 "" ""; I2F62 "" "";]
            $check $arguments
        )
    };
    ([$($Format:ident $name:tt $about:tt;)+] $check:ident $arguments:tt) => {$(
        every!(one $check, $Format, Wrap, $arguments);
        every!(one $check, $Format, Saturate, $arguments);
        every!(one $check, $Format, Check, $arguments);
    )+};
    (one $check:ident, $Format:ty, $Mode:ty, ($($argument:expr),*)) => {
        $check::<$Format, $Mode>($($argument),*)
    };
}
pub(super) use every;

/// The largest count of units.
fn largest<F>() -> i128 {
    (1 << (8 * size_of::<F>() - 1)) - 1
}

/// The low bits of an integer as a signed count, as the format's word reads them.
fn wrapped<F>(exact: i128) -> i128 {
    let spare = 128 - 8 * size_of::<F>();
    exact << spare >> spare
}

/// The count of units in a number.
fn count<F: Format, O: Overflow>(number: Fixed<F, O>) -> i128 {
    wrapped::<F>(number.canonical_bits().into())
}

/// The number with the low bits of this count.
fn number<F: Format, O: Overflow>(count: i64) -> Fixed<F, O> {
    Fixed::from_bits(F::Bits::low_bits(count))
}

/// What the mode makes of an exact count.
fn narrowed<F, O: Overflow>(exact: i128) -> i128 {
    let largest = largest::<F>();
    match O::NAME_INDEX {
        0 => exact.clamp(-largest, largest),
        1 => wrapped::<F>(exact),
        _ if exact.abs() <= largest => exact,
        _ => -largest - 1,
    }
}

/// n/d to the nearest integer, ties away from zero; d is not 0.
fn nearest(n: i128, d: i128) -> i128 {
    let (n, d) = if d < 0 { (-n, -d) } else { (n, d) };
    let (floor, rest) = (n.div_euclid(d), n.rem_euclid(d));
    let up = 2 * rest > d || (2 * rest == d && n > 0);
    floor + i128::from(up)
}

/// The ends of the range, zero, one and what lies beside them, halves and third parts.
fn edges<F: Format>() -> [i64; 19] {
    let largest = largest::<F>() as i64;
    let one = 1i64 << F::FRAC_NBITS;
    [
        -largest - 1,
        -largest,
        1 - largest,
        -largest / 2,
        -one - 1,
        -one,
        1 - one,
        -one / 3,
        -2,
        -1,
        0,
        1,
        2,
        one / 2,
        one - 1,
        one,
        one + 1,
        largest / 2,
        largest,
    ]
}
