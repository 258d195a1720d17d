//! Words that say where support radii come from.

use clap::Args;

use super::failure::Failure;
use super::parse;
use crate::sample::SupportFrom;

/// One for all or a column, as a support radius or as a smoothing length.
#[derive(Debug, Args)]
pub(super) struct SupportArgs {
    /// The support radius, beyond which the kernel is zero
    #[arg(long, value_name = "H", value_parser = parse::positive, allow_hyphen_values = true, conflicts_with = "smoothing_length")]
    support: Option<f64>,
    /// The smoothing length: the support radius divided by the kernel's support ratio
    #[arg(long, value_name = "L", value_parser = parse::positive, allow_hyphen_values = true)]
    smoothing_length: Option<f64>,
    /// A column with each particle's support radius
    #[arg(long, value_name = "NAME", conflicts_with = "smoothing_length_column")]
    support_column: Option<String>,
    /// A column with each particle's smoothing length
    #[arg(long, value_name = "NAME")]
    smoothing_length_column: Option<String>,
    /// What the column is multiplied with: γ of files whose h is the support radius divided by γ, as SWIFT's (in 3-D 1.825742 for its
    /// cubic spline, 1.936492 for Wendland C2)
    #[arg(long, value_name = "F", value_parser = parse::positive, allow_hyphen_values = true)]
    support_factor: Option<f64>,
}

impl SupportArgs {
    /// Whether a kernel has to be known to make a support radius of what is given.
    pub(super) fn needs_kernel(&self) -> bool {
        self.smoothing_length.is_some() || self.smoothing_length_column.is_some()
    }

    /// What is given; an explicit value wins over a column.
    pub(super) fn source(&self) -> Result<Option<SupportFrom>, Failure> {
        let factor = self.support_factor.unwrap_or(1.0);
        let source = match (
            self.support,
            self.smoothing_length,
            &self.support_column,
            &self.smoothing_length_column,
        ) {
            (Some(h), ..) => Some(SupportFrom::Radius(h)),
            (_, Some(length), ..) => Some(SupportFrom::SmoothingLength(length)),
            (_, _, Some(name), _) => Some(SupportFrom::RadiusColumn(name.clone(), factor)),
            (.., Some(name)) => Some(SupportFrom::SmoothingLengthColumn(name.clone(), factor)),
            _ => None,
        };
        let is_column =
            matches!(source, Some(SupportFrom::RadiusColumn(..) | SupportFrom::SmoothingLengthColumn(..)));
        if self.support_factor.is_some() && !is_column {
            return Err(Failure::usage(
                "--support-factor multiplies a column: it needs --support-column or --smoothing-length-column, and no support for all",
            ));
        }
        Ok(source)
    }
}
