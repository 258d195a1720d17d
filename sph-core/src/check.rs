//! Checks of constructors' arguments.

use crate::{Error, Parameter, Scalar};

/// The value is finite.
pub(crate) fn finite<T: Scalar>(value: T, parameter: Parameter, index: usize) -> Result<(), Error> {
    if value.is_finite() { Ok(()) } else { Err(Error::NotFinite { parameter, index }) }
}

/// The value is finite and greater than zero.
pub(crate) fn positive<T: Scalar>(value: T, parameter: Parameter, index: usize) -> Result<(), Error> {
    finite(value, parameter, index)?;
    if value > T::ZERO { Ok(()) } else { Err(Error::NotPositive { parameter, index }) }
}

/// A positive constant computed in T neither overflowed nor vanished.
pub(crate) fn representable<T: Scalar>(value: T, parameter: Parameter) -> Result<(), Error> {
    if value.is_finite() && value > T::ZERO { Ok(()) } else { Err(Error::NotRepresentable { parameter }) }
}

/// A length is the expected one.
pub(crate) fn length(found: usize, expected: usize, parameter: Parameter) -> Result<(), Error> {
    if found == expected { Ok(()) } else { Err(Error::LengthMismatch { parameter, expected, found }) }
}
