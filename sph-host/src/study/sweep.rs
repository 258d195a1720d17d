//! Every format that was asked for, at some of the particles.

use sph_core::Scalar;
use sph_lab::{Choice, Chosen, Format, Overflow, Rounding};

use super::costs::{self, Instructions};
use super::error::StudyError;
use super::formats::{LEAST_FRACTION, NumberFormat};
use super::measure::{Converted, Deviation, Measured, measure};
use super::request::{Quantity, Request, UnitChoice};
use super::set::{Patch, Set};
use super::units::{SUPPORTS, Units};
use crate::kernel_choice::KernelName;
use crate::parallel;
use crate::progress::Progress;

/// A larger error than this in a format of many fraction bits is one of range.
const IN_RANGE: f64 = 1e-4;
/// Integer bits beyond which no format is looked for.
const MOST_INTEGER: u32 = 40;
/// Fraction bits that tell range from rounding.
const FINE: u32 = 24;

/// Saturations of a computation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Saturations {
    /// Those that changed a result or a comparison.
    pub consequential: u64,
    /// All others.
    pub harmless: u64,
}

/// One format with one kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The kernel.
    pub kernel: KernelName,
    /// The format.
    pub format: NumberFormat,
    /// The errors of each [`Quantity`], in its order; or why there are no sums.
    pub errors: Result<[Deviation; 3], String>,
    /// Saturations at some of the points, for formats that saturate.
    pub saturations: Option<Saturations>,
    /// Bytes of a particle in the narrowest word.
    pub bytes: u32,
    /// Instructions of a pair, where they were counted.
    pub instructions: Option<Instructions>,
}

impl Row {
    /// How far it is from the goals: the largest error over its goal, at most 1 where all are met.
    #[must_use]
    pub fn shortfall(&self, goals: &[(Quantity, f64)]) -> f64 {
        self.errors.as_ref().map_or(f64::INFINITY, |errors| shortfall(errors, goals))
    }
}

/// The largest error over its goal.
pub(super) fn shortfall(errors: &[Deviation; 3], goals: &[(Quantity, f64)]) -> f64 {
    goals.iter().map(|(quantity, goal)| errors[quantity.index()].largest / goal).fold(0.0, f64::max)
}

/// A kernel with the units that suit it, and the truth at some particles.
#[derive(Clone, Debug)]
pub(super) struct Prepared<const D: usize> {
    pub(super) kernel: KernelName,
    pub(super) units: Units<D>,
    /// The fewest integer bits with which nothing leaves the range; none where there are too few of them.
    pub(super) integer_bits: Option<u32>,
    truth: Measured,
    scales: [f64; 3],
}

impl<const D: usize> Prepared<D> {
    /// The truth in some units.
    pub(super) fn new(patch: &Patch<D>, kernel: KernelName, units: Units<D>) -> Result<Self, String> {
        let truth = measure::<f64, D>(patch, kernel, &units).map_err(|refusal| refusal.to_string())?;
        let scales = scales(&truth);
        Ok(Self { kernel, units, integer_bits: None, truth, scales })
    }

    /// Looks for the fewest integer bits, from so many on, with which nothing leaves the range.
    fn find_integer_bits(&mut self, patch: &Patch<D>, least: u32) {
        self.integer_bits = (least..=MOST_INTEGER).find(|&integer| {
            let fine = Format::new(integer, FINE);
            let errors = fine.ok().and_then(|format| self.errors(patch, NumberFormat::Fixed(format)).ok());
            errors.is_some_and(|errors| errors.iter().all(|error| error.largest < IN_RANGE))
        });
    }

    /// The errors of a format at the points of the patch that the truth is of.
    pub(super) fn errors(&self, patch: &Patch<D>, format: NumberFormat) -> Result<[Deviation; 3], String> {
        let measured =
            format.measure(patch, self.kernel, &self.units).map_err(|refusal| refusal.to_string())?;
        Ok(deviations(&measured, &self.truth, &self.scales))
    }

    /// That every quantity is somewhere other than zero.
    pub(super) fn require_something(
        &self,
        file: &str,
        particles: usize,
        request: &Request,
    ) -> Result<(), StudyError> {
        match request.goals.iter().find(|(quantity, _)| self.scales[quantity.index()] == 0.0) {
            Some(&(quantity, _)) => {
                let why = if particles == 1 {
                    "there is one particle"
                } else {
                    "none has another in reach, or all are alike"
                };
                Err(StudyError::NothingToCompare { file: file.to_owned(), quantity, why })
            }
            None => Ok(()),
        }
    }

    /// The format of so many bits with just enough integer bits.
    pub(super) fn format(&self, bits: u32, request: &Request) -> Option<Format> {
        let integer = self.integer_bits? + request.margin;
        let fraction = bits.checked_sub(integer)?;
        (fraction >= LEAST_FRACTION).then(|| Format::new(integer, fraction).ok())?
    }
}

/// The largest of each quantity.
pub(super) fn scales(truth: &Measured) -> [f64; 3] {
    Quantity::each(|quantity| truth.largest(quantity))
}

/// The errors of each quantity.
pub(super) fn deviations(measured: &Measured, truth: &Measured, scales: &[f64; 3]) -> [Deviation; 3] {
    Quantity::each(|quantity| measured.deviation(truth, quantity, scales[quantity.index()]))
}

/// The kernel in the units that were asked for; of the proposed ones those with the least error at a middling number of bits.
pub(super) fn prepare<const D: usize>(
    trial: &Trial<'_, D>,
    set: &Set<D>,
    kernel: KernelName,
    request: &Request,
) -> Result<Prepared<D>, String> {
    let units = if request.units == UnitChoice::File {
        Units::file(set)
    } else {
        best_units(trial.watched, set, kernel, request)?
    };
    let least = units.bits_of_positions(set);
    let mut prepared = Prepared::new(trial.patch, kernel, units)?;
    prepared.find_integer_bits(trial.patch, least);
    Ok(prepared)
}

/// Of the proposed units those with the least error at a middling number of bits.
fn best_units<const D: usize>(
    patch: &Patch<D>,
    set: &Set<D>,
    kernel: KernelName,
    request: &Request,
) -> Result<Units<D>, String> {
    let bits = (*request.bits.start()).max(16).min(*request.bits.end());
    let mut best: Option<(f64, Units<D>)> = None;
    for support in SUPPORTS {
        let units = Units::with_support(set, support);
        let least = units.bits_of_positions(set);
        let mut prepared = Prepared::new(patch, kernel, units)?;
        prepared.find_integer_bits(patch, least);
        let format = prepared.format(bits, request).map(NumberFormat::Fixed);
        let errors = format.and_then(|format| prepared.errors(patch, format).ok());
        let short = errors.map_or(f64::INFINITY, |errors| shortfall(&errors, &request.goals));
        if best.as_ref().is_none_or(|(least, _)| short < *least) {
            best = Some((short, prepared.units));
        }
    }
    best.map(|(_, units)| units).ok_or_else(String::new)
}

/// What one row is of.
struct Job<'a, const D: usize> {
    prepared: &'a Prepared<D>,
    format: NumberFormat,
}

/// The patches of a trial.
pub(super) struct Trial<'a, const D: usize> {
    /// Where errors are measured.
    pub(super) patch: &'a Patch<D>,
    /// Some of these points, where everything is watched.
    pub(super) watched: &'a Patch<D>,
}

/// All rows: kernel by kernel, mode by mode, from few bits to many.
pub(super) fn sweep<const D: usize>(
    trial: &Trial<'_, D>,
    kernels: &[Prepared<D>],
    request: &Request,
    progress: &dyn Progress,
) -> Vec<Row> {
    let others = request.roundings.iter().copied().filter(|rounding| *rounding != Rounding::Nearest);
    let roundings: &Vec<Rounding> = &std::iter::once(Rounding::Nearest).chain(others).collect();
    let jobs = kernels.iter().flat_map(|prepared| {
        let fixed = request.overflows.iter().flat_map(move |&overflow| {
            roundings.iter().flat_map(move |&rounding| {
                request.bits.clone().filter_map(move |bits| {
                    let format = prepared.format(bits, request)?;
                    Some(NumberFormat::Fixed(format.with_rounding(rounding).with_overflow(overflow)))
                })
            })
        });
        let also = request.also.iter().copied().map(NumberFormat::Mini);
        fixed.chain(also).map(move |format| Job { prepared, format })
    });
    let jobs: Vec<Job<'_, D>> = jobs.collect();
    progress.begin(jobs.len() as u64, 0);
    let rows = parallel::map(jobs.into_iter(), |_, job| {
        let row = row(trial, &job, request);
        progress.advance(1);
        row
    });
    progress.end();
    rows
}

fn row<const D: usize>(trial: &Trial<'_, D>, job: &Job<'_, D>, request: &Request) -> Row {
    let (prepared, format) = (job.prepared, job.format);
    let set = &trial.patch.set;
    let is_as_counted = matches!(format, NumberFormat::Fixed(format)
        if format.rounding() == Rounding::Nearest && format.overflow() == Overflow::Saturating);
    let word = costs::word(format.bits()).filter(|_| is_as_counted);
    Row {
        kernel: prepared.kernel,
        format,
        errors: prepared.errors(trial.patch, format),
        saturations: saturations(trial.watched, prepared, format),
        bytes: set.bytes(format.bits()),
        instructions: word.and_then(|word| Instructions::of(request.target, prepared.kernel, word)),
    }
}

/// What saturates at the watched points, for a format in which that can be seen.
fn saturations<const D: usize>(
    watched: &Patch<D>,
    prepared: &Prepared<D>,
    format: NumberFormat,
) -> Option<Saturations> {
    match format {
        NumberFormat::Fixed(format) if format.overflow() != Overflow::Wrapping => {
            let (done, log) = sph_lab::watch(|| Choice::Tally(format).scope(|| sums(watched, prepared)));
            done.ok()?;
            let all = log.saturations();
            Some(Saturations { consequential: all.consequential(), harmless: all.harmless() })
        }
        _ => None,
    }
}

/// Makes all sums of a patch in the type that is chosen, for the sake of what it sees.
pub(super) fn sums<const D: usize>(patch: &Patch<D>, prepared: &Prepared<D>) -> Result<(), String> {
    let converted = Converted::<Chosen, D>::new(patch, prepared.kernel, &prepared.units);
    let sums = converted.and_then(|converted| {
        converted.sums(patch, |_, _, sum| {
            sum.to_f64();
        })
    });
    sums.map_err(|refusal| refusal.to_string())
}
