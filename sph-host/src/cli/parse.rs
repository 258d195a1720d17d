//! Words that stand for numbers and lists.

use crate::part::Part;
use crate::sample::{Only, Wanted};
use crate::scalar_choice::ScalarName;

/// A number type.
pub(super) fn scalar(text: &str) -> Result<ScalarName, String> {
    ScalarName::of_name(text).ok_or_else(|| {
        let floats: Vec<String> =
            ScalarName::FLOATS.iter().copied().chain(ScalarName::minis()).map(ScalarName::name).collect();
        let floats = floats.join(", ");
        format!(
            "expected {floats}, or fixed point such as i16f16: at least 1 integer bit, 8 to 64 bits together"
        )
    })
}

/// Cells along each axis.
#[derive(Clone, Debug)]
pub(super) struct Counts(pub(super) Vec<usize>);

/// Lower corner, then upper corner.
#[derive(Clone, Debug)]
pub(super) struct Bounds(pub(super) Vec<f64>);

/// A finite number greater than zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err(String::from("expected a finite number greater than zero")),
    }
}

/// A whole number greater than zero.
pub(super) fn count(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(value) if value > 0 => Ok(value),
        _ => Err(String::from("expected a whole number greater than zero")),
    }
}

/// One to three cell counts with commas between them.
pub(super) fn counts(text: &str) -> Result<Counts, String> {
    let counts = list(text, count)?;
    if counts.len() > 3 {
        return Err(String::from("expected one to three counts, such as 64,64"));
    }
    Ok(Counts(counts))
}

/// Which part of the points, by number or by what a launcher says.
pub(super) fn part(text: &str) -> Result<Part, String> {
    if text == "auto" { Part::of_launcher(|name| std::env::var(name).ok()) } else { text.parse() }
}

/// A column, and the values or the range that are wanted.
pub(super) fn only(text: &str) -> Result<Only, String> {
    let expected = "expected NAME=VALUE,VALUE or NAME=LOW..HIGH";
    let (name, wanted) = text.rsplit_once('=').ok_or(expected)?;
    let number = |text: &str| match text.trim().parse::<f64>() {
        Ok(value) if !value.is_nan() => Ok(value),
        _ => Err(format!("`{text}` is no number: {expected}")),
    };
    let end = |text: &str, open| if text.trim().is_empty() { Ok(open) } else { number(text) };
    let wanted = match wanted.split_once("..") {
        Some((low, high)) => Wanted::Range(end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?),
        None => Wanted::Values(list(wanted, number)?),
    };
    if let Wanted::Range(low, high) = wanted
        && low > high
    {
        return Err(format!("from {low} to {high} there is nothing: expected the lower number first"));
    }
    match name.trim() {
        "" => Err(expected.to_owned()),
        name => Ok(Only { name: name.to_owned(), wanted }),
    }
}

/// The corners of a box: all lower coordinates, then all upper ones.
pub(super) fn bounds(text: &str) -> Result<Bounds, String> {
    corners(text, false)
}

/// The corners of a periodic box, which has equal ends where it is open, but not along all axes.
pub(super) fn periodic(text: &str) -> Result<Bounds, String> {
    let Bounds(corners) = corners(text, true)?;
    let dim = corners.len() / 2;
    if (0..dim).all(|axis| corners[axis] == corners[axis + dim]) {
        return Err(String::from(
            "the box is open along every axis: expected different ends along one at least",
        ));
    }
    Ok(Bounds(corners))
}

fn corners(text: &str, may_be_open: bool) -> Result<Bounds, String> {
    let bounds = list(text, |item| match item.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("`{item}` is no finite number")),
    })?;
    let dim = bounds.len() / 2;
    if bounds.len() % 2 == 1 || dim > 3 {
        return Err(format!("expected 2, 4 or 6 numbers X0,Y0,Z0,X1,Y1,Z1, found {}", bounds.len()));
    }
    for (axis, name) in ["x", "y", "z"].iter().enumerate().take(dim) {
        let (lower, upper) = (bounds[axis], bounds[axis + dim]);
        let is_open = may_be_open && lower == upper;
        if (lower >= upper && !is_open) || !(upper - lower).is_finite() {
            return Err(format!(
                "along {name} the box goes from {lower} to {upper}: expected the lower bound first"
            ));
        }
    }
    Ok(Bounds(bounds))
}

fn list<V>(text: &str, item: impl Fn(&str) -> Result<V, String>) -> Result<Vec<V>, String> {
    text.split(',').map(|part| item(part.trim())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_one_to_three_positive_numbers() {
        assert_eq!(counts("64, 32").unwrap().0, [64, 32]);
        for wrong in ["", "0", "1,2,3,4", "-1", "1.5"] {
            assert!(counts(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn bounds_are_two_corners_in_order() {
        assert_eq!(bounds("-1,0,1,2").unwrap().0, [-1.0, 0.0, 1.0, 2.0]);
        for wrong in ["0,1,2", "1,0", "0,0,0,1", "nan,1", "-1e308,1e308", ""] {
            assert!(bounds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn periodic_boxes_may_be_open_along_some_axes() {
        assert_eq!(periodic("0,5,1,5").unwrap().0, [0.0, 5.0, 1.0, 5.0]);
        for wrong in ["0,0", "1,2,1,2", "0,1,1,0", "0,1,2"] {
            assert!(periodic(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn wanted_values_are_listed_or_in_a_range() {
        let wanted = |text: &str| only(text).unwrap();
        assert_eq!(wanted("type=1,-2").wanted, Wanted::Values(vec![1.0, -2.0]));
        assert_eq!(wanted("z=-0.5..1e3").wanted, Wanted::Range(-0.5, 1000.0));
        assert_eq!(wanted("z=..0").wanted, Wanted::Range(f64::NEG_INFINITY, 0.0));
        assert_eq!(wanted("a=b=1"), Only { name: "a=b".into(), wanted: Wanted::Values(vec![1.0]) });
        for wrong in ["type", "=1", "type=", "type=a", "type=nan", "z=2..1", "z=1..x"] {
            assert!(only(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn lengths_are_positive() {
        assert_eq!(positive("1e-3"), Ok(1e-3));
        for wrong in ["0", "-1", "inf", "nan", "x"] {
            assert!(positive(wrong).is_err(), "{wrong}");
        }
    }
}
