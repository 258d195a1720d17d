//! Numbers as text: the shortest that reads back to the same bits.

use super::Precision;

/// The shortest text that reads back to `value`: as an `f64`, or as an `f32` when `precision` says that the value is one.
///
/// Decimal form near one, exponent form for very large and very small numbers (`0.1`, `1e-7`). A NaN, which stands for
/// "no value", is the empty text.
///
/// ```
/// use sph_host::output::{Precision, shortest};
///
/// assert_eq!(shortest(0.1, Precision::F64), "0.1");
/// assert_eq!(shortest(f64::from(0.1_f32), Precision::F32), "0.1");
/// assert_eq!(shortest(1e-7, Precision::F64), "1e-7");
/// assert_eq!(shortest(f64::NAN, Precision::F64), "");
/// ```
#[must_use]
pub fn shortest(value: f64, precision: Precision) -> String {
    format_into(&mut zmij::Buffer::new(), value, precision).to_owned()
}

/// [`shortest`] without an allocation: the text lives in `buffer`.
pub(super) fn format_into(buffer: &mut zmij::Buffer, value: f64, precision: Precision) -> &str {
    if value.is_nan() {
        return "";
    }
    match precision {
        Precision::F64 => buffer.format(value),
        Precision::F32 => buffer.format(value as f32),
    }
}
