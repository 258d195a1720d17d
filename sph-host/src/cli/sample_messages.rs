//! What `fluisim sample` says of errors and warnings: which option to change.

use super::failure::Failure;
use crate::demo;
use crate::estimate_choice::Estimate;
use crate::io::ReadError;
use crate::kernel_choice::KernelName;
use crate::sample::{SampleError, SamplePoints, Significant, Warning};

/// An error in the command's words, and whether these or the input are at fault.
pub(super) fn explain(error: SampleError) -> Failure {
    let advice = match &error {
        SampleError::UnknownSet { name } => return unknown_set(name),
        SampleError::PiecesAsPoints { .. } => ": leave out --chunk",
        SampleError::NoMass { .. } => &format!(
            ": neither a column `m` or `mass` nor --mass; only --estimate {} does without, and not where densities are summed",
            without_mass()
        ),
        SampleError::NoSupport { spacing, kernel, .. } => &no_support(*spacing, *kernel),
        SampleError::StandardInputTwice => return Failure::usage(error.to_string()),
        SampleError::NoneTaken { .. } => ": choose others by --only",
        SampleError::PeriodicDimensions { .. } => " (--periodic)",
        SampleError::TooFewCoordinates { asked, .. } => &format!(" by --dim {asked}"),
        SampleError::NotFlat { dim, .. } => &format!(": --dim {dim} needs it to be"),
        SampleError::ChangingQuantities { .. } => ": say which by --quantity",
        SampleError::SameName { .. } => ": say which by --quantity",
        SampleError::GridDimensions { counts, .. } => &format!(" (--grid {})", list(counts)),
        SampleError::Grid { is_particles_box: true, .. } => ": give the box with --bounds",
        SampleError::TooLarge { at, particles, .. } => &too_large(at, *particles),
        SampleError::OutOfRange { .. }
        | SampleError::PositionOutOfRange { .. }
        | SampleError::BoxOutOfRange { .. } => ": choose another --scalar",
        SampleError::Read(ReadError::SeveralSets { .. }) => "; --group NAME chooses one of PARTICLES",
        _ => "",
    };
    let message = format!("{error}{advice}");
    match error {
        SampleError::Read(ReadError::SeveralSets { .. }) => Failure::input(message),
        SampleError::Read(error) => Failure::from(error),
        _ => Failure::input(message),
    }
}

/// A warning in the command's words, and that it is one.
pub(super) fn in_words(warning: &Warning) -> String {
    let advice = match warning {
        Warning::Flat { constant, .. } => {
            let dropped: Vec<&str> = constant.iter().map(|(axis, _)| *axis).collect();
            let dim = 3 - constant.len();
            &format!(
                " and densities are per volume; --dim {dim} drops {} and takes the kernels and densities of {dim} \
                 dimension{}",
                dropped.join(" and "),
                if dim == 1 { "" } else { "s" }
            )
        }
        Warning::Coarse { .. } => ": choose --scalar f64",
        _ => "",
    };
    let word = if matches!(warning, Warning::Note { .. }) { "note" } else { "warning" };
    format!("{word}: {warning}{advice}")
}

/// The estimates that need no mass.
fn without_mass() -> String {
    let names: Vec<&str> =
        Estimate::ALL.iter().filter(|one| !one.needs_mass()).map(|one| one.name()).collect();
    names.join(" or ")
}

/// The error for the name of a built-in set that is none.
pub(super) fn unknown_set(name: &str) -> Failure {
    let names: Vec<String> = demo::SETS.iter().map(|(name, _)| format!("demo:{name}")).collect();
    Failure::usage(format!("there is no built-in set `demo:{name}`: choose {}", names.join(", ")))
}

/// What helps where there is no support radius, with a value that would give a customary number of neighbours.
fn no_support(spacing: Option<f64>, kernel: KernelName) -> String {
    let Some(spacing) = spacing else {
        return String::from(
            ", and all particles are at one point, so that there is no spacing to suggest one from: give --support, or name a \
             column with --support-column",
        );
    };
    format!(
        ": try --support {:.3}, 2.6 times the mean spacing (or --smoothing-length {:.3} for {}), or name a column with \
         --support-column",
        Significant(2.6 * spacing),
        Significant(2.6 * spacing / kernel.support_ratio()),
        kernel.name(),
    )
}

/// The options that make a result too large.
fn too_large(at: &SamplePoints, particles: Option<usize>) -> String {
    let grid = match at {
        SamplePoints::Grid { counts, .. } => Some(format!("--grid {}", list(counts))),
        SamplePoints::At(_) | SamplePoints::AtParticles => None,
    };
    let particles = particles.map(|count| format!("--particles {count}"));
    let options: Vec<String> = grid.into_iter().chain(particles).collect();
    format!(": ask for less than {}", options.join(" and "))
}

/// Counts as they are given, with commas between them.
fn list(counts: &[usize]) -> String {
    counts.iter().map(usize::to_string).collect::<Vec<_>>().join(",")
}
