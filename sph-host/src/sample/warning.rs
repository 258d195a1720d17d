//! What a person should know of a result: data, without the words of a command line.

use thiserror::Error;

use crate::estimate_choice::Estimate;

/// What a person should know of a result.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Warning {
    /// What a file says of itself, such as its units.
    #[error("{file}: {note}")]
    Note {
        /// The file.
        file: String,
        /// What it says.
        note: String,
    },
    /// No points were asked for.
    #[error("there are no points: the result has a header alone")]
    NoPoints,
    /// Particles in space that all lie in a plane or on a line across axes.
    #[error("{file}: {} everywhere, but sums run over 3 dimensions", named(.constant))]
    Flat {
        /// The particles' file.
        file: String,
        /// The axes along which all particles have the same coordinate, and that.
        constant: Vec<(&'static str, f64)>,
    },
    /// Positions that the scalar tells apart by so much at best.
    #[error(
        "{scalar} tells positions apart by {resolution:.1e} at best, where the support radius is {support:e}"
    )]
    Coarse {
        /// The scalar.
        scalar: String,
        /// The distance of neighbouring numbers at the farthest particle.
        resolution: f64,
        /// The smallest support radius.
        support: f64,
    },
    /// Points that have no particle in reach.
    #[error("{count} of {points} points have no particle in reach")]
    OutOfReach {
        /// How many.
        count: usize,
        /// Of how many.
        points: usize,
    },
    /// Points whose particles do not carry the estimate.
    #[error(
        "{count} of {points} points have too few particles in reach, or all of them in a plane, for the {estimate} estimate"
    )]
    NotCarried {
        /// By which.
        estimate: Estimate,
        /// How many.
        count: usize,
        /// Of how many.
        points: usize,
    },
    /// Values that are left out.
    #[error("{count} values are outside the range of the scalar and left out")]
    Overflowed {
        /// How many.
        count: usize,
    },
}

/// Such as "`y` is 0 and `z` is 1".
fn named(constant: &[(&'static str, f64)]) -> String {
    let named: Vec<String> = constant.iter().map(|(axis, value)| format!("`{axis}` is {value}")).collect();
    named.join(" and ")
}
