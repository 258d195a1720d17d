//! Values as colours.

use super::canvas::{NO_VALUE, Rgb};

/// A scale of colours. The first two are perceptually uniform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// Dark blue over green to yellow: a quantity.
    Viridis,
    /// Black over red to yellow: a magnitude.
    Inferno,
    /// Blue over white to red, balanced about zero: a signed deviation.
    BlueRed,
}

impl Palette {
    /// The colour at 0 to 1.
    pub(super) fn colour(self, part: f64) -> Rgb {
        let part = part.clamp(0.0, 1.0);
        match self {
            Self::Viridis => colorous::VIRIDIS.eval_continuous(part).as_array(),
            Self::Inferno => colorous::INFERNO.eval_continuous(part).as_array(),
            Self::BlueRed => colorous::RED_BLUE.eval_continuous(1.0 - part).as_array(),
        }
    }
}

/// A palette over a range of values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) palette: Palette,
    /// The values of the first and the last colour; never equal.
    pub(super) range: [f64; 2],
    /// Whether there are values below and above the range.
    pub(super) beyond: [bool; 2],
    /// Whether there are points without a value.
    pub(super) missing: bool,
}

/// The parts of the values at which a range ends that a few outliers would stretch.
const QUANTILES: [f64; 2] = [0.005, 0.995];
/// How much wider than the range between the quantiles the full range must be for that.
const STRETCHED: f64 = 1.5;

impl Scale {
    /// The scale that suits the values: from the least to the greatest, or between the quantiles if outliers stretch that.
    pub(super) fn of(values: &[f64], palette: Palette) -> Self {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let (Some(&least), Some(&greatest)) = (sorted.first(), sorted.last()) else {
            return Self { palette, range: [0.0, 1.0], beyond: [false; 2], missing: !values.is_empty() };
        };
        let at = |part: f64| sorted[((sorted.len() - 1) as f64 * part).round() as usize];
        let robust = QUANTILES.map(at);
        let width = robust[1] - robust[0];
        let range =
            if width > 0.0 && greatest - least > STRETCHED * width { robust } else { [least, greatest] };
        let missing = sorted.len() < values.len();
        Self::over(range, palette, [least, greatest], missing)
    }

    /// A scale over a range that is given, knowing the least and the greatest value.
    pub(super) fn over(range: [f64; 2], palette: Palette, extremes: [f64; 2], missing: bool) -> Self {
        let mut range = widened(range);
        if palette == Palette::BlueRed {
            let end = range[0].abs().max(range[1].abs());
            range = [-end, end];
        }
        Self { palette, range, beyond: [extremes[0] < range[0], extremes[1] > range[1]], missing }
    }

    /// The colour of a value; grey where there is none.
    pub(super) fn colour(&self, value: f64) -> Rgb {
        if value.is_finite() { self.palette.colour(self.part(value)) } else { NO_VALUE }
    }

    /// Where in the range a value is, 0 to 1.
    pub(super) fn part(&self, value: f64) -> f64 {
        // Halves both, because the width of the range may overflow.
        let [lower, upper] = self.range;
        ((value / 2.0 - lower / 2.0) / (upper / 2.0 - lower / 2.0)).clamp(0.0, 1.0)
    }
}

/// A range that is no wider than rounding errors, widened so that its value stands in the middle.
fn widened([lower, upper]: [f64; 2]) -> [f64; 2] {
    let size = lower.abs().max(upper.abs());
    if upper - lower > 1e-12 * size {
        [lower, upper]
    } else if size == 0.0 {
        [-1.0, 1.0]
    } else {
        [lower - 0.05 * size, upper + 0.05 * size]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_stands_in_the_middle() {
        for value in [0.0, 1000.0, -3e-9] {
            let scale = Scale::of(&[value; 9], Palette::Viridis);
            assert!((scale.part(value) - 0.5).abs() < 1e-9, "{scale:?}");
            assert!(scale.range[0] < scale.range[1]);
        }
    }

    #[test]
    fn outliers_do_not_stretch_the_range() {
        let mut values: Vec<f64> = (0..1000).map(f64::from).collect();
        let full = Scale::of(&values, Palette::Viridis);
        assert_eq!((full.range, full.beyond), ([0.0, 999.0], [false, false]));
        values[500] = 1e9;
        let robust = Scale::of(&values, Palette::Viridis);
        assert!(robust.range[1] < 1000.0);
        assert_eq!(robust.beyond, [true, true]);
    }

    #[test]
    fn no_value_is_grey_and_nothing_at_all_is_a_range_too() {
        let scale = Scale::of(&[f64::NAN; 3], Palette::Inferno);
        assert!(scale.missing);
        assert_eq!(scale.colour(f64::NAN), NO_VALUE);
        assert_eq!(scale.range, [0.0, 1.0]);
    }

    #[test]
    fn a_balanced_palette_is_white_at_zero() {
        let scale = Scale::of(&[-1.0, 0.0, 4.0], Palette::BlueRed);
        assert_eq!(scale.range, [-4.0, 4.0]);
        assert!(scale.colour(0.0).iter().all(|&part| part > 235));
    }
}
