//! The codes that functions return: 0 or more for success, less than 0 for an error.

use sph_core::Error;

macro_rules! codes {
    ($($(#[$about:meta])+ $NAME:ident = $value:literal;)+) => {
        $($(#[$about])+ pub const $NAME: i32 = $value;)+

        /// Every code by the name that the header has for it, without `FLUISIM_`.
        pub const CODES: &[(&str, i32)] = &[$((stringify!($NAME), $value)),+];
    };
}

codes! {
    /// Done.
    OK = 0;
    /// A pointer is null.
    NULL = -1;
    /// A pointer is not aligned as its type must be.
    MISALIGNED = -2;
    /// The memory is too small.
    TOO_SMALL = -3;
    /// The fluid has as many particles as there is room for.
    FULL = -4;
    /// A position is not in the container.
    OUTSIDE = -5;
    /// A number is NaN or infinite, or at an end of the fixed-point range.
    NOT_FINITE = -6;
    /// A number is too small or too large, or an option is unknown.
    BAD_ARGUMENT = -7;
    /// The memory does not hold what the function works on.
    NOT_INITIALISED = -8;
    /// There is no particle or kernel of this number or name.
    NOT_FOUND = -9;
    /// There is no value: too few samples in reach, or a result beyond the range of the numbers.
    UNDEFINED = -10;
}

/// What an error of sph-core is in C.
#[must_use]
pub fn of(error: Error) -> i32 {
    match error {
        Error::NotFinite { .. } => NOT_FINITE,
        Error::OutsideDomain { .. } => OUTSIDE,
        Error::CapacityExceeded { .. } => TOO_SMALL,
        _ => BAD_ARGUMENT,
    }
}

/// The code of a result.
#[must_use]
pub fn of_result(result: Result<(), i32>) -> i32 {
    result.map_or_else(|code| code, |()| OK)
}

/// The result that a code stands for.
///
/// # Errors
/// The code, unless it is [`OK`].
pub fn to_result(code: i32) -> Result<(), i32> {
    if code == OK { Ok(()) } else { Err(code) }
}
