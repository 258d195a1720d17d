//! A study in words.

use std::fmt::{Display, Formatter};

use sph_lab::Format;

use super::measure::name_of;
use super::recommend::Recommendation;
use super::request::Quantity;
use super::{Insight, Study};
use crate::sample::Significant;

/// A line of the report: what it is, and its words.
fn line(f: &mut Formatter<'_>, name: &str, words: &str) -> std::fmt::Result {
    writeln!(f, "{name:<13} {words}")
}

/// Words with commas between them.
fn list(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(", ")
}

/// The type of the `fixed` crate in the mode of a format: `Saturating<I3F13>`.
pub(super) fn type_name(format: Format) -> String {
    let mode = format.overflow().to_string();
    let mode = format!("{}{}", mode[..1].to_uppercase(), &mode[1..]);
    format!("{mode}<I{}F{}>", format.integer_bits(), format.fraction_bits())
}

impl Study {
    /// The errors of the quantities that were asked for.
    fn errors(&self, of: impl Fn(Quantity) -> f64) -> String {
        list(self.goals.iter().map(|&(quantity, _)| format!("{quantity} {:.2}", Significant(of(quantity)))))
    }

    fn recommended(&self, f: &mut Formatter<'_>, found: &Recommendation) -> std::fmt::Result {
        let (format, fewest) = (found.format, found.fewest);
        line(f, "recommended", &format!("{}, {}", found.kernel, type_name(format)))?;
        let fields = found.values.iter().filter(|(_, unit)| *unit != 1.0);
        let fields = fields.map(|(name, unit)| format!("; of {name} {:.6}", Significant(*unit)));
        let units = format!(
            "of length {:.6}, of mass {:.6}{}; origin {}",
            Significant(found.length),
            Significant(found.mass),
            fields.collect::<String>(),
            list(found.origin.iter().map(|x| format!("{:.6}", Significant(*x)))),
        );
        line(f, "units", &units)?;
        let errors = self.errors(|quantity| found.errors[quantity.index()].largest);
        let goals = list(self.goals.iter().map(|(quantity, goal)| format!("{quantity} {goal}")));
        line(f, "error", &format!("{errors}; goals {goals}"))?;
        let spread = self.errors(|quantity| found.spread[quantity.index()]);
        line(
            f,
            "",
            &format!(
                "the largest of {} particles; from one eighth of them to another ±({spread})",
                self.particles
            ),
        )?;
        let spare = format.bits() - fewest.bits();
        let (finest, errors) = &found.finest;
        let bits = if spare == 0 {
            format!("all {} are needed", format.bits())
        } else {
            let finest_errors = self.errors(|quantity| errors[quantity.index()].largest);
            let name = type_name(*finest);
            format!(
                "{} of {} are needed, the others keep values from saturating; as fraction bits, {name}: {finest_errors}",
                fewest.bits(),
                format.bits()
            )
        };
        line(f, "bits", &bits)?;
        let counted = found.instructions.map(|counted| {
            format!(
                "{:.0} and {:.0} instructions a pair (density, gradient)",
                counted.density, counted.gradient
            )
        });
        let counted = counted.unwrap_or_else(|| String::from("instructions a pair not counted"));
        line(f, "costs", &format!("{} bytes a particle; on {} {counted}", found.bytes, self.target))
    }

    fn paste(&self, f: &mut Formatter<'_>, found: &Recommendation) -> std::fmt::Result {
        let format = found.format;
        let name = type_name(format);
        let mode = name.split('<').next().unwrap_or_default();
        line(
            f,
            "paste",
            &format!(
                "use sph_core::scalar::fixed::{{{mode}, types::I{}F{}}};",
                format.integer_bits(),
                format.fraction_bits()
            ),
        )?;
        line(f, "", &format!("type Real = {name};"))?;
        line(
            f,
            "",
            &format!("const LENGTH: f64 = {:?}; // a coordinate is (x - ORIGIN) / LENGTH", found.length),
        )?;
        line(f, "", &format!("const ORIGIN: [f64; {}] = {:?};", found.origin.len(), found.origin))?;
        line(f, "", &format!("const MASS: f64 = {:?};", found.mass))
    }
}

impl Insight {
    fn range(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let end = 2_f64.powi(self.format.integer_bits() as i32 - 1);
        let widest = self.log.places().iter().filter(|record| record.saturated == 0);
        let widest = widest.max_by(|a, b| a.largest().total_cmp(&b.largest()));
        let widest = widest.map_or_else(String::new, |record| {
            format!(
                "widest value {:.3} of {end}: {}; ",
                Significant(record.largest()),
                name_of(&record.place)
            )
        });
        let all = self.log.saturations();
        line(
            f,
            "range",
            &format!(
                "{widest}saturations: consequential {}, harmless {}",
                all.consequential(),
                all.harmless()
            ),
        )
    }

    fn bottleneck(&self, f: &mut Formatter<'_>, study: &Study) -> std::fmt::Result {
        let Some(first) = self.blamed.first() else { return Ok(()) };
        let alone = study.errors(|quantity| first.alone[quantity.index()]);
        let without = study.errors(|quantity| first.without[quantity.index()]);
        line(f, "bottleneck", &format!("{}: rounded alone {alone}; all but it {without}", first.place))
    }
}

/// The report.
impl Display for Study {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let about = format!(
            "{}: {} particles in {} dimensions, {:.1} in reach of one; {} formats at {} of them",
            self.file,
            self.particles,
            self.dim,
            self.neighbours,
            self.rows.len(),
            self.points
        );
        line(f, "particles", &about)?;
        if let Some(found) = &self.recommendation {
            self.recommended(f, found)?;
        } else if let Some(best) = self.best() {
            let errors =
                best.errors.as_ref().map(|errors| self.errors(|quantity| errors[quantity.index()].largest));
            let goals = list(self.goals.iter().map(|(quantity, goal)| format!("{quantity} {goal}")));
            line(
                f,
                "best",
                &format!("{}, {}: {}; goals {goals}", best.kernel, best.format, errors.unwrap_or_default()),
            )?;
        }
        if let Some(insight) = &self.insight {
            insight.range(f)?;
            insight.bottleneck(f, self)?;
            if let Some(bounds) = insight.bounds {
                line(
                    f,
                    "bound",
                    &format!("{} for certain", self.errors(|quantity| bounds[quantity.index()])),
                )?;
            }
            if let Some(gain) = insight.gain(&self.goals) {
                let words = if gain.is_finite() {
                    format!(
                        "{:.2} times less error than in the file's own units, with as many bits",
                        Significant(gain)
                    )
                } else {
                    String::from("in the file's own units no format of as many bits holds the particles")
                };
                line(f, "gain of units", &words)?;
            }
        }
        for (kernel, why) in &self.left_out {
            line(f, "left out", &format!("{kernel}: {why}"))?;
        }
        self.recommendation.as_ref().map_or(Ok(()), |found| self.paste(f, found))
    }
}
