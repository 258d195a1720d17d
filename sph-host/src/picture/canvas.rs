//! A sheet to draw on: smooth lines, shapes and text, in pixels from the upper left corner.

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash,
    Transform,
};

use super::{Image, PictureError, text};

/// Red, green, blue.
pub(super) type Rgb = [u8; 3];

/// The colour of letters and frames.
pub(super) const INK: Rgb = [34, 34, 34];
/// The colour of grid lines.
pub(super) const FAINT: Rgb = [222, 222, 222];
/// The colour of a point without a value.
pub(super) const NO_VALUE: Rgb = [176, 176, 176];

/// More pixels than any picture of this crate needs.
const MOST_PIXELS: u64 = 100_000_000;

/// A box in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub(super) left: f32,
    pub(super) top: f32,
    pub(super) width: f32,
    pub(super) height: f32,
}

impl Area {
    pub(super) fn right(&self) -> f32 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f32 {
        self.top + self.height
    }

    pub(super) fn middle(&self) -> (f32, f32) {
        (self.left + self.width / 2.0, self.top + self.height / 2.0)
    }
}

/// Which part of a text stands at the given place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// The colour, width and dashes of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pen {
    pub(super) colour: Rgb,
    pub(super) width: f32,
    pub(super) dashed: bool,
}

impl Pen {
    pub(super) fn new(colour: Rgb, width: f32) -> Self {
        Self { colour, width, dashed: false }
    }
}

/// The sheet.
pub(super) struct Canvas {
    pixmap: Pixmap,
    clip: Option<Mask>,
}

impl Canvas {
    /// A white sheet.
    pub(super) fn new(width: u32, height: u32) -> Result<Self, PictureError> {
        let fits = u64::from(width) * u64::from(height) <= MOST_PIXELS;
        let pixmap = if fits { Pixmap::new(width, height) } else { None };
        let mut pixmap = pixmap.ok_or(PictureError::TooLarge { width, height })?;
        pixmap.fill(Color::WHITE);
        Ok(Self { pixmap, clip: None })
    }

    /// Draws only inside the area until [`Canvas::unclip`].
    pub(super) fn clip_to(&mut self, area: Area) {
        let mut mask = Mask::new(self.pixmap.width(), self.pixmap.height());
        if let (Some(mask), Some(path)) = (&mut mask, rectangle(area)) {
            mask.fill_path(&path, FillRule::Winding, true, Transform::identity());
        }
        self.clip = mask;
    }

    /// Draws on the whole sheet again.
    pub(super) fn unclip(&mut self) {
        self.clip = None;
    }

    pub(super) fn pixel(&mut self, x: u32, y: u32, [red, green, blue]: Rgb) {
        let index = (u64::from(y) * u64::from(self.pixmap.width()) + u64::from(x)) as usize * 4;
        if let Some(pixel) = self.pixmap.data_mut().get_mut(index..index + 4) {
            pixel.copy_from_slice(&[red, green, blue, 255]);
        }
    }

    pub(super) fn fill_area(&mut self, area: Area, colour: Rgb) {
        self.fill(rectangle(area), colour);
    }

    pub(super) fn frame_area(&mut self, area: Area, pen: Pen) {
        self.stroke(rectangle(area), pen);
    }

    pub(super) fn circle(&mut self, x: f32, y: f32, radius: f32, colour: Rgb) {
        self.fill(PathBuilder::from_circle(x, y, radius), colour);
    }

    pub(super) fn line(&mut self, points: &[(f32, f32)], pen: Pen) {
        self.stroke(chain(points, false), pen);
    }

    /// A filled shape, with an outline behind it if one is given.
    pub(super) fn polygon(&mut self, corners: &[(f32, f32)], colour: Rgb, outline: Option<Pen>) {
        let path = chain(corners, true);
        if let Some(pen) = outline {
            self.stroke(path.clone(), pen);
        }
        self.fill(path, colour);
    }

    /// A line of text, centred on y in the height of its capitals.
    pub(super) fn text(&mut self, text: &str, (x, y): (f32, f32), size: f32, anchor: Anchor) {
        let placed = text::outline(text, size).and_then(|path| {
            path.transform(Transform::from_translate(x - shift(text, size, anchor), y + lift(size)))
        });
        self.ink(placed);
    }

    /// A line of text that reads upwards, centred on (x, y).
    pub(super) fn text_upwards(&mut self, text: &str, (x, y): (f32, f32), size: f32) {
        let turn =
            Transform::from_row(0.0, -1.0, 1.0, 0.0, x + lift(size), y + shift(text, size, Anchor::Middle));
        self.ink(text::outline(text, size).and_then(|path| path.transform(turn)));
    }

    /// Fills letters and gives them a thin outline, because the typeface is a light one.
    fn ink(&mut self, letters: Option<Path>) {
        self.stroke(letters.clone(), Pen::new(INK, 0.35));
        self.fill(letters, INK);
    }

    fn fill(&mut self, path: Option<Path>, colour: Rgb) {
        let Some(path) = path else { return };
        self.pixmap.fill_path(
            &path,
            &paint(colour),
            FillRule::Winding,
            Transform::identity(),
            self.clip.as_ref(),
        );
    }

    fn stroke(&mut self, path: Option<Path>, pen: Pen) {
        let Some(path) = path else { return };
        let dash = if pen.dashed { StrokeDash::new(vec![9.0, 6.0], 0.0) } else { None };
        let stroke = Stroke {
            width: pen.width,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            dash,
            ..Stroke::default()
        };
        self.pixmap.stroke_path(
            &path,
            &paint(pen.colour),
            &stroke,
            Transform::identity(),
            self.clip.as_ref(),
        );
    }

    /// The finished picture.
    pub(super) fn into_image(self) -> Image {
        let (width, height) = (self.pixmap.width(), self.pixmap.height());
        let rgb =
            self.pixmap.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        Image { width, height, rgb }
    }
}

fn lift(size: f32) -> f32 {
    size * text::CAPITALS / 2.0
}

fn shift(text: &str, size: f32, anchor: Anchor) -> f32 {
    match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => text::width(text, size) / 2.0,
        Anchor::End => text::width(text, size),
    }
}

fn paint([red, green, blue]: Rgb) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, 255);
    paint
}

fn rectangle(area: Area) -> Option<Path> {
    Some(PathBuilder::from_rect(Rect::from_xywh(area.left, area.top, area.width, area.height)?))
}

fn chain(points: &[(f32, f32)], closed: bool) -> Option<Path> {
    let (&(x, y), rest) = points.split_first()?;
    let mut path = PathBuilder::new();
    path.move_to(x, y);
    for &(x, y) in rest {
        path.line_to(x, y);
    }
    if closed {
        path.close();
    }
    path.finish()
}
