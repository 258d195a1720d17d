//! Axes about an area: a frame, ticks with labels, titles.

use super::canvas::{Anchor, Area, Canvas, FAINT, INK, Pen};
use super::text;
use super::ticks::{Tick, decades, ticks};

/// Size of tick labels.
pub(super) const SMALL: f32 = 18.0;
/// Size of the titles of axes and panels.
pub(super) const MEDIUM: f32 = 21.0;
/// Size of a picture's title.
pub(super) const LARGE: f32 = 25.0;
/// Length of a tick.
const TICK: f32 = 6.0;
/// Between a tick and its label.
const GAP: f32 = 6.0;

/// The range of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    /// Of numbers.
    Linear([f64; 2]),
    /// Of numbers by their logarithm to base 10.
    Logarithmic([f64; 2]),
}

impl Range {
    /// From end to end, in what is linear on the sheet.
    pub(super) fn ends(self) -> [f64; 2] {
        let (Self::Linear(ends) | Self::Logarithmic(ends)) = self;
        ends
    }

    fn ticks(self, most: usize) -> Vec<Tick> {
        match self {
            Self::Linear(ends) => ticks(ends, most),
            Self::Logarithmic(ends) => decades(ends, most),
        }
    }
}

/// Two axes over an area of the sheet.
pub(super) struct Axes {
    pub(super) area: Area,
    pub(super) x: Range,
    pub(super) y: Range,
}

impl Axes {
    /// Returns the pixel of a point, whose parts on logarithmic axes are logarithms.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> (f32, f32) {
        let part = |value: f64, [lower, upper]: [f64; 2]| (value - lower) / (upper - lower);
        let (across, up) = (part(x, self.x.ends()), part(y, self.y.ends()));
        let Area { left, width, height, .. } = self.area;
        // Clamps to 1000 areas away: a line that leaves the area looks the same, and f32 holds the number.
        let limit = |part: f64| part.clamp(-1e3, 1e3) as f32;
        (left + limit(across) * width, self.area.bottom() - limit(up) * height)
    }

    /// Faint lines at the ticks.
    pub(super) fn draw_grid(&self, canvas: &mut Canvas) {
        let pen = Pen::new(FAINT, 1.0);
        for tick in x_ticks(self.x, self.area.width) {
            let (x, _) = self.place([tick.value, self.y.ends()[0]]);
            canvas.line(&[(x.round() + 0.5, self.area.top), (x.round() + 0.5, self.area.bottom())], pen);
        }
        for tick in y_ticks(self.y, self.area.height) {
            let (_, y) = self.place([self.x.ends()[0], tick.value]);
            canvas.line(&[(self.area.left, y.round() + 0.5), (self.area.right(), y.round() + 0.5)], pen);
        }
    }

    /// The frame, and the ticks and the title of the x axis.
    pub(super) fn draw_across(&self, canvas: &mut Canvas, x_title: &str) {
        let Area { left, top, .. } = self.area;
        let bottom = self.area.bottom();
        let pen = Pen::new(INK, 1.0);
        for Tick { value, label } in x_ticks(self.x, self.area.width) {
            let x = self.place([value, self.y.ends()[0]]).0.round() + 0.5;
            canvas.line(&[(x, bottom), (x, bottom + TICK)], pen);
            canvas.text(&label, (x, bottom + TICK + GAP + SMALL * 0.4), SMALL, Anchor::Middle);
        }
        let frame = Area {
            left: left - 0.5,
            top: top - 0.5,
            width: self.area.width + 1.0,
            height: self.area.height + 1.0,
        };
        canvas.frame_area(frame, pen);
        canvas.text(x_title, (self.area.middle().0, bottom + below() - MEDIUM * 0.6), MEDIUM, Anchor::Middle);
    }

    /// The frame, the ticks and the titles.
    pub(super) fn draw(&self, canvas: &mut Canvas, x_title: &str, y_title: &str) {
        self.draw_across(canvas, x_title);
        let left = self.area.left;
        let pen = Pen::new(INK, 1.0);
        for Tick { value, label } in y_ticks(self.y, self.area.height) {
            let y = self.place([self.x.ends()[0], value]).1.round() + 0.5;
            canvas.line(&[(left - TICK, y), (left, y)], pen);
            canvas.text(&label, (left - TICK - GAP, y), SMALL, Anchor::End);
        }
        let (_, y_middle) = self.area.middle();
        let labels = left_of(self.y, self.area.height) - MEDIUM * 1.4;
        canvas.text_upwards(y_title, (left - labels - MEDIUM * 0.7, y_middle), MEDIUM);
    }
}

/// Pixels that tick labels and title need left of an area of some height.
pub(super) fn left_of(y: Range, height: f32) -> f32 {
    widest(&y_ticks(y, height)) + TICK + 2.0 * GAP + MEDIUM * 1.4
}

/// Pixels that tick labels and title need below an area.
pub(super) fn below() -> f32 {
    TICK + GAP + SMALL + GAP + MEDIUM * 1.2
}

/// The widest label.
pub(super) fn widest(ticks: &[Tick]) -> f32 {
    ticks.iter().map(|tick| text::width(&tick.label, SMALL)).fold(0.0, f32::max)
}

/// As many ticks as can be read one below the other.
pub(super) fn y_ticks(range: Range, height: f32) -> Vec<Tick> {
    range.ticks(((height / 55.0) as usize + 1).clamp(2, 9))
}

/// As many ticks as can be read side by side.
pub(super) fn x_ticks(range: Range, width: f32) -> Vec<Tick> {
    let fitting = (2..=9).rev().map(|most| range.ticks(most)).find(|ticks| {
        let apart = width / ((ticks.len() as f32 - 1.0).max(1.0) + 0.5);
        widest(ticks) + 1.5 * SMALL < apart
    });
    fitting.unwrap_or_else(|| range.ticks(2))
}
