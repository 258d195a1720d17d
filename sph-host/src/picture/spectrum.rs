//! Histograms over powers of two, one a row: how large numbers are, place by place.

use super::axes::{self, Axes, LARGE, Range, SMALL};
use super::canvas::{Anchor, Area, Canvas, FAINT, INK, Pen};
use super::colour::Palette;
use super::text::{fitted, width};
use super::{Image, PictureError};

/// One histogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What it is of.
    pub label: String,
    /// How many numbers have a magnitude of 2^e to 2^(e+1), by e.
    pub counts: Vec<(i32, u64)>,
}

/// Histograms one below the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrum {
    /// The line at the top.
    pub title: String,
    /// The histograms from top to bottom.
    pub rows: Vec<Row>,
    /// Exponents at which a line with a word stands: the ends of a format.
    pub marks: Vec<(f64, String)>,
}

const MARGIN: f32 = 16.0;
const TITLE: f32 = 44.0;
/// Height of a row, and of the bar in it.
const ROW: f32 = 26.0;
const BAR: f32 = 18.0;
/// Width of the histograms.
const ACROSS: f32 = 720.0;

/// Draws the histograms: each bar is as dark as the part of the row's numbers that it stands for, on a scale of its logarithm.
///
/// # Errors
/// [`PictureError::Empty`] without rows, [`PictureError::TooLarge`] with too many.
pub fn draw(spectrum: &Spectrum) -> Result<Image, PictureError> {
    let exponents = spectrum.rows.iter().flat_map(|row| row.counts.iter().map(|(exponent, _)| *exponent));
    let (Some(least), Some(most)) = (exponents.clone().min(), exponents.max()) else {
        return Err(PictureError::Empty);
    };
    let marks = spectrum.marks.iter().map(|(exponent, _)| *exponent);
    let lower = marks.clone().fold(f64::from(least), f64::min) - 1.0;
    let upper = marks.fold(f64::from(most + 1), f64::max) + 1.0;
    let labels = spectrum.rows.iter().map(|row| width(&row.label, SMALL)).fold(0.0, f32::max);
    let left = MARGIN + labels + MARGIN;
    let top = MARGIN + TITLE + ROW;
    let area = Area { left, top, width: ACROSS, height: ROW * spectrum.rows.len() as f32 };
    let height = area.bottom() + axes::below() + MARGIN;
    let mut canvas = Canvas::new((area.right() + 2.0 * MARGIN).ceil() as u32, height.ceil() as u32)?;
    let (title, size) = fitted(&spectrum.title, LARGE, area.right());
    canvas.text(&title, ((area.right() + MARGIN) / 2.0, MARGIN + TITLE / 2.0), size, Anchor::Middle);
    let frame = Axes { area, x: Range::Linear([lower, upper]), y: Range::Linear([0.0, 1.0]) };
    for (number, row) in spectrum.rows.iter().enumerate() {
        draw_row(&mut canvas, &frame, row, area.top + ROW * number as f32);
    }
    for (exponent, word) in &spectrum.marks {
        let (x, _) = frame.place([*exponent, 0.0]);
        canvas.line(&[(x, area.top), (x, area.bottom())], Pen { dashed: true, ..Pen::new(INK, 1.6) });
        canvas.text(word, (x, area.top - ROW / 2.0), SMALL, Anchor::Middle);
    }
    frame.draw_across(&mut canvas, "binary exponent of the magnitude");
    Ok(canvas.into_image())
}

fn draw_row(canvas: &mut Canvas, frame: &Axes, row: &Row, top: f32) {
    let area = frame.area;
    let middle = top + ROW / 2.0;
    canvas.line(&[(area.left, middle), (area.right(), middle)], Pen::new(FAINT, 1.0));
    canvas.text(&row.label, (area.left - MARGIN, middle), SMALL, Anchor::End);
    let all: u64 = row.counts.iter().map(|(_, count)| count).sum();
    for &(exponent, count) in &row.counts {
        let (from, _) = frame.place([exponent.into(), 0.0]);
        let (to, _) = frame.place([f64::from(exponent + 1), 0.0]);
        // from one number of a million, faint, to all of them
        let part = 1.0 + (count as f64 / all.max(1) as f64).log10() / 6.0;
        let colour = Palette::Viridis.colour(1.0 - part.clamp(0.0, 1.0));
        canvas.fill_area(Area { left: from, top: middle - BAR / 2.0, width: to - from, height: BAR }, colour);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_where_the_exponents_are() {
        let row = Row { label: String::from("a"), counts: vec![(-2, 5), (1, 1_000_000)] };
        let image = draw(&Spectrum { rows: vec![row], ..Spectrum::default() }).unwrap();
        let coloured = image.rgb.chunks(3).filter(|pixel| pixel.iter().max() != pixel.iter().min()).count();
        // two bars of one exponent of six each
        let expected = 2.0 * ACROSS / 6.0 * BAR;
        assert!((coloured as f32 / expected - 1.0).abs() < 0.1, "{coloured} {expected}");
        assert!(draw(&Spectrum::default()).is_err());
    }
}
