//! The format to take: the fewest bits that meet the goals at every particle.

use sph_lab::{Format, Rounding};

use super::costs::{self, Instructions};
use super::error::StudyError;
use super::formats::{LEAST_FRACTION, NumberFormat};
use super::measure::{Deviation, Measured, measure};
use super::request::{Quantity, Request};
use super::set::{Patch, Set, spread};
use super::sweep::{Prepared, Row, deviations, scales};
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

/// What a kernel gives in f64 at every particle.
struct Truth<'a, const D: usize> {
    set: &'a Set<D>,
    prepared: &'a Prepared<D>,
    measured: Measured,
    /// The largest of each quantity.
    scales: [f64; 3],
}

/// The numbers of every particle, measured piece by piece; `None` where a piece is refused, or `is_enough` says of it that no more
/// are wanted.
fn measured<const D: usize>(
    set: &Set<D>,
    measure: impl Fn(&Patch<D>) -> Option<Measured> + Sync,
    is_enough: impl Fn(&Measured, usize) -> bool,
) -> Result<Option<Measured>, StudyError> {
    let points = spread(set.positions.len(), set.positions.len());
    let mut all = Measured::default();
    for (number, some) in points.chunks(PIECE * PIECES).enumerate() {
        let pieces = parallel::map(some.chunks(PIECE), |_, points| Ok(measure(&set.around(points)?)));
        for (piece, found) in pieces.into_iter().enumerate() {
            let found: Result<Option<Measured>, StudyError> = found;
            let first = (number * PIECES + piece) * PIECE;
            match found? {
                Some(mut found) if !is_enough(&found, first) => all.append(&mut found),
                _ => return Ok(None),
            }
        }
    }
    Ok(Some(all))
}

impl<'a, const D: usize> Truth<'a, D> {
    fn new(set: &'a Set<D>, prepared: &'a Prepared<D>) -> Result<Option<Self>, StudyError> {
        let in_f64 = |patch: &Patch<D>| measure::<f64, D>(patch, prepared.kernel, &prepared.units).ok();
        let found = measured(set, in_f64, |_, _| false)?;
        Ok(found.map(|measured| Self { set, prepared, scales: scales(&measured), measured }))
    }

    /// The numbers of a format at every particle; `None` as soon as one misses a goal.
    fn meets(&self, format: Format, request: &Request) -> Result<Option<Measured>, StudyError> {
        let Prepared { kernel, units, .. } = self.prepared;
        let in_format = |patch: &Patch<D>| NumberFormat::Fixed(format).measure(patch, *kernel, units).ok();
        measured(self.set, in_format, |piece, first| {
            request.goals.iter().any(|&(quantity, goal)| {
                let scale = self.scales[quantity.index()];
                piece.deviation_from(&self.measured, first, quantity, scale, |_| true).largest > goal
            })
        })
    }

    fn errors(&self, found: &Measured) -> [Deviation; 3] {
        deviations(found, &self.measured, &self.scales)
    }

    /// The standard deviation over parts of the points of the largest error in each.
    fn spread(&self, found: &Measured) -> [f64; 3] {
        Quantity::each(|quantity| {
            let largest = |part: usize| {
                let scale = self.scales[quantity.index()];
                let is_wanted = |number: usize| number % PARTS == part;
                found.deviation_from(&self.measured, 0, quantity, scale, is_wanted).largest
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
            NumberFormat::Fixed(format) if is_recommendable(format, request) => Some((format, row)),
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

/// Whether a format rounds as compiled types do and overflows as the first that was asked for.
fn is_recommendable(format: Format, request: &Request) -> bool {
    format.rounding() == Rounding::Nearest && request.overflows.first() == Some(&format.overflow())
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
        let Some(truth) = Truth::new(set, prepared)? else { continue };
        if let Some((fewest, found)) = fewest(&truth, format, request)? {
            return Ok(Some((prepared, describe(&truth, patch, fewest, &found, request))));
        }
    }
    Ok(None)
}

/// A format of so many bits with the modes of another.
fn with_modes(integer_bits: u32, fraction_bits: u32, modes: Format) -> Option<Format> {
    let format = Format::new(integer_bits, fraction_bits).ok()?;
    Some(format.with_rounding(modes.rounding()).with_overflow(modes.overflow()))
}

/// A format of so many fraction bits with the modes of another; its integer bits are the rest of the narrowest word.
fn in_word(integer_bits: u32, fraction_bits: u32, modes: Format) -> Option<Format> {
    let word = costs::word(integer_bits + fraction_bits)?;
    with_modes(word - fraction_bits, fraction_bits, modes)
}

/// The fewest fraction bits that meet the goals at every particle, beginning with those that meet them at some.
fn fewest<const D: usize>(
    truth: &Truth<'_, D>,
    first: Format,
    request: &Request,
) -> Result<Option<(Format, Measured)>, StudyError> {
    let integer = first.integer_bits();
    let most = request.bits.end().saturating_sub(integer);
    let measured = |fraction: u32| match in_word(integer, fraction, first) {
        Some(format) => truth.meets(format, request),
        None => Ok(None),
    };
    let mut best = None;
    // upwards until the goals are met, then downwards as long as they are
    for fraction in first.fraction_bits()..=most {
        best = measured(fraction)?.map(|found| (fraction, found));
        if best.is_some() {
            break;
        }
    }
    while let Some((fraction, _)) = best.as_ref().filter(|(fraction, _)| *fraction > LEAST_FRACTION) {
        let fraction = fraction - 1;
        match measured(fraction)? {
            Some(found) => best = Some((fraction, found)),
            None => break,
        }
    }
    Ok(best.and_then(|(fraction, found)| Some((with_modes(integer, fraction, first)?, found))))
}

fn describe<const D: usize>(
    truth: &Truth<'_, D>,
    patch: &Patch<D>,
    fewest: Format,
    found: &Measured,
    request: &Request,
) -> Recommendation {
    let (set, prepared) = (truth.set, truth.prepared);
    let word = costs::word(fewest.bits()).unwrap_or(fewest.bits());
    let format = in_word(fewest.integer_bits(), fewest.fraction_bits(), fewest).unwrap_or(fewest);
    let finest = with_modes(fewest.integer_bits(), word - fewest.integer_bits(), fewest).unwrap_or(fewest);
    let finest_errors = prepared.errors(patch, NumberFormat::Fixed(finest)).unwrap_or(truth.errors(found));
    let units = &prepared.units;
    let names = set.fields.iter().map(|(name, _)| name.clone());
    Recommendation {
        kernel: prepared.kernel,
        fewest,
        format,
        length: units.length,
        mass: units.mass,
        values: names.zip(units.values.iter().copied()).collect(),
        origin: units.origin.to_vec(),
        errors: truth.errors(found),
        spread: truth.spread(found),
        finest: (finest, finest_errors),
        bytes: set.bytes(word),
        instructions: Instructions::of(request.target, prepared.kernel, word),
    }
}
