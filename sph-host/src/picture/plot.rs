//! Line plots: series of points over two axes, as lines or as marks, with one legend for all plots of a picture.

use super::axes::{self, Axes, LARGE, MEDIUM, Range, SMALL};
use super::canvas::{Anchor, Area, Canvas, INK, Pen, Rgb};
use super::text::{fitted, width};
use super::{Image, PictureError, check_range};

/// How a series is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line through its points; a point that is not finite interrupts it.
    Line,
    /// A ring at each point, e.g. for measurements to compare with.
    Points,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The name in the legend; series of one name have one colour in all plots. Without a name: ink, not in the legend.
    pub name: String,
    /// The points (x, y).
    pub points: Vec<[f64; 2]>,
    /// How they are shown.
    pub mark: Mark,
}

/// Series over two axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// The line above the plot.
    pub title: String,
    /// What the x axis is.
    pub x_title: String,
    /// What the y axis is.
    pub y_title: String,
    /// What is shown; later series lie over earlier ones.
    pub series: Vec<Series>,
    /// The range of the x axis; without it, that of the points.
    pub x_range: Option<[f64; 2]>,
    /// The range of the y axis; without it, that of the points and a little more. What is beyond is cut off.
    pub y_range: Option<[f64; 2]>,
    /// Which axes are logarithmic: x, then y. A point that is not above 0 along one of them is not shown.
    pub logarithmic: [bool; 2],
}

const MARGIN: f32 = 16.0;
const TITLE: f32 = 44.0;
/// Pixels across a plot that stands alone, and one of several side by side, with its axis.
const ALONE: f32 = 1000.0;
const SIDE_BY_SIDE: f32 = 640.0;
/// Height of a plot's area in pixels.
const HEIGHT: f32 = 500.0;
/// Pixels from one line of the legend to the next, and its line's length.
const LEGEND_LINE: f32 = 30.0;
const LEGEND_MARK: f32 = 34.0;

/// Draws plots side by side, row by row, under one title, with the legend at the right.
///
/// # Errors
///
/// [`PictureError::Empty`] without plots, [`PictureError::Range`] for a range that is empty or not finite,
/// [`PictureError::TooLarge`] for too many.
pub fn draw(title: &str, rows: &[Vec<Plot>]) -> Result<Image, PictureError> {
    if rows.iter().all(Vec::is_empty) {
        return Err(PictureError::Empty);
    }
    let legend = Legend::of(rows.iter().flatten());
    let columns = rows.iter().map(Vec::len).max().unwrap_or(1);
    let across = if columns > 1 { SIDE_BY_SIDE } else { ALONE };
    let plots_width = across * columns as f32 + MARGIN;
    let head = MARGIN + if title.is_empty() { 0.0 } else { TITLE };
    let block = TITLE + HEIGHT + axes::below() + MARGIN;
    let (full_width, full_height) = (plots_width + legend.width(), head + block * rows.len() as f32);
    let mut canvas = Canvas::new(full_width.ceil() as u32, full_height.ceil() as u32)?;
    let (title, size) = fitted(title, LARGE, full_width - 2.0 * MARGIN);
    canvas.text(&title, (full_width / 2.0, MARGIN + TITLE / 2.0), size, Anchor::Middle);
    for (row, plots) in rows.iter().enumerate() {
        for (column, plot) in plots.iter().enumerate() {
            let left = across * column as f32 + MARGIN;
            let top = head + block * row as f32 + TITLE;
            draw_plot(
                &mut canvas,
                plot,
                &legend,
                Area { left, top, width: across - MARGIN, height: HEIGHT },
            )?;
        }
    }
    legend.draw(&mut canvas, plots_width, head + TITLE);
    Ok(canvas.into_image())
}

/// Draws one plot; `room` has the plot's area and, left of it, its axis.
fn draw_plot(canvas: &mut Canvas, plot: &Plot, legend: &Legend, room: Area) -> Result<(), PictureError> {
    let plot = &on_scales(plot);
    let range = |axis: usize, given: Option<[f64; 2]>, title: &str, more: f64| {
        let ends = given.unwrap_or_else(|| range_of(plot, axis, more));
        check_range(title, ends)?;
        Ok(if plot.logarithmic[axis] { Range::Logarithmic(ends) } else { Range::Linear(ends) })
    };
    let x = range(0, plot.x_range, &plot.x_title, 0.0)?;
    let y = range(1, plot.y_range, &plot.y_title, 0.04)?;
    let axis = axes::left_of(y, room.height).ceil();
    let area = Area { left: room.left + axis, width: room.width - axis - MARGIN, ..room };
    let frame = Axes { area, x, y };
    frame.draw_grid(canvas);
    canvas.clip_to(area);
    for series in &plot.series {
        draw_series(canvas, &frame, series, legend.pen(&series.name));
    }
    canvas.unclip();
    frame.draw(canvas, &plot.x_title, &plot.y_title);
    let (title, size) = fitted(&plot.title, MEDIUM, room.width);
    canvas.text(&title, (area.middle().0, area.top - MEDIUM), size, Anchor::Middle);
    Ok(())
}

/// The plot with logarithms in place of the numbers along its logarithmic axes.
fn on_scales(plot: &Plot) -> Plot {
    let mut plot = plot.clone();
    let is_logarithmic = plot.logarithmic;
    let scaled = |axis: usize, value: f64| if is_logarithmic[axis] { value.log10() } else { value };
    for point in plot.series.iter_mut().flat_map(|series| &mut series.points) {
        *point = [scaled(0, point[0]), scaled(1, point[1])];
    }
    plot.x_range = plot.x_range.map(|range| range.map(|end| scaled(0, end)));
    plot.y_range = plot.y_range.map(|range| range.map(|end| scaled(1, end)));
    plot
}

fn draw_series(canvas: &mut Canvas, frame: &Axes, series: &Series, pen: Pen) {
    let finite = |point: &[f64; 2]| point.iter().all(|part| part.is_finite());
    match series.mark {
        Mark::Line => {
            for run in series.points.split(|point| !finite(point)) {
                let places: Vec<(f32, f32)> = run.iter().map(|&point| frame.place(point)).collect();
                canvas.line(&places, pen);
            }
        }
        Mark::Points => {
            for &point in series.points.iter().filter(|point| finite(point)) {
                ring(canvas, frame.place(point), pen.colour);
            }
        }
    }
}

fn ring(canvas: &mut Canvas, (x, y): (f32, f32), colour: Rgb) {
    canvas.circle(x, y, 6.0, colour);
    canvas.circle(x, y, 3.6, [255; 3]);
}

/// The range of the points along an axis, with a part of it more at both ends.
fn range_of(plot: &Plot, axis: usize, more: f64) -> [f64; 2] {
    let finite = |point: &&[f64; 2]| point.iter().all(|part| part.is_finite());
    let values = plot.series.iter().flat_map(|series| &series.points).filter(finite).map(|point| point[axis]);
    let [lower, upper] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[lower, upper], value| {
        [lower.min(value), upper.max(value)]
    });
    if lower > upper {
        return [0.0, 1.0];
    }
    if upper - lower <= 1e-12 * lower.abs().max(upper.abs()) {
        let half = if upper == 0.0 { 1.0 } else { 0.05 * upper.abs() };
        return [lower - half, upper + half];
    }
    [lower - more * (upper - lower), upper + more * (upper - lower)]
}

/// The names of all series with their pens, in the order of their first appearance.
struct Legend {
    entries: Vec<(String, Mark)>,
}

impl Legend {
    fn of<'a>(plots: impl Iterator<Item = &'a Plot>) -> Self {
        let mut entries: Vec<(String, Mark)> = Vec::new();
        for series in plots.flat_map(|plot| &plot.series) {
            if !series.name.is_empty() && entries.iter().all(|(name, _)| *name != series.name) {
                entries.push((series.name.clone(), series.mark));
            }
        }
        Self { entries }
    }

    /// The pen of a series: ten colours, then the same dashed.
    fn pen(&self, name: &str) -> Pen {
        let Some(index) = self.entries.iter().position(|(entry, _)| entry == name) else {
            return Pen::new(INK, 2.2);
        };
        let colours = colorous::TABLEAU10;
        let dashed = (index / colours.len()) % 2 == 1;
        Pen { dashed, ..Pen::new(colours[index % colours.len()].as_array(), 2.4) }
    }

    fn width(&self) -> f32 {
        if self.entries.is_empty() {
            return MARGIN;
        }
        let widest = self.entries.iter().map(|(name, _)| width(name, SMALL)).fold(0.0, f32::max);
        2.0 * MARGIN + LEGEND_MARK + widest
    }

    fn draw(&self, canvas: &mut Canvas, left: f32, top: f32) {
        for (index, (name, mark)) in self.entries.iter().enumerate() {
            let y = top + (index as f32 + 0.5) * LEGEND_LINE;
            let pen = self.pen(name);
            match mark {
                Mark::Line => {
                    canvas.line(&[(left, y), (left + LEGEND_MARK - 8.0, y)], Pen { width: 3.5, ..pen })
                }
                Mark::Points => ring(canvas, (left + LEGEND_MARK / 2.0 - 4.0, y), pen.colour),
            }
            canvas.text(name, (left + LEGEND_MARK, y), SMALL, Anchor::Start);
        }
    }
}
