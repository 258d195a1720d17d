//! A study of a fluid in words and as JSON.

use std::fmt::{Display, Formatter};

use serde_json::{Value, json};
use sph_lab::{Format, Rounding};

use super::super::report::type_name;
use super::{FluidRow, FluidStudy, LIMIT, Spread, Usage};
use crate::sample::Significant;

impl FluidRow {
    fn name(&self) -> String {
        let Some(format) = self.format else { return String::from("f64") };
        match self.usage {
            Usage::Throughout => format!("{format} throughout, {}", format.rounding()),
            Usage::Compiled => format!("{} as compiled", type_name(format)),
        }
    }
}

impl FluidStudy {
    /// The narrowest compiled format that is as good as f64.
    #[must_use]
    pub fn recommended(&self) -> Option<Format> {
        let compiled = self.rows.iter().filter(|row| row.usage == Usage::Compiled && row.is_accepted());
        compiled.filter_map(|row| row.format).min_by_key(|format| format.bits())
    }

    /// The fewest fraction bits of a format that is as good as f64 throughout, rounded to nearest.
    #[must_use]
    pub fn fewest_fraction_bits(&self) -> Option<u32> {
        let nearest = self.rows.iter().filter(|row| row.usage == Usage::Throughout && row.is_accepted());
        let formats =
            nearest.filter_map(|row| row.format).filter(|format| format.rounding() == Rounding::Nearest);
        formats.map(Format::fraction_bits).min()
    }

    /// Everything as JSON.
    #[must_use]
    pub fn json(&self) -> Value {
        let spread = |spread: Spread| json!({"mean": spread.mean, "deviation": spread.deviation});
        let rows = self.rows.iter().map(|row| {
            json!({
                "scalar": row.format.map_or_else(|| String::from("f64"), |format| format.to_string()),
                "usage": if row.usage == Usage::Throughout { "throughout" } else { "compiled" },
                "rounding": row.format.map(|format| format.rounding().to_string()),
                "height": spread(row.height),
                "speed": spread(row.speed),
                "off_in_deviations": {"height": row.off[0], "speed": row.off[1]},
                "accepted": row.is_accepted(),
            })
        });
        json!({
            "case": self.case.name(),
            "particles": self.particles,
            "frames": self.frames,
            "starts": self.starts,
            "recommended": self.recommended().map(|format| json!({
                "scalar": format.to_string(),
                "type": type_name(format),
                "integer_bits": format.integer_bits(),
                "fraction_bits": format.fraction_bits(),
                "overflow": format.overflow().to_string(),
            })),
            "fewest_fraction_bits": self.fewest_fraction_bits(),
            "rows": rows.collect::<Vec<_>>(),
        })
    }
}

/// The report: a line for each format.
impl Display for FluidStudy {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { case, particles, frames, starts, .. } = self;
        writeln!(f, "{case}: {particles} particles, {frames} frames, {starts} starts")?;
        writeln!(f, "{:34} {:>22} {:>22} {:>15}", "format", "height / m", "speed / (m/s)", "off by σ")?;
        for row in &self.rows {
            let spread = |spread: Spread| format!("{:.5} ± {:.5}", spread.mean, spread.deviation);
            let verdict = if row.is_accepted() { "" } else { "  rejected" };
            let [height, speed] = row.off.map(|off| format!("{:.2}", Significant(off)));
            writeln!(
                f,
                "{:34} {:>22} {:>22} {:>15}{verdict}",
                row.name(),
                spread(row.height),
                spread(row.speed),
                format!("{height}, {speed}")
            )?;
        }
        match self.fewest_fraction_bits() {
            Some(bits) => {
                writeln!(f, "places, speeds and weights need {bits} fraction bits; a compiled fluid has 14")?
            }
            None => writeln!(f, "no number of fraction bits that was tried is as good as f64")?,
        }
        match self.recommended() {
            Some(format) => writeln!(f, "recommended   {}", type_name(format)),
            None => writeln!(f, "recommended   none: no compiled format is within {LIMIT} σ of f64"),
        }
    }
}
