//! The key to colours: a bar with ticks, triangles where values go beyond it, a sample of grey where some are missing.

use super::axes::{Range, SMALL, widest, y_ticks};
use super::canvas::{Anchor, Area, Canvas, INK, NO_VALUE, Pen};
use super::colour::Scale;

/// Width of the bar.
const WIDTH: f32 = 24.0;
/// Between the panel and the bar, and between a flat panel and a bar that stands beside the labels of the x axis.
const APART: f32 = 22.0;
const FAR_APART: f32 = 60.0;
/// A bar is no lower than this, however flat its panel.
const LOWEST: f32 = 150.0;
/// Height of the triangles.
const TRIANGLE: f32 = 16.0;

/// Pixels that the bar may need right of a panel of at most some height.
pub(super) fn right_of(scale: &Scale, height: f32) -> f32 {
    FAR_APART + WIDTH + 12.0 + widest(&y_ticks(Range::Linear(scale.range), bar_height(height)))
}

/// Pixels between a panel of some height and its bar.
fn apart(panel: f32) -> f32 {
    if bar_height(panel) > panel { FAR_APART } else { APART }
}

/// Height of the bar beside a panel, triangles included.
pub(super) fn bar_height(panel: f32) -> f32 {
    panel.max(LOWEST)
}

/// Draws the bar right of a panel.
pub(super) fn draw(canvas: &mut Canvas, scale: &Scale, panel: Area) {
    let [below, above] = scale.beyond.map(|beyond| if beyond { TRIANGLE } else { 0.0 });
    let full = bar_height(panel.height);
    let top = (panel.middle().1 - full / 2.0).round() + above;
    let bar = Area {
        left: (panel.right() + apart(panel.height)).round(),
        top,
        width: WIDTH,
        height: (full - below - above).round(),
    };
    let rows = bar.height as u32;
    for row in 0..rows {
        let colour = scale.palette.colour(1.0 - (f64::from(row) + 0.5) / f64::from(rows));
        canvas.fill_area(Area { top: bar.top + row as f32, height: 1.0, ..bar }, colour);
    }
    let pen = Pen::new(INK, 1.0);
    let (middle, right) = (bar.left + WIDTH / 2.0, bar.right());
    for (beyond, part, from, to) in
        [(below, 0.0, bar.bottom(), bar.bottom() + below), (above, 1.0, bar.top, bar.top - above)]
    {
        if beyond > 0.0 {
            canvas.polygon(
                &[(bar.left, from), (right, from), (middle, to)],
                scale.palette.colour(part),
                Some(Pen::new(INK, 2.0)),
            );
        }
    }
    canvas.frame_area(bar, pen);
    for tick in y_ticks(Range::Linear(scale.range), full) {
        let y = (bar.bottom() - scale.part(tick.value) as f32 * bar.height).round() + 0.5;
        canvas.line(&[(right, y), (right + 5.0, y)], pen);
        canvas.text(&tick.label, (right + 10.0, y), SMALL, Anchor::Start);
    }
}

/// Draws a sample of the colour of missing values, right-aligned at a place.
pub(super) fn draw_missing(canvas: &mut Canvas, (right, y): (f32, f32)) {
    const TEXT: &str = "no value";
    canvas.text(TEXT, (right, y), SMALL, Anchor::End);
    let left = right - super::text::width(TEXT, SMALL) - 8.0 - SMALL;
    let sample = Area { left, top: y - SMALL / 2.0, width: SMALL, height: SMALL };
    canvas.fill_area(sample, NO_VALUE);
    canvas.frame_area(sample, Pen::new(INK, 1.0));
}
