//! Words of `fluisim study` that stand for kernels, bits and goals.

use std::ops::RangeInclusive;

use super::parse;
use crate::kernel_choice::KernelName;
use crate::study::Quantity;

/// Kernels to choose from.
#[derive(Clone, Debug)]
pub(super) struct Kernels(pub(super) Vec<KernelName>);

/// All, or one by its name.
pub(super) fn kernels(text: &str) -> Result<Kernels, String> {
    if text == "all" {
        return Ok(Kernels(KernelName::ALL.iter().copied().filter(|kernel| !kernel.is_singular()).collect()));
    }
    let names = || KernelName::ALL.iter().map(|kernel| kernel.name()).collect::<Vec<_>>().join(", ");
    KernelName::of_name(text)
        .map(|kernel| Kernels(vec![kernel]))
        .ok_or_else(|| format!("expected all, {}", names()))
}

/// From so many bits to so many.
#[derive(Clone, Debug)]
pub(super) struct Bits(pub(super) RangeInclusive<u32>);

/// Two numbers with two dots between, or one.
pub(super) fn bits(text: &str) -> Result<Bits, String> {
    let (from, to) = text.split_once("..").unwrap_or((text, text));
    let number =
        |text: &str| text.trim_start_matches('=').parse::<u32>().ok().filter(|bits| (8..=64).contains(bits));
    match (number(from), number(to)) {
        (Some(from), Some(to)) if from <= to => Ok(Bits(from..=to)),
        _ => Err(String::from("expected 8 to 64 bits, such as 8..32")),
    }
}

/// A quantity and its error.
pub(super) fn goal(text: &str) -> Result<(Quantity, f64), String> {
    let names = || Quantity::ALL.iter().map(|quantity| quantity.name()).collect::<Vec<_>>().join(", ");
    let (name, error) = text
        .split_once('=')
        .ok_or_else(|| String::from("expected a quantity and its error, such as density=1e-3"))?;
    let quantity = Quantity::of_name(name).ok_or_else(|| format!("`{name}`: expected one of {}", names()))?;
    Ok((quantity, parse::positive(error).map_err(|expected| format!("`{error}`: {expected}"))?))
}

/// A type that reads its own name.
pub(super) fn named<V: std::str::FromStr<Err: std::fmt::Display>>(text: &str) -> Result<V, String> {
    text.parse().map_err(|error: V::Err| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_a_range_within_8_to_64() {
        for (text, range) in [("8..32", 8..=32), ("16", 16..=16), ("8..=64", 8..=64)] {
            assert_eq!(bits(text).unwrap().0, range);
        }
        for wrong in ["", "7..9", "8..65", "20..10", "x", "8..", "..9", "-8"] {
            assert!(bits(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn goals_have_a_quantity_and_an_error() {
        assert_eq!(goal("gradient=1e-2"), Ok((Quantity::Gradient, 1e-2)));
        for wrong in ["density", "density=", "density=0", "density=nan", "rho=1", "=1"] {
            assert!(goal(wrong).is_err(), "{wrong}");
        }
    }
}
