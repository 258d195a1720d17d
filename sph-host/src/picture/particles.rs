//! Particles as discs coloured by a value, at equal aspect ratio: the frames of an animation.

use super::axes::{self, Axes, LARGE, MEDIUM, Range};
use super::canvas::{Anchor, Area, Canvas};
use super::colour::{Palette, Scale};
use super::text::fitted;
use super::{Image, PictureError, check_range, colour_bar};

/// What a frame shows. Frames that agree in everything but `title`, `positions` and `values` have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame<'a> {
    /// The line at the top, e.g. the time.
    pub title: &'a str,
    /// The places of the particles; one that is not finite or not in the box is not shown.
    pub positions: &'a [[f64; 2]],
    /// One value a particle; NaN is grey.
    pub values: &'a [f64],
    /// What the values are: the title of the colour bar.
    pub value_title: &'a str,
    /// The range of the colours. It is given so that colours mean the same in all frames.
    pub range: [f64; 2],
    /// The colours.
    pub palette: Palette,
    /// The lower left corner of the box shown.
    pub lower: [f64; 2],
    /// The upper right corner.
    pub upper: [f64; 2],
    /// The radius of a particle, in units of the box.
    pub radius: f64,
    /// Pixels across the picture, 300 at least.
    pub width: u32,
}

const MARGIN: f32 = 16.0;
const TITLE: f32 = 84.0;
/// Height over width at most.
const TALLEST: f32 = 1.2;

/// Draws a frame.
///
/// # Errors
///
/// [`PictureError::Length`] where values and positions differ in number, [`PictureError::Range`] for a box or a range of
/// values that is not finite, [`PictureError::TooLarge`] for too large a width.
pub fn draw(frame: &Frame) -> Result<Image, PictureError> {
    if frame.values.len() != frame.positions.len() {
        let what = frame.value_title.to_owned();
        return Err(PictureError::Length { what, got: frame.values.len(), expected: frame.positions.len() });
    }
    let [x, y] = [0, 1].map(|axis| [frame.lower[axis], frame.upper[axis]]);
    check_range("x", x)?;
    check_range("y", y)?;
    let [low, high] = frame.range;
    if !(high - low).is_finite() || low > high {
        return Err(PictureError::Range {
            what: frame.value_title.to_owned(),
            lower: low.to_string(),
            upper: high.to_string(),
        });
    }
    // Always with triangles, so that the bar looks the same in all frames.
    let mut scale = Scale::over(frame.range, frame.palette, frame.range, false);
    scale.beyond = [true; 2];
    let (area, height) = layout(frame, &scale);
    let mut canvas = Canvas::new(frame.width.max(300), height)?;
    let axes = Axes { area, x: Range::Linear(x), y: Range::Linear(y) };
    canvas.clip_to(area);
    let radius = (frame.radius / (x[1] - x[0]) * f64::from(area.width)).clamp(0.6, 1e3) as f32;
    for (&position, &value) in frame.positions.iter().zip(frame.values) {
        if position.iter().all(|part| part.is_finite()) {
            let (x, y) = axes.place(position);
            canvas.circle(x, y, radius, scale.colour(value));
        }
    }
    canvas.unclip();
    axes.draw(&mut canvas, "x", "y");
    colour_bar::draw(&mut canvas, &scale, area);
    let (title, size) = fitted(frame.title, LARGE, area.width.max(200.0));
    canvas.text(&title, (area.middle().0, MARGIN + LARGE / 2.0), size, Anchor::Middle);
    let bar_top = area.middle().1 - colour_bar::bar_height(area.height) / 2.0;
    let right = canvas_right(frame);
    canvas.text(frame.value_title, (right, bar_top - MEDIUM), MEDIUM, Anchor::End);
    Ok(canvas.into_image())
}

fn canvas_right(frame: &Frame) -> f32 {
    frame.width.max(300) as f32 - MARGIN
}

/// The particles' area, and the height of the picture.
fn layout(frame: &Frame, scale: &Scale) -> (Area, u32) {
    let across = frame.width.max(300) as f32;
    let highest = TALLEST * across;
    let left = MARGIN + axes::left_of(Range::Linear([frame.lower[1], frame.upper[1]]), highest);
    let right = MARGIN + colour_bar::right_of(scale, highest);
    let free = (across - left - right).max(50.0);
    let aspect = ((frame.upper[1] - frame.lower[1]) / (frame.upper[0] - frame.lower[0])) as f32;
    let width = free.min(highest / aspect).max(8.0).round();
    let height = (width * aspect).clamp(8.0, highest).round();
    let outside = ((colour_bar::bar_height(height) - height) / 2.0).ceil();
    let area = Area { left: (left + (free - width) / 2.0).round(), top: TITLE + outside, width, height };
    (area, (area.bottom() + axes::below().max(outside) + MARGIN).ceil() as u32)
}
