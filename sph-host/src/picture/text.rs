//! Text as outlines: Ubuntu Light, and Hack for the letters that it lacks (∇).

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve};
use tiny_skia::{Path, PathBuilder};

/// The typefaces, in the order in which a letter is looked for. The bytes are compiled in, so a face that fails to parse is a
/// defect of the build and every test of a picture sees it.
static FACES: LazyLock<Vec<FontRef<'static>>> = LazyLock::new(|| {
    [epaint_default_fonts::UBUNTU_LIGHT, epaint_default_fonts::HACK_REGULAR]
        .into_iter()
        .filter_map(|bytes| FontRef::try_from_slice(bytes).ok())
        .collect()
});

/// The face and number of a letter; the first face's sign for a missing one if no face has it.
fn glyph(letter: char) -> Option<(&'static FontRef<'static>, GlyphId)> {
    let found = FACES.iter().map(|face| (face, face.glyph_id(letter))).find(|(_, glyph)| glyph.0 != 0);
    found.or_else(|| FACES.first().map(|face| (face, GlyphId(0))))
}

/// Pixels a font unit at a size, which is the height of an em.
fn scale(face: &FontRef<'_>, size: f32) -> f32 {
    size / face.units_per_em().unwrap_or(1000.0)
}

/// The width of a line of text in pixels.
pub(super) fn width(text: &str, size: f32) -> f32 {
    let advance = |(face, glyph): (&FontRef<'_>, GlyphId)| face.h_advance_unscaled(glyph) * scale(face, size);
    text.chars().filter_map(glyph).map(advance).sum()
}

/// The text and a size at which it is no wider than `most` pixels: smaller down to 60 %, then cut short.
pub(super) fn fitted(text: &str, size: f32, most: f32) -> (String, f32) {
    let size = (size * (most / width(text, size).max(1.0)).clamp(0.6, 1.0)).floor();
    if width(text, size) <= most {
        return (text.to_owned(), size);
    }
    let mut short = text.to_owned();
    while short.pop().is_some() && width(&short, size) + width("…", size) > most {}
    (short + "…", size)
}

/// The height of capitals and digits as a part of the size.
pub(super) const CAPITALS: f32 = 0.69;

/// The outline of a line of text whose base line starts at (0, 0); y points down.
pub(super) fn outline(text: &str, size: f32) -> Option<Path> {
    let mut path = PathBuilder::new();
    let mut x = 0.0;
    for (face, glyph) in text.chars().filter_map(glyph) {
        let scale = scale(face, size);
        if let Some(outline) = face.outline(glyph) {
            push_curves(&mut path, &outline.curves, |point| (x + point.x * scale, -point.y * scale));
        }
        x += face.h_advance_unscaled(glyph) * scale;
    }
    path.finish()
}

fn push_curves(
    path: &mut PathBuilder,
    curves: &[OutlineCurve],
    place: impl Fn(ab_glyph::Point) -> (f32, f32),
) {
    let mut last = None;
    for curve in curves {
        let (OutlineCurve::Line(start, _) | OutlineCurve::Quad(start, ..) | OutlineCurve::Cubic(start, ..)) =
            *curve;
        if last != Some(start) {
            let (x, y) = place(start);
            path.move_to(x, y);
        }
        let (OutlineCurve::Line(_, end) | OutlineCurve::Quad(_, _, end) | OutlineCurve::Cubic(_, _, _, end)) =
            *curve;
        let (x, y) = place(end);
        match *curve {
            OutlineCurve::Line(..) => path.line_to(x, y),
            OutlineCurve::Quad(_, control, _) => {
                let (x1, y1) = place(control);
                path.quad_to(x1, y1, x, y);
            }
            OutlineCurve::Cubic(_, first, second, _) => {
                let ((x1, y1), (x2, y2)) = (place(first), place(second));
                path.cubic_to(x1, y1, x2, y2, x, y);
            }
        }
        last = Some(end);
    }
}
