//! What a number type costs on one's own particles, and the one to take.
//!
//! A [`Request`] is met in steps, each a module with one entry: `set` takes the particles, `sweep` finds for each kernel the units and
//! the integer bits that it needs and measures every format at some particles, `recommend` takes the fewest bits that meet the goals
//! and measures these at all particles, and `insight` tells where the error comes from. What comes of it is a [`Study`], which
//! `report` writes for people and `files` for programs.
//!
//! A number of a format is the compiled type's to the bit ([`sph_lab::Emulated`]). Errors are against the sums of f64 in the same
//! units, from the positions as they were read, relative to the largest magnitude of these sums. Sums go over the particles that a
//! search finds: no particle out of reach is looked at.
//!
//! ```
//! use sph_host::kernel_choice::KernelName;
//! use sph_host::sample::ParticleSource;
//! use sph_host::study::{self, Quantity, Request};
//!
//! let request = Request {
//!     kernels: vec![KernelName::Poly6],
//!     goals: vec![(Quantity::Density, 1e-2)],
//!     ..Request::new(ParticleSource::Demo("vortex".into(), Some(400)))
//! };
//! let study = study::run(&request, &())?;
//! let found = study.recommendation.unwrap();
//! assert!(found.errors[0].largest <= 1e-2);
//! assert_eq!(found.format.bits(), 16);
//! # Ok::<(), study::StudyError>(())
//! ```

mod costs;
mod error;
mod files;
pub mod fluid;
#[doc = include_str!("../../docs/fixed-point.md")]
pub mod findings {}
mod formats;
mod insight;
mod measure;
mod pictures;
mod recommend;
mod report;
mod request;
mod set;
mod sweep;
#[cfg(test)]
mod tests;
mod units;

pub use costs::{Instructions, Target};
pub use error::StudyError;
pub use formats::NumberFormat;
pub use insight::{BlamedPlace, Insight, UnitTrial};
pub use measure::Deviation;
pub use recommend::Recommendation;
pub use request::{Quantity, Request, UnitChoice};
pub use sweep::{Row, Saturations};

use crate::estimate_choice::Estimate;
use crate::kernel_choice::KernelName;
use crate::parallel;
use crate::progress::Progress;
use crate::sample::{self, ParticleSet, SamplePoints};
use crate::scalar_choice::ScalarName;
use set::{Set, spread};
use sweep::{Prepared, Trial};

/// Particles at which every format is measured, at most.
const TRIAL_POINTS: usize = 256;
/// Particles at which every operation is watched, at most.
const WATCHED_POINTS: usize = 32;

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// The file or set.
    pub file: String,
    /// How many particles there are.
    pub particles: usize,
    /// At how many of them the rows are measured.
    pub points: usize,
    /// Dimensions.
    pub dim: usize,
    /// The mean number of particles in reach of one, itself included.
    pub neighbours: f64,
    /// What the error is measured of, each with the largest that is good enough.
    pub goals: Vec<(Quantity, f64)>,
    /// The processor whose instructions are told.
    pub target: Target,
    /// All formats: kernel by kernel, mode by mode, from few bits to many.
    pub rows: Vec<Row>,
    /// Kernels for which there are no rows, and why.
    pub left_out: Vec<(KernelName, String)>,
    /// The format to take; none where no format of the bits that were allowed meets the goals.
    pub recommendation: Option<Recommendation>,
    /// What is known of the recommended format, or of the best where there is none.
    pub insight: Option<Insight>,
}

impl Request {
    /// A study of these particles with everything else as it is where nothing is asked for.
    #[must_use]
    pub fn new(particles: sample::ParticleSource) -> Self {
        Self {
            particles,
            support: None,
            only: Vec::new(),
            mass: None,
            dim: None,
            fields: Vec::new(),
            kernels: KernelName::ALL.iter().copied().filter(|kernel| !kernel.is_singular()).collect(),
            goals: Quantity::ALL.iter().map(|&quantity| (quantity, quantity.usual_goal())).collect(),
            bits: 8..=32,
            roundings: vec![sph_lab::Rounding::Nearest],
            overflows: vec![sph_lab::Overflow::Saturating],
            also: Vec::new(),
            margin: 0,
            bound: false,
            units: UnitChoice::Auto,
            target: Target::M0,
            threads: None,
        }
    }

    /// The particles as `sample` would read them.
    fn sample(&self, kernel: KernelName) -> sample::Request {
        sample::Request {
            particles: self.particles.clone(),
            at: SamplePoints::AtParticles,
            kernel,
            dim: self.dim,
            quantities: self.fields.clone(),
            gradient: true,
            surface: None,
            support: self.support.clone(),
            only: self.only.clone(),
            periodic: None,
            part: None,
            estimate: Estimate::Plain,
            mass: self.mass,
            recompute_density: false,
            scalar: ScalarName::F64,
            threads: self.threads,
            chunk: None,
            exact: true,
        }
    }
}

/// Makes a study.
///
/// # Errors
/// [`StudyError`] says what is wrong with the particles, or which quantity has nothing to compare with. That no format meets the goals is
/// no error: the study then has no recommendation.
pub fn run(request: &Request, progress: &dyn Progress) -> Result<Study, StudyError> {
    if let Some(&kernel) = request.kernels.iter().find(|kernel| kernel.is_singular()) {
        return Err(StudyError::SingularKernel { kernel });
    }
    let kernel = request.kernels.first().copied().unwrap_or(KernelName::ALL[0]);
    let mut read = ParticleSet::read(&request.sample(kernel))?;
    if request.fields.is_empty() {
        read.fields.truncate(1);
    }
    let pool = parallel::pool(request.threads, || ()).map_err(StudyError::Threads)?;
    pool.install(|| match read.coordinates.len() {
        1 => in_dimensions::<1>(read, request, progress),
        2 => in_dimensions::<2>(read, request, progress),
        _ => in_dimensions::<3>(read, request, progress),
    })
}

fn in_dimensions<const D: usize>(
    read: ParticleSet,
    request: &Request,
    progress: &dyn Progress,
) -> Result<Study, StudyError> {
    let set = Set::<D>::new(read)?;
    let count = set.positions.len();
    let patch = set.around(&spread(count, TRIAL_POINTS))?;
    let watched = set.around(&spread(count, WATCHED_POINTS))?;
    let trial = Trial { patch: &patch, watched: &watched };
    let prepared = parallel::map(request.kernels.iter(), |_, &kernel| {
        (kernel, sweep::prepare(&trial, &set, kernel, request))
    });
    let mut kernels: Vec<Prepared<D>> = Vec::new();
    let mut left_out = Vec::new();
    for (kernel, prepared) in prepared {
        match prepared {
            Ok(prepared) => {
                prepared.require_something(&set.file, count, request)?;
                if prepared.integer_bits.is_none() {
                    left_out.push((kernel, String::from("40 integer bits are too few")));
                }
                kernels.push(prepared);
            }
            Err(why) => left_out.push((kernel, why)),
        }
    }
    let rows = sweep::sweep(&trial, &kernels, request, progress);
    let found = recommend::recommend(&set, &patch, &kernels, &rows, request)?;
    let insight = insight::insight(&set, &trial, &kernels, &rows, found.as_ref(), request);
    if rows.iter().all(|row| row.errors.is_err()) {
        return Err(no_format(&set, &kernels, &rows, &left_out, request));
    }
    Ok(Study {
        file: set.file.clone(),
        particles: count,
        points: patch.points.len(),
        dim: D,
        neighbours: patch.neighbours(),
        goals: request.goals.clone(),
        target: request.target,
        rows,
        left_out,
        recommendation: found.map(|(_, recommendation)| recommendation),
        insight,
    })
}

/// The error where no format holds the particles.
fn no_format<const D: usize>(
    set: &Set<D>,
    kernels: &[Prepared<D>],
    rows: &[Row],
    left_out: &[(KernelName, String)],
    request: &Request,
) -> StudyError {
    let refused = rows.iter().find_map(|row| row.errors.as_ref().err().cloned());
    let needed = kernels.iter().filter_map(|prepared| prepared.integer_bits).min();
    let positions = kernels.first().map(|prepared| prepared.units.bits_of_positions(set));
    let why = match (needed, positions, refused) {
        (Some(needed), Some(positions), _) => format!(
            "they need {needed} integer bits, {positions} of them for the coordinates, and at least {} fraction bits",
            formats::LEAST_FRACTION
        ),
        (None, Some(positions), _) if positions > 40 => {
            format!("the coordinates alone need {positions} integer bits")
        }
        (.., Some(why)) => why,
        _ => left_out.first().map_or_else(String::new, |(_, why)| why.clone()),
    };
    let (least, most) = (*request.bits.start(), *request.bits.end());
    StudyError::NoFormat { file: set.file.clone(), least, most, why }
}
