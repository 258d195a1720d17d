//! Where the error of a format comes from, and what could be had instead.

use sph_lab::{Choice, Chosen, Format, Log, Rounding};

use super::formats::{LEAST_FRACTION, NumberFormat};
use super::measure::{Converted, Deviation, measure, name_of};
use super::recommend::Recommendation;
use super::request::{Quantity, Request};
use super::set::{Patch, Set};
use super::sweep::{Prepared, Row, Trial, deviations, scales, shortfall, sums};
use super::units::{SUPPORTS, Units};
use crate::kernel_choice::KernelName;
use crate::parallel;

/// A place of the source, and what rounding there alone does.
#[derive(Clone, Debug, PartialEq)]
pub struct BlamedPlace {
    /// File, line and operation.
    pub place: String,
    /// The largest error of each quantity where only this place is rounded.
    pub alone: [f64; 3],
    /// The same where every place but this one is rounded.
    pub without: [f64; 3],
}

/// The most bits that were allowed, in some units.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitTrial {
    /// The support radius in the unit of length; none for the file's own units.
    pub support: Option<f64>,
    /// The split with the least error; none where no split holds the particles.
    pub format: Option<Format>,
    /// The errors of each quantity.
    pub errors: Option<[Deviation; 3]>,
}

/// What is known of one format.
#[derive(Clone, Debug, PartialEq)]
pub struct Insight {
    /// The kernel.
    pub kernel: KernelName,
    /// The format.
    pub format: Format,
    /// Every place of the source: how often, how large, how many bits.
    pub log: Log,
    /// The same format with each rounding, and its errors.
    pub roundings: Vec<(Rounding, [Deviation; 3])>,
    /// The most bits that were allowed in other units, those of the file last.
    pub units: Vec<UnitTrial>,
    /// Places and their part of the error, the worst first.
    pub blamed: Vec<BlamedPlace>,
    /// Bounds on the errors that hold for certain at the watched particles; none unless asked for.
    pub bounds: Option<[f64; 3]>,
}

impl Insight {
    /// How much less the error is in the best of the proposed units than in the file's own: the ratio of the distances from the goals.
    /// Infinite where no format of so many bits holds the file's numbers.
    #[must_use]
    pub fn gain(&self, goals: &[(Quantity, f64)]) -> Option<f64> {
        let short = |trial: &UnitTrial| {
            trial.errors.as_ref().map_or(f64::INFINITY, |errors| shortfall(errors, goals))
        };
        let own = short(self.units.iter().find(|trial| trial.support.is_none())?);
        let proposed = self.units.iter().filter(|trial| trial.support.is_some()).map(short);
        let best = proposed.fold(f64::INFINITY, f64::min);
        (best > 0.0 && best.is_finite()).then(|| own / best)
    }
}

/// What is known of the recommended format, or of the one nearest to the goals.
pub(super) fn insight<const D: usize>(
    set: &Set<D>,
    trial: &Trial<'_, D>,
    kernels: &[Prepared<D>],
    rows: &[Row],
    found: Option<&(&Prepared<D>, Recommendation)>,
    request: &Request,
) -> Option<Insight> {
    let (prepared, format) = match found {
        Some((prepared, recommendation)) => (*prepared, recommendation.fewest),
        None => nearest(kernels, rows, request)?,
    };
    let (_, log) = sph_lab::watch(|| Choice::Tally(format).scope(|| sums(trial.watched, prepared)));
    let each = [Rounding::Nearest, Rounding::Floor, Rounding::TowardZero, Rounding::Stochastic { seed: 0 }];
    let roundings = each.into_iter().filter_map(|rounding| {
        let format = NumberFormat::Fixed(format.with_rounding(rounding));
        Some((rounding, prepared.errors(trial.patch, format).ok()?))
    });
    Some(Insight {
        kernel: prepared.kernel,
        format,
        log,
        roundings: roundings.collect(),
        units: units(set, trial.watched, prepared.kernel, request),
        blamed: blamed(trial.watched, prepared, format, request),
        bounds: if request.bound { bounds(trial.watched, prepared, format) } else { None },
    })
}

/// The fixed-point format that comes nearest to the goals.
fn nearest<'a, const D: usize>(
    kernels: &'a [Prepared<D>],
    rows: &[Row],
    request: &Request,
) -> Option<(&'a Prepared<D>, Format)> {
    let fixed = rows.iter().filter_map(|row| match row.format {
        NumberFormat::Fixed(format) if row.errors.is_ok() => Some((row, format)),
        _ => None,
    });
    let short = |row: &Row| row.shortfall(&request.goals);
    let (row, format) = fixed.min_by(|(a, _), (b, _)| short(a).total_cmp(&short(b)))?;
    Some((kernels.iter().find(|prepared| prepared.kernel == row.kernel)?, format))
}

/// The most bits that were allowed, in the proposed units and in the file's.
fn units<const D: usize>(
    set: &Set<D>,
    patch: &Patch<D>,
    kernel: KernelName,
    request: &Request,
) -> Vec<UnitTrial> {
    let proposed = SUPPORTS.iter().map(|&support| (Some(support), Units::with_support(set, support)));
    let all = proposed.chain(std::iter::once((None, Units::file(set))));
    parallel::map(all, |_, (support, units)| {
        let best = best_split(set, patch, kernel, units, request);
        let (format, errors) = best.unzip();
        UnitTrial { support, format, errors }
    })
}

/// The split of the most bits with the least error in these units.
fn best_split<const D: usize>(
    set: &Set<D>,
    patch: &Patch<D>,
    kernel: KernelName,
    units: Units<D>,
    request: &Request,
) -> Option<(Format, [Deviation; 3])> {
    let bits = *request.bits.end();
    let least = units.bits_of_positions(set);
    let prepared = Prepared::new(patch, kernel, units).ok()?;
    let short = |errors: &[Deviation; 3]| shortfall(errors, &request.goals);
    let mut best: Option<(Format, [Deviation; 3])> = None;
    for integer in least..=bits.saturating_sub(LEAST_FRACTION) {
        let Ok(format) = Format::new(integer, bits - integer) else { continue };
        let Ok(errors) = prepared.errors(patch, NumberFormat::Fixed(format)) else { continue };
        let is_better = best.as_ref().is_none_or(|(_, least)| short(&errors) < short(least));
        // once nothing leaves the range every further integer bit is one less for the fraction
        if !is_better
            && best.as_ref().is_some_and(|(_, least)| short(&errors) > 4.0 * short(least))
            && short(&errors) < 1e3
        {
            break;
        }
        if is_better {
            best = Some((format, errors));
        }
    }
    best
}

/// The part of the error that each place has.
fn blamed<const D: usize>(
    watched: &Patch<D>,
    prepared: &Prepared<D>,
    format: Format,
    request: &Request,
) -> Vec<BlamedPlace> {
    let sums = || Choice::Blame.scope(|| measure::<Chosen, D>(watched, prepared.kernel, &prepared.units));
    let Ok(truth) = measure::<f64, D>(watched, prepared.kernel, &prepared.units) else { return Vec::new() };
    let scales = scales(&truth);
    let errors = |measured| deviations(&measured, &truth, &scales);
    let largest = |errors: [Deviation; 3]| errors.map(|error| error.largest);
    let places = sph_lab::blame(format, || sums().ok().map(errors)).into_iter();
    let mut places: Vec<(f64, BlamedPlace)> = places
        .filter_map(|one| {
            let (alone, without) = one.alone.zip(one.without)?;
            let place = name_of(&one.place);
            let alone_short = shortfall(&alone, &request.goals);
            Some((alone_short, BlamedPlace { place, alone: largest(alone), without: largest(without) }))
        })
        .collect();
    places.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    places.into_iter().map(|(_, place)| place).collect()
}

/// Bounds on the errors of each quantity, relative as the errors are.
fn bounds<const D: usize>(watched: &Patch<D>, prepared: &Prepared<D>, format: Format) -> Option<[f64; 3]> {
    let truth = measure::<f64, D>(watched, prepared.kernel, &prepared.units).ok()?;
    let scales = scales(&truth);
    let numbers = |choice: Choice| {
        choice.scope(|| {
            let converted = Converted::<Chosen, D>::new(watched, prepared.kernel, &prepared.units).ok()?;
            let mut numbers = Vec::new();
            converted.sums(watched, |quantity, field, sum| numbers.push((quantity, field, sum))).ok()?;
            Some(numbers)
        })
    };
    let (plain, bounded) = (numbers(Choice::Emulated(format))?, numbers(Choice::Running(format))?);
    let mut largest = [0.0_f64; 3];
    // the squares of a vector's bounds, and how many there are
    let mut vector = (0, 0.0);
    for ((quantity, field, plain), (.., bounded)) in plain.into_iter().zip(bounded) {
        let (plain, bounded) = (plain.emulated()?, bounded.running()?);
        let bound = format.scope(|| bounded.bound_of(plain));
        let share = if quantity == Quantity::Density { 1.0 } else { prepared.units.shares[field] };
        vector = (vector.0 + 1, vector.1 + (bound * share).powi(2));
        if vector.0 == if quantity == Quantity::Gradient { D } else { 1 } {
            let index = quantity.index();
            largest[index] = largest[index].max(vector.1.sqrt() / scales[index]);
            vector = (0, 0.0);
        }
    }
    Some(largest)
}
