//! Heat maps: fields on a plane grid of cells, each with its colour bar, at equal aspect ratio, arrows on top where asked.
//!
//! A cell is shown as it is, without smoothing; where there are more cells than pixels, a pixel shows the mean of its cells.
//! Cells without a value are grey. A colour bar ends at the least and the greatest value, or, where a few outliers would
//! stretch that by half, at the quantiles 0.5 % and 99.5 %, and then has triangles at its ends.

use super::axes::{self, Axes, LARGE, MEDIUM, Range};
use super::canvas::{Area, Canvas};
use super::colour::{Palette, Scale};
use super::text::fitted;
use super::{Image, PictureError, arrows, canvas::Anchor, check_range, colour_bar};

/// A plane of cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Cells across and upwards.
    pub counts: [usize; 2],
    /// The lower left corner.
    pub lower: [f64; 2],
    /// The upper right corner.
    pub upper: [f64; 2],
    /// The names of the axes.
    pub axes: [String; 2],
}

/// One field on the plane. Cells run from left to right, then upwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// What the values are.
    pub title: String,
    /// One value a cell; NaN where there is none.
    pub values: Vec<f64>,
    /// The colours.
    pub palette: Palette,
    /// The two components of a vector a cell, to be shown as arrows whose length goes with the colour bar's upper end.
    pub arrows: Option<[Vec<f64>; 2]>,
}

/// A picture of one or more fields on the same plane.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// The line at the top.
    pub title: String,
    /// The plane of all panels.
    pub plane: Plane,
    /// Panels side by side, row by row.
    pub rows: Vec<Vec<Panel>>,
}

/// Pixels across a picture of one panel, and those of each of several side by side.
const ALONE: f32 = 1100.0;
const SIDE_BY_SIDE: f32 = 700.0;
/// Pixels upwards of a panel at most.
const HIGHEST: f32 = 860.0;
/// Pixels of the shorter side at least, where the plane is too long for equal aspect ratio.
const LOWEST: f32 = 8.0;
/// Pixels kept free at the edges.
const MARGIN: f32 = 16.0;
/// Pixels for a panel's title, and for the picture's.
const PANEL_TITLE: f32 = 46.0;
const TITLE: f32 = 44.0;

/// Draws the picture: 1100 pixels wide for one panel a row, 700 a panel for more.
///
/// # Errors
///
/// [`PictureError::Empty`] without panels, [`PictureError::Length`] where values and cells differ in number,
/// [`PictureError::Range`] for a plane without extent, [`PictureError::TooLarge`] for too many rows.
pub fn draw(map: &HeatMap) -> Result<Image, PictureError> {
    check(map)?;
    let scales =
        map.rows.iter().map(|row| row.iter().map(|panel| Scale::of(&panel.values, panel.palette)).collect());
    let scales: Vec<Vec<Scale>> = scales.collect();
    let layout = MapLayout::of(map, &scales);
    let mut canvas = Canvas::new(layout.width as u32, layout.height as u32)?;
    let (title, size) = fitted(&map.title, LARGE, layout.width - 2.0 * MARGIN);
    canvas.text(&title, (layout.width / 2.0, MARGIN + TITLE / 2.0), size, Anchor::Middle);
    for (row, panels) in map.rows.iter().enumerate() {
        for (column, panel) in panels.iter().enumerate() {
            draw_panel(&mut canvas, map, panel, &scales[row][column], layout.area(row, column));
        }
    }
    Ok(canvas.into_image())
}

fn check(map: &HeatMap) -> Result<(), PictureError> {
    let Plane { counts, lower, upper, axes } = &map.plane;
    if map.rows.iter().all(Vec::is_empty) || counts.contains(&0) {
        return Err(PictureError::Empty);
    }
    for axis in 0..2 {
        check_range(&axes[axis], [lower[axis], upper[axis]])?;
    }
    let expected = counts[0] * counts[1];
    for panel in map.rows.iter().flatten() {
        let arrows = panel.arrows.iter().flatten();
        if let Some(wrong) =
            std::iter::once(&panel.values).chain(arrows).find(|values| values.len() != expected)
        {
            return Err(PictureError::Length { what: panel.title.clone(), got: wrong.len(), expected });
        }
    }
    Ok(())
}

/// Where everything stands; all panels have the same size.
struct MapLayout {
    width: f32,
    height: f32,
    block: [f32; 2],
    /// Offset of a panel's area in its block, and its size.
    inner: Area,
}

impl MapLayout {
    fn of(map: &HeatMap, scales: &[Vec<Scale>]) -> Self {
        let Plane { lower, upper, .. } = &map.plane;
        let columns = map.rows.iter().map(Vec::len).max().unwrap_or(1) as f32;
        let across = if columns > 1.0 { SIDE_BY_SIDE } else { ALONE };
        let left = MARGIN + axes::left_of(Range::Linear([lower[1], upper[1]]), HIGHEST);
        let bars = scales.iter().flatten().map(|scale| colour_bar::right_of(scale, HIGHEST));
        let right = MARGIN + bars.fold(0.0, f32::max);
        let free = (across - left - right).max(100.0);
        let aspect = ((upper[1] - lower[1]) / (upper[0] - lower[0])) as f32;
        let width = free.min(HIGHEST / aspect).max(LOWEST).round();
        let height = (width * aspect).clamp(LOWEST, HIGHEST).round();
        // A bar that is higher than its panel sticks out above and below.
        let above = PANEL_TITLE + ((colour_bar::bar_height(height) - height) / 2.0).ceil();
        let below = axes::below().max((colour_bar::bar_height(height) - height) / 2.0).ceil() + MARGIN;
        let inner = Area { left: (left + (free - width) / 2.0).round(), top: above, width, height };
        let block = [across, above + height + below];
        let total = 2.0 * MARGIN + TITLE + block[1] * map.rows.len() as f32;
        Self { width: across * columns, height: total.ceil(), block, inner }
    }

    /// The area of a panel.
    fn area(&self, row: usize, column: usize) -> Area {
        let left = column as f32 * self.block[0] + self.inner.left;
        let top = MARGIN + TITLE + row as f32 * self.block[1] + self.inner.top;
        Area { left, top: top.round(), ..self.inner }
    }
}

fn draw_panel(canvas: &mut Canvas, map: &HeatMap, panel: &Panel, scale: &Scale, area: Area) {
    let Plane { counts, lower, upper, axes } = &map.plane;
    draw_cells(canvas, panel, scale, *counts, area);
    if let Some(vectors) = &panel.arrows {
        canvas.clip_to(area);
        arrows::draw(canvas, vectors, *counts, area, scale.range[1]);
        canvas.unclip();
    }
    let frame = Axes { area, x: Range::Linear([lower[0], upper[0]]), y: Range::Linear([lower[1], upper[1]]) };
    frame.draw(canvas, &axes[0], &axes[1]);
    colour_bar::draw(canvas, scale, area);
    let bar = colour_bar::bar_height(area.height);
    let above = area.middle().1 - bar / 2.0 - MEDIUM;
    let width = area.width.max(400.0);
    let (title, size) = fitted(&panel.title, MEDIUM, width);
    canvas.text(&title, (area.middle().0, above), size, Anchor::Middle);
    if scale.missing {
        colour_bar::draw_missing(
            canvas,
            (area.right() + 130.0, area.bottom() + axes::below() - MEDIUM * 0.6),
        );
    }
}

/// Colours the pixels of the area, each by the mean of the cells that lie in it or by the cell that it lies in.
fn draw_cells(canvas: &mut Canvas, panel: &Panel, scale: &Scale, [nx, ny]: [usize; 2], area: Area) {
    let (width, height) = (area.width as usize, area.height as usize);
    let cells_of = |pixel: usize, cells: usize, pixels: usize| {
        let first = pixel * cells / pixels;
        first..((pixel + 1) * cells / pixels).max(first + 1)
    };
    for y in 0..height {
        let rows = cells_of(height - 1 - y, ny, height);
        for x in 0..width {
            let columns = cells_of(x, nx, width);
            let block =
                rows.clone().flat_map(|row| &panel.values[row * nx + columns.start..row * nx + columns.end]);
            let value = mean(block.copied().filter(|value| value.is_finite()));
            canvas.pixel(area.left as u32 + x as u32, area.top as u32 + y as u32, scale.colour(value));
        }
    }
}

/// The mean; NaN of nothing.
fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    if count == 0.0 { f64::NAN } else { values.map(|value| value / count).sum() }
}
