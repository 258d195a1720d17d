//! Arrows over a panel: thinned, centred on their cells, white with a dark edge so that they show on any colour.

use super::canvas::{Area, Canvas, INK, Pen};

/// Arrows along the longer side at most.
const ALONG: f32 = 24.0;
/// An arrow shorter than this many pixels is left out.
const SHORTEST: f32 = 3.5;

/// Draws vectors given a cell; one of length `longest` reaches from one arrow's place to the next.
pub(super) fn draw(
    canvas: &mut Canvas,
    vectors: &[Vec<f64>; 2],
    [nx, ny]: [usize; 2],
    area: Area,
    longest: f64,
) {
    let apart = area.width.max(area.height) / ALONG;
    let arrows = |length: f32, cells: usize| ((length / apart).round() as usize).clamp(1, cells);
    let (across, upwards) = (arrows(area.width, nx), arrows(area.height, ny));
    let room = 0.96 * (area.width / across as f32).min(area.height / upwards as f32).min(1.6 * apart);
    // Returns the cell nearest to the middle of the cells that share one arrow.
    let cell = |index: usize, arrows: usize, cells: usize| (2 * index + 1) * cells / (2 * arrows);
    for row in (0..upwards).map(|index| cell(index, upwards, ny)) {
        for column in (0..across).map(|index| cell(index, across, nx)) {
            let [u, v] = [0, 1].map(|axis| vectors[axis][row * nx + column] / longest);
            let size = u.hypot(v);
            let length = room * size.min(1.0) as f32;
            if length >= SHORTEST {
                let x = area.left + (column as f32 + 0.5) / nx as f32 * area.width;
                let y = area.bottom() - (row as f32 + 0.5) / ny as f32 * area.height;
                arrow(canvas, (x, y), ((u / size) as f32, -(v / size) as f32), length);
            }
        }
    }
}

/// One arrow about (x, y) in the direction of the unit vector.
fn arrow(canvas: &mut Canvas, (x, y): (f32, f32), (along_x, along_y): (f32, f32), length: f32) {
    let head = (0.45 * length).min(11.0);
    let (half_head, half_shaft) = (0.52 * head, (0.06 * length).clamp(0.5, 1.3));
    let place = |along: f32, aside: f32| {
        (x + along * along_x - aside * along_y, y + along * along_y + aside * along_x)
    };
    let (tail, neck, tip) = (-length / 2.0, length / 2.0 - head, length / 2.0);
    let corners = [
        place(tail, half_shaft),
        place(neck, half_shaft),
        place(neck, half_head),
        place(tip, 0.0),
        place(neck, -half_head),
        place(neck, -half_shaft),
        place(tail, -half_shaft),
    ];
    canvas.polygon(&corners, [255; 3], Some(Pen::new(INK, 1.8)));
}
