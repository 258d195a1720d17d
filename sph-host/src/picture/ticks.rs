//! Where the ticks of an axis stand, and what is written at them.

/// A tick: its value and its label.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

/// At most `most` ticks (but two at least) at multiples of 1, 2 or 5 times a power of ten within a range.
pub(super) fn ticks([lower, upper]: [f64; 2], most: usize) -> Vec<Tick> {
    let span = upper - lower;
    let rough = span / most.max(1) as f64;
    let power = 10_f64.powf(rough.log10().floor());
    // The first tick as a multiple of the step, and how many there are; an end that is a tick but for rounding counts.
    let place = |step: f64| {
        let first = (lower / step - 1e-9).ceil();
        (first, (upper / step + 1e-9).floor() - first + 1.0)
    };
    let steps = [1.0, 2.0, 5.0, 10.0, 20.0].map(|factor| factor * power);
    let step = steps.into_iter().find(|&step| place(step).1 <= most.max(2) as f64).unwrap_or(span);
    let (first, count) = place(step);
    let count = count.clamp(0.0, 100.0) as usize;
    let values = (0..count).map(|index| (first + index as f64) * step);
    values.map(|value| Tick { value, label: label(value, step, lower.abs().max(upper.abs())) }).collect()
}

/// At most `most` ticks at powers of ten within a range of logarithms; those of [`ticks`] where the range has not two powers.
pub(super) fn decades([lower, upper]: [f64; 2], most: usize) -> Vec<Tick> {
    let (first, last) = ((lower - 1e-9).ceil() as i32, (upper + 1e-9).floor() as i32);
    let step = (last - first) / most.max(2) as i32 + 1;
    let first = first.div_euclid(step) * step + if first.rem_euclid(step) == 0 { 0 } else { step };
    let powers: Vec<i32> = (first..=last).step_by(step as usize).collect();
    if powers.len() < 2 {
        let label = |tick: Tick| Tick {
            label: format!("{:.1e}", 10_f64.powf(tick.value)).replace('-', "−"),
            ..tick
        };
        return ticks([lower, upper], most.min(4)).into_iter().map(label).collect();
    }
    powers
        .into_iter()
        .map(|power| Tick { value: power.into(), label: format!("10{}", raised(power)) })
        .collect()
}

/// A whole number in raised digits.
pub(super) fn raised(number: i32) -> String {
    let digit = |letter: char| match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    number.to_string().chars().map(digit).collect()
}

/// The value with as many places as tell it from the next tick, in exponent form where the axis is very large or small.
fn label(value: f64, step: f64, largest: f64) -> String {
    let value = if value.abs() < step * 1e-6 { 0.0 } else { value };
    let last = (step.log10() + 1e-9).floor() as i32;
    let text = if !(1e-3..1e6).contains(&largest) {
        if value == 0.0 {
            return String::from("0");
        }
        let first = value.abs().log10().floor() as i32;
        format!("{value:.*e}", (first - last).clamp(0, 16) as usize)
    } else {
        format!("{value:.*}", (-last).clamp(0, 16) as usize)
    };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: [f64; 2], most: usize) -> Vec<String> {
        ticks(range, most).into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn ticks_are_round_and_within_the_range() {
        assert_eq!(labels([0.0, 1.0], 6), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels([-1.0, 1.0], 5), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels([0.3, 97.0], 6), ["20", "40", "60", "80"]);
        assert_eq!(labels([1000.001, 1000.003], 3), ["1000.001", "1000.002", "1000.003"]);
    }

    #[test]
    fn logarithms_have_ticks_at_powers_of_ten() {
        let labels =
            |range, most| decades(range, most).into_iter().map(|tick| tick.label).collect::<Vec<_>>();
        assert_eq!(labels([-3.2, 0.1], 9), ["10⁻³", "10⁻²", "10⁻¹", "10⁰"]);
        assert_eq!(labels([-30.0, 12.0], 5), ["10⁻²⁷", "10⁻¹⁸", "10⁻⁹", "10⁰", "10⁹"]);
        assert!(labels([-2.1, -1.4], 9).len() > 1);
        for most in 2..9 {
            assert!((2..=most).contains(&decades([-17.3, 11.9], most).len()), "{most}");
        }
    }

    #[test]
    fn very_large_and_small_numbers_are_written_with_exponents() {
        assert_eq!(labels([0.0, 3e-8], 4), ["0", "1e−8", "2e−8", "3e−8"]);
        assert_eq!(labels([9.5e9, 1.05e10], 3), ["9.5e9", "1.00e10", "1.05e10"]);
    }

    #[test]
    fn every_range_has_distinct_ticks_and_no_more_than_asked() {
        for exponent in -300..300 {
            for mantissa in [1.0, 1.3, 2.0, 4.9, 7.7] {
                let upper = mantissa * 10_f64.powi(exponent);
                for most in 2..9 {
                    let ticks = ticks([-upper / 3.0, upper], most);
                    assert!((1..=most).contains(&ticks.len()), "{upper:e} {most}: {ticks:?}");
                    assert!(ticks.windows(2).all(|pair| pair[0].label != pair[1].label), "{ticks:?}");
                    assert!(ticks.iter().all(|tick| -upper / 3.0 - upper * 1e-9 <= tick.value
                        && tick.value <= upper * (1.0 + 1e-9)));
                }
            }
        }
    }
}
