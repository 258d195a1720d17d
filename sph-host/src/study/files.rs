//! A study as files: rows for a spreadsheet, everything for a program.

use std::io::{self, Write};

use serde_json::{Map, Value, json};

use super::formats::NumberFormat;
use super::recommend::Recommendation;
use super::report::type_name;
use super::request::Quantity;
use super::{Insight, Row, Study};

/// The columns of `study.csv`.
const HEADER: [&str; 18] = [
    "kernel",
    "format",
    "quantity",
    "bits",
    "integer_bits",
    "fraction_bits",
    "rounding",
    "overflow",
    "max_error",
    "rms_error",
    "bias",
    "bound",
    "saturations",
    "consequential_saturations",
    "bytes_per_particle",
    "density_instructions_per_pair",
    "gradient_instructions_per_pair",
    "refusal",
];

/// A finite number; null for others.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { Value::Null }
}

/// By the names of the quantities that were asked for.
fn by_quantity(study: &Study, of: impl Fn(Quantity) -> Value) -> Value {
    let pairs = study.goals.iter().map(|&(quantity, _)| (quantity.name().to_owned(), of(quantity)));
    Value::Object(pairs.collect::<Map<_, _>>())
}

/// Name, bits and modes of a format.
fn format_json(format: NumberFormat) -> Map<String, Value> {
    let mut map = Map::new();
    map.insert("scalar".into(), json!(format.to_string()));
    map.insert("bits".into(), json!(format.bits()));
    if let NumberFormat::Fixed(format) = format {
        map.insert("integer_bits".into(), json!(format.integer_bits()));
        map.insert("fraction_bits".into(), json!(format.fraction_bits()));
        map.insert("rounding".into(), json!(format.rounding().to_string()));
        map.insert("overflow".into(), json!(format.overflow().to_string()));
    }
    map
}

impl Row {
    fn json(&self, study: &Study) -> Value {
        let mut map = format_json(self.format);
        map.insert("kernel".into(), json!(self.kernel.name()));
        match &self.errors {
            Ok(errors) => {
                let of = |quantity: Quantity| {
                    let error = errors[quantity.index()];
                    json!({"max": number(error.largest), "rms": number(error.rms), "bias": number(error.bias)})
                };
                map.insert("errors".into(), by_quantity(study, of));
            }
            Err(why) => {
                map.insert("refusal".into(), json!(why));
            }
        }
        if let Some(saturations) = self.saturations {
            let (consequential, harmless) = (saturations.consequential, saturations.harmless);
            map.insert("saturations".into(), json!({"consequential": consequential, "harmless": harmless}));
        }
        map.insert("bytes_per_particle".into(), json!(self.bytes));
        let counted = self
            .instructions
            .map(|counted| json!({"density": counted.density, "gradient": counted.gradient}));
        map.insert("instructions_per_pair".into(), counted.unwrap_or_else(|| json!("not counted")));
        Value::Object(map)
    }

    /// The cells of one quantity.
    fn cells(&self, quantity: Quantity, bound: Option<f64>) -> [String; 18] {
        let (integer, fraction, rounding, overflow) = match self.format {
            NumberFormat::Fixed(format) => (
                format.integer_bits().to_string(),
                format.fraction_bits().to_string(),
                format.rounding().to_string(),
                format.overflow().to_string(),
            ),
            NumberFormat::Mini(_) => Default::default(),
        };
        let errors = self.errors.as_ref().ok().map(|errors| errors[quantity.index()]);
        let error = |of: fn(super::Deviation) -> f64| {
            errors.map_or_else(String::new, |errors| of(errors).to_string())
        };
        let count = |of: fn(super::Saturations) -> u64| {
            self.saturations.map_or_else(String::new, |all| of(all).to_string())
        };
        let instructions = |of: fn(super::Instructions) -> f64| {
            self.instructions.map_or_else(|| String::from("not counted"), |counted| of(counted).to_string())
        };
        [
            self.kernel.name().to_owned(),
            self.format.to_string(),
            quantity.name().to_owned(),
            self.format.bits().to_string(),
            integer,
            fraction,
            rounding,
            overflow,
            error(|error| error.largest),
            error(|error| error.rms),
            error(|error| error.bias),
            bound.map_or_else(String::new, |bound| bound.to_string()),
            count(|all| all.consequential + all.harmless),
            count(|all| all.consequential),
            self.bytes.to_string(),
            instructions(|counted| counted.density),
            instructions(|counted| counted.gradient),
            self.errors.as_ref().err().cloned().unwrap_or_default(),
        ]
    }
}

impl Recommendation {
    fn json(&self, study: &Study) -> Value {
        let mut map = format_json(NumberFormat::Fixed(self.format));
        let saturations = study.insight.as_ref().map(|insight| insight.log.saturations()).unwrap_or_default();
        let values: Map<String, Value> =
            self.values.iter().map(|(name, unit)| (name.clone(), json!(unit))).collect();
        let errors = |errors: &[super::Deviation; 3]| {
            by_quantity(study, |quantity| number(errors[quantity.index()].largest))
        };
        let more = json!({
            "kernel": self.kernel.name(),
            "type": type_name(self.format),
            "unit_of_length": self.length,
            "unit_of_mass": self.mass,
            "units_of_values": values,
            "origin": self.origin,
            "errors": errors(&self.errors),
            "rms_errors": by_quantity(study, |quantity| number(self.errors[quantity.index()].rms)),
            "bias": by_quantity(study, |quantity| number(self.errors[quantity.index()].bias)),
            "spread": by_quantity(study, |quantity| number(self.spread[quantity.index()])),
            "fewest": {
                "integer_bits": self.fewest.integer_bits(),
                "fraction_bits": self.fewest.fraction_bits(),
            },
            "finest": {"type": type_name(self.finest.0), "errors": errors(&self.finest.1)},
            "saturations": saturations.consequential() + saturations.harmless(),
            "consequential_saturations": saturations.consequential(),
            "bytes_per_particle": self.bytes,
            "instructions_per_pair": self.instructions.map_or_else(
                || json!("not counted"),
                |counted| json!({"density": counted.density, "gradient": counted.gradient}),
            ),
        });
        if let Value::Object(more) = more {
            map.extend(more);
        }
        Value::Object(map)
    }
}

impl Insight {
    fn json(&self, study: &Study) -> Value {
        let errors = |errors: &[super::Deviation; 3]| {
            by_quantity(study, |quantity| number(errors[quantity.index()].largest))
        };
        let plain = |errors: &[f64; 3]| by_quantity(study, |quantity| number(errors[quantity.index()]));
        let places = self.log.places().iter().map(|record| {
            json!({
                "place": record.place.to_string(),
                "column": record.place.column(),
                "count": record.count,
                "least": number(record.least),
                "largest": record.largest(),
                "bits": record.bits(),
                "vanished": record.vanished,
                "cancelled": record.cancelled,
                "saturations": record.saturated,
                "consequential_saturations": record.consequential,
                "exponents": record.exponents().collect::<Vec<_>>(),
            })
        });
        let roundings: Map<String, Value> =
            self.roundings.iter().map(|(rounding, all)| (rounding.to_string(), errors(all))).collect();
        let units = self.units.iter().map(|trial| {
            json!({
                "support": trial.support.map_or_else(|| json!("file"), |support| json!(support)),
                "scalar": trial.format.map(|format| format.to_string()),
                "errors": trial.errors.as_ref().map(errors),
            })
        });
        let blamed = self.blamed.iter().map(
            |one| json!({"place": one.place, "alone": plain(&one.alone), "without": plain(&one.without)}),
        );
        json!({
            "kernel": self.kernel.name(),
            "scalar": self.format.to_string(),
            "places": places.collect::<Vec<_>>(),
            "roundings": roundings,
            "units": units.collect::<Vec<_>>(),
            "gain_of_units": self.gain(&study.goals).map(number),
            "blame": blamed.collect::<Vec<_>>(),
            "bounds": self.bounds.as_ref().map(plain),
        })
    }
}

impl Study {
    /// The row that comes nearest to the goals.
    #[must_use]
    pub fn best(&self) -> Option<&Row> {
        let rows = self.rows.iter().filter(|row| row.errors.is_ok());
        rows.min_by(|a, b| a.shortfall(&self.goals).total_cmp(&b.shortfall(&self.goals)))
    }

    /// Writes the rows as CSV: one for each format, kernel and quantity.
    ///
    /// # Errors
    /// What `writer` reports.
    pub fn write_csv(&self, writer: impl Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(writer);
        csv.write_record(HEADER)?;
        for row in &self.rows {
            for &(quantity, _) in &self.goals {
                csv.write_record(row.cells(quantity, self.bound_of(row, quantity)))?;
            }
        }
        csv.flush()
    }

    /// The bound of a row for which there is one.
    fn bound_of(&self, row: &Row, quantity: Quantity) -> Option<f64> {
        let insight = self.insight.as_ref()?;
        let is_it = row.kernel == insight.kernel && row.format == NumberFormat::Fixed(insight.format);
        insight.bounds.filter(|_| is_it).map(|bounds| bounds[quantity.index()])
    }

    /// Everything as JSON.
    #[must_use]
    pub fn json(&self) -> Value {
        let goals: Map<String, Value> =
            self.goals.iter().map(|(quantity, goal)| (quantity.name().to_owned(), json!(goal))).collect();
        let left_out: Map<String, Value> =
            self.left_out.iter().map(|(kernel, why)| (kernel.name().to_owned(), json!(why))).collect();
        json!({
            "file": self.file,
            "particles": self.particles,
            "points": self.points,
            "dim": self.dim,
            "neighbours": self.neighbours,
            "goals": goals,
            "target": self.target.name(),
            "recommended": self.recommendation.as_ref().map(|found| found.json(self)),
            "insight": self.insight.as_ref().map(|insight| insight.json(self)),
            "left_out": left_out,
            "rows": self.rows.iter().map(|row| row.json(self)).collect::<Vec<_>>(),
        })
    }
}
