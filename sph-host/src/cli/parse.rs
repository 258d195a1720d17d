//! Words that stand for numbers and lists.

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

/// The corners of a box: all lower coordinates, then all upper ones.
pub(super) fn bounds(text: &str) -> Result<Bounds, String> {
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
        if lower >= upper || !(upper - lower).is_finite() {
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
    fn lengths_are_positive() {
        assert_eq!(positive("1e-3"), Ok(1e-3));
        for wrong in ["0", "-1", "inf", "nan", "x"] {
            assert!(positive(wrong).is_err(), "{wrong}");
        }
    }
}
