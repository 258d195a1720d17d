//! The format to take: the fewest bits that meet the goals at every particle.

use sph_lab::Format;

use super::costs::{self, Instructions};
use super::error::StudyError;
use super::formats::{LEAST_FRACTION, NumberFormat};
use super::measure::{Deviation, Measured, measure};
use super::request::{Quantity, Request};
use super::set::{Patch, Set, spread};
use super::sweep::{Prepared, Row, deviations, scales, shortfall};
use crate::kernel_choice::KernelName;
use crate::parallel;

/// Points whose particles are taken together.
const PIECE: usize = 512;
/// Pieces that are measured before the next are begun.
const PIECES: usize = 16;
/// Parts of the particles over which the errors' spread is told.
const PARTS: usize = 8;

/// The format to take, with what it gives at every particle.
#[derive(Clone, Debug, PartialEq)]
pub struct Recommendation {
    /// The kernel.
    pub kernel: KernelName,
    /// The fewest bits that meet the goals: with one fraction bit less one of them is missed.
    pub fewest: Format,
    /// The format to compile: as many fraction bits in a whole word, the others being integer bits.
    pub format: Format,
    /// The unit of length, in the file's.
    pub length: f64,
    /// The unit of mass.
    pub mass: f64,
    /// The unit of each field, with its name.
    pub values: Vec<(String, f64)>,
    /// The origin of coordinates.
    pub origin: Vec<f64>,
    /// The errors of each [`Quantity`], in its order.
    pub errors: [Deviation; 3],
    /// The standard deviation of the largest error over parts of the particles.
    pub spread: [f64; 3],
    /// The errors at the trial's points where all other bits of the word are fraction bits too.
    pub finest: (Format, [Deviation; 3]),
    /// Bytes of a particle.
    pub bytes: u32,
    /// Instructions of a pair, where they were counted.
    pub instructions: Option<Instructions>,
}

/// The numbers of a format at every particle, and the truth.
struct Whole {
    measured: Measured,
    truth: Measured,
}

/// Measures a format at every particle, piece by piece; `None` where it misses the goals by so much that it is not worth while to
/// go on, which `is_hopeless` tells of a piece.
fn whole<const D: usize>(
    set: &Set<D>,
    prepared: &Prepared<D>,
    format: Format,
    is_hopeless: impl Fn(&[Deviation; 3]) -> bool,
) -> Result<Option<Whole>, StudyError> {
    let points = spread(set.positions.len(), set.positions.len());
    let mut all = Whole { measured: Measured::default(), truth: Measured::default() };
    for some in points.chunks(PIECE * PIECES) {
        let pieces = parallel::map(some.chunks(PIECE), |_, points| piece(set, prepared, format, points));
        for piece in pieces {
            let Some(mut piece) = piece? else { return Ok(None) };
            if is_hopeless(&piece.errors()) {
                return Ok(None);
            }
            all.measured.append(&mut piece.measured);
            all.truth.append(&mut piece.truth);
        }
    }
    Ok(Some(all))
}

/// Measures a format at some particles; `None` where it refuses them.
fn piece<const D: usize>(
    set: &Set<D>,
    prepared: &Prepared<D>,
    format: Format,
    points: &[usize],
) -> Result<Option<Whole>, StudyError> {
    let patch = set.around(points)?;
    let (kernel, units) = (prepared.kernel, &prepared.units);
    let measured = NumberFormat::Fixed(format).measure(&patch, kernel, units).ok();
    let truth = measure::<f64, D>(&patch, kernel, units).ok();
    Ok(measured.zip(truth).map(|(measured, truth)| Whole { measured, truth }))
}

impl Whole {
    fn errors(&self) -> [Deviation; 3] {
        deviations(&self.measured, &self.truth, &scales(&self.truth))
    }

    /// The standard deviation over parts of the points of the largest error in each.
    fn spread(&self) -> [f64; 3] {
        let scales = scales(&self.truth);
        [Quantity::Density, Quantity::Interpolation, Quantity::Gradient].map(|quantity| {
            let largest = |part: usize| {
                let scale = scales[quantity.index()];
                let is_wanted = |number: usize| number % PARTS == part;
                self.measured.deviation_of(&self.truth, quantity, scale, is_wanted).largest
            };
            let errors: Vec<f64> = (0..PARTS).map(largest).collect();
            let mean = errors.iter().sum::<f64>() / PARTS as f64;
            (errors.iter().map(|error| (error - mean).powi(2)).sum::<f64>() / (PARTS - 1) as f64).sqrt()
        })
    }
}

/// The kernels and fraction bits that meet the goals at the trial's points, the cheapest first.
fn candidates<'a, const D: usize>(
    kernels: &'a [Prepared<D>],
    rows: &[Row],
    request: &Request,
) -> Vec<(&'a Prepared<D>, Format)> {
    let mut found: Vec<(u32, f64, u32, &Prepared<D>, Format)> = Vec::new();
    for prepared in kernels {
        let formats = rows.iter().filter(|row| row.kernel == prepared.kernel);
        let meeting = formats.filter(|row| row.shortfall(&request.goals) <= 1.0);
        let least = meeting.filter_map(|row| match row.format {
            NumberFormat::Fixed(format) if is_first_mode(format, request) => Some((format, row)),
            _ => None,
        });
        let Some((format, row)) = least.min_by_key(|(format, _)| format.bits()) else { continue };
        let Some(word) = costs::word(format.bits()) else { continue };
        let instructions = row.instructions.map_or(f64::MAX, |counted| counted.density + counted.gradient);
        found.push((word, instructions, format.bits(), prepared, format));
    }
    found.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    found.into_iter().map(|(.., prepared, format)| (prepared, format)).collect()
}

/// Whether a format rounds and overflows as a recommendation does.
pub(super) fn is_first_mode(format: Format, request: &Request) -> bool {
    request.roundings.first() == Some(&format.rounding())
        && request.overflows.first() == Some(&format.overflow())
}

/// The recommendation; none where no format of the bits that were allowed meets the goals.
pub(super) fn recommend<'a, const D: usize>(
    set: &Set<D>,
    patch: &Patch<D>,
    kernels: &'a [Prepared<D>],
    rows: &[Row],
    request: &Request,
) -> Result<Option<(&'a Prepared<D>, Recommendation)>, StudyError> {
    for (prepared, format) in candidates(kernels, rows, request) {
        if let Some((fewest, found)) = fewest(set, prepared, format, request)? {
            return Ok(Some((prepared, describe(set, patch, prepared, fewest, &found, request))));
        }
    }
    Ok(None)
}

/// A format of so many fraction bits with the modes of another; its integer bits are the rest of the narrowest word.
fn in_word(integer_bits: u32, fraction_bits: u32, modes: Format) -> Option<Format> {
    let word = costs::word(integer_bits + fraction_bits)?;
    let format = Format::new(word - fraction_bits, fraction_bits).ok()?;
    Some(format.with_rounding(modes.rounding()).with_overflow(modes.overflow()))
}

/// The fewest fraction bits that meet the goals at every particle, beginning with those that meet them at some.
fn fewest<const D: usize>(
    set: &Set<D>,
    prepared: &Prepared<D>,
    first: Format,
    request: &Request,
) -> Result<Option<(Format, Whole)>, StudyError> {
    let integer = first.integer_bits();
    let is_good = |errors: &[Deviation; 3]| shortfall(errors, &request.goals) <= 1.0;
    // of a piece: all of them may have a larger scale, but not twice as large for most sets
    let is_hopeless = |errors: &[Deviation; 3]| shortfall(errors, &request.goals) > 4.0;
    let measured = |fraction: u32| -> Result<Option<Whole>, StudyError> {
        let is_allowed = integer + fraction <= *request.bits.end();
        let Some(format) = in_word(integer, fraction, first).filter(|_| is_allowed) else { return Ok(None) };
        Ok(whole(set, prepared, format, is_hopeless)?.filter(|found| is_good(&found.errors())))
    };
    let mut best = None;
    let mut fraction = first.fraction_bits();
    // upwards until the goals are met, then downwards as long as they are
    while best.is_none() && integer + fraction <= *request.bits.end() {
        best = measured(fraction)?.map(|found| (fraction, found));
        fraction += 1;
    }
    while let Some((fraction, _)) = best.as_ref().filter(|(fraction, _)| *fraction > LEAST_FRACTION) {
        let fraction = fraction - 1;
        match measured(fraction)? {
            Some(found) => best = Some((fraction, found)),
            None => break,
        }
    }
    let with = |fraction: u32| {
        let format = Format::new(integer, fraction).ok()?;
        Some(format.with_rounding(first.rounding()).with_overflow(first.overflow()))
    };
    Ok(best.and_then(|(fraction, found)| Some((with(fraction)?, found))))
}

fn describe<const D: usize>(
    set: &Set<D>,
    patch: &Patch<D>,
    prepared: &Prepared<D>,
    fewest: Format,
    found: &Whole,
    request: &Request,
) -> Recommendation {
    let word = costs::word(fewest.bits()).unwrap_or(fewest.bits());
    let format = in_word(fewest.integer_bits(), fewest.fraction_bits(), fewest).unwrap_or(fewest);
    let finest = Format::new(fewest.integer_bits(), word - fewest.integer_bits()).unwrap_or(fewest);
    let finest = finest.with_rounding(fewest.rounding()).with_overflow(fewest.overflow());
    let finest_errors = prepared.errors(patch, NumberFormat::Fixed(finest)).unwrap_or(found.errors());
    let units = &prepared.units;
    let has_masses = set.masses.iter().any(|mass| *mass != set.masses[0]);
    let names = set.fields.iter().map(|(name, _)| name.clone());
    Recommendation {
        kernel: prepared.kernel,
        fewest,
        format,
        length: units.length,
        mass: units.mass,
        values: names.zip(units.values.iter().copied()).collect(),
        origin: units.origin.to_vec(),
        errors: found.errors(),
        spread: found.spread(),
        finest: (finest, finest_errors),
        bytes: costs::bytes(word, D, set.fields.len(), has_masses),
        instructions: Instructions::of(request.target, prepared.kernel, word),
    }
}
