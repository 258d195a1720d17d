//! What an HDF5 file says of its units: told, not applied.

use super::hdf5_arrays::Stored;
use hdf5_pure::{AttrValue, File};
use std::collections::HashMap;

/// How programs call the factor from a dataset's numbers to centimetres, grams and seconds.
const FACTORS: [&str; 3] =
    ["CGSConversionFactor", "Conversion factor to CGS (not including cosmological corrections)", "to_cgs"];

/// How they call the power of the scale factor that belongs to it.
const EXPONENTS: [&str; 3] = ["a-scale exponent", "aexp-scale-exponent", "a_scaling"];

/// The datasets whose factors are told, and the unit that these lead to.
const KNOWN: [(&str, &str); 12] = [
    ("Coordinates", "cm"),
    ("Masses", "g"),
    ("Mass", "g"),
    ("Density", "g/cm³"),
    ("Densities", "g/cm³"),
    ("SmoothingLength", "cm"),
    ("SmoothingLengths", "cm"),
    ("Velocity", "cm/s"),
    ("Velocities", "cm/s"),
    ("InternalEnergy", "erg/g"),
    ("InternalEnergies", "erg/g"),
    ("Pressures", "dyn/cm²"),
];

/// The groups whose attributes say the units of the whole file.
const PLACES: [&str; 3] = ["Units", "Parameters", "Header"];

/// Attributes there: how SWIFT and Gadget call them, what they are of, and the unit.
const WHOLE: [(&str, &str, &str, &str); 4] = [
    ("Unit length in cgs (U_L)", "UnitLength_in_cm", "length", "cm"),
    ("Unit mass in cgs (U_M)", "UnitMass_in_g", "mass", "g"),
    ("Unit time in cgs (U_t)", "UnitTime_in_s", "time", "s"),
    ("Unit velocity in cgs", "UnitVelocity_in_cm_per_s", "velocity", "cm/s"),
];

/// At most one line: the factors of the datasets, or else the units of the file.
pub(super) fn notes(file: &File, datasets: &[Stored]) -> Vec<String> {
    let mut told: Vec<String> = datasets.iter().filter_map(of_dataset).collect();
    if told.is_empty() {
        told =
            PLACES.iter().map(|place| of_file(file, place)).find(|told| !told.is_empty()).unwrap_or_default();
    }
    if told.is_empty() {
        return Vec::new();
    }
    vec![format!("units: {} (from the file, not applied)", told.join(", "))]
}

/// Such as "Coordinates × 3.08567758e24 cm".
fn of_dataset(dataset: &Stored) -> Option<String> {
    let (_, unit) = KNOWN.iter().find(|(name, _)| *name == dataset.name)?;
    // Gadget writes a factor of 0 where it knows none.
    let factor = FACTORS.iter().find_map(|name| dataset.attribute(name)).filter(|&factor| factor != 0.0)?;
    let exponent = EXPONENTS.iter().find_map(|name| dataset.attribute(name)).filter(|&power| power != 0.0);
    let scale = exponent.map(|power| format!(" a^{power}")).unwrap_or_default();
    Some(format!("{} × {} {unit}{scale}", dataset.name, shown(factor)))
}

/// Such as "length 3.08567758e24 cm".
fn of_file(file: &File, place: &str) -> Vec<String> {
    let attributes: HashMap<String, AttrValue> =
        file.group(place).and_then(|group| group.attrs()).unwrap_or_default();
    let told = WHOLE.iter().filter_map(|(swift, gadget, what, unit)| {
        let value = attributes.get(*swift).or_else(|| attributes.get(*gadget))?;
        let value = *attribute_numbers(value)?.first()?;
        Some(format!("{what} {} {unit}", shown(value)))
    });
    told.collect()
}

/// A factor with an exponent where it is very large or small.
fn shown(factor: f64) -> String {
    if (1e-3..1e6).contains(&factor.abs()) { factor.to_string() } else { format!("{factor:e}") }
}

/// The numbers of an attribute, one or more; none of text.
pub(super) fn attribute_numbers(value: &AttrValue) -> Option<Vec<f64>> {
    macro_rules! each {
        ($values:expr) => {
            $values.iter().map(|&value| f64::from(value)).collect()
        };
    }
    Some(match value {
        AttrValue::F64(value) => vec![*value],
        AttrValue::F64Array(values) => values.clone(),
        AttrValue::F32(value) => vec![f64::from(*value)],
        AttrValue::F32Array(values) => each!(values),
        AttrValue::I8(value) => vec![f64::from(*value)],
        AttrValue::I8Array(values) => each!(values),
        AttrValue::U8(value) => vec![f64::from(*value)],
        AttrValue::U8Array(values) => each!(values),
        AttrValue::I16(value) => vec![f64::from(*value)],
        AttrValue::U16(value) => vec![f64::from(*value)],
        AttrValue::I32(value) => vec![f64::from(*value)],
        AttrValue::I32Array(values) => each!(values),
        AttrValue::U32(value) => vec![f64::from(*value)],
        AttrValue::U32Array(values) => each!(values),
        AttrValue::I64(value) => vec![*value as f64],
        AttrValue::I64Array(values) => values.iter().map(|&value| value as f64).collect(),
        AttrValue::U64(value) => vec![*value as f64],
        AttrValue::U64Array(values) => values.iter().map(|&value| value as f64).collect(),
        _ => return None,
    })
}
