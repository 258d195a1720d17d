//! Numbers that code trips over, out of bytes.

use arbitrary::{Result, Unstructured};
use sph_core::Scalar;

const HARD: [f64; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    f64::MIN_POSITIVE,
    1e-30,
    1e30,
    -1e30,
    f64::MAX,
    f64::MIN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Half of the numbers are near 1, others hard ones or any bits.
pub(crate) fn number<T: Scalar>(bytes: &mut Unstructured) -> Result<T> {
    Ok(T::from_f64(match bytes.arbitrary::<u8>()? {
        kind @ 0..14 => HARD[usize::from(kind)],
        14..24 => f64::from_bits(bytes.arbitrary()?),
        _ => f64::from(bytes.arbitrary::<i16>()?) / 4096.0,
    }))
}

/// One number an axis.
pub(crate) fn vector<T: Scalar, const D: usize>(bytes: &mut Unstructured) -> Result<[T; D]> {
    let mut vector = [T::ZERO; D];
    for along in &mut vector {
        *along = number(bytes)?;
    }
    Ok(vector)
}

/// Up to `most` places.
pub(crate) fn vectors<T: Scalar, const D: usize>(
    bytes: &mut Unstructured,
    most: usize,
) -> Result<Vec<[T; D]>> {
    (0..bytes.int_in_range(0..=most)?).map(|_| vector(bytes)).collect()
}
