//! A table on a grid as a picture: heat maps of a 2-D grid or of the middle slice of a 3-D one, line plots of a 1-D one.

use super::{Column, Grid, Precision, Role, Table, shortest};
use crate::picture::heat_map::{self, HeatMap, Panel, Plane};
use crate::picture::plot::{self, Mark, Plot, Series};
use crate::picture::{Image, Palette, PictureError};

/// Quantities that one picture shows at most, gradients not counted.
pub const MOST_IN_PICTURE: usize = 12;

/// A quantity, and its gradient if the table has all components of it.
struct Quantity<'a> {
    column: &'a Column,
    gradient: Option<Vec<&'a Column>>,
}

/// Draws the table.
pub(super) fn draw(table: &Table) -> Result<Image, PictureError> {
    let Some(grid) = &table.grid else { return Err(PictureError::Empty) };
    let quantities = quantities(table, grid);
    if quantities.len() > MOST_IN_PICTURE {
        return Err(PictureError::TooMany { count: quantities.len(), limit: MOST_IN_PICTURE });
    }
    if grid.counts().len() == 1 {
        return draw_lines(table, grid, &quantities);
    }
    let slice = Slice::of(grid);
    let panels: Vec<Vec<Panel>> = quantities.iter().map(|quantity| panels(quantity, &slice)).collect();
    // Single panels stand two in a row; a quantity and its gradient have a row of their own.
    let rows = if panels.len() > 1 && panels.iter().all(|row| row.len() == 1) {
        panels.concat().chunks(2).map(<[Panel]>::to_vec).collect()
    } else {
        panels
    };
    let title = [table.caption.as_str(), &slice.title].into_iter().filter(|part| !part.is_empty());
    heat_map::draw(&HeatMap { title: title.collect::<Vec<_>>().join(", "), plane: slice.plane, rows })
}

/// The columns to show, each with its gradient.
fn quantities<'a>(table: &'a Table, grid: &Grid) -> Vec<Quantity<'a>> {
    let gradient = |place: usize| table.gradient(grid, place);
    let is_shown = |column: &Column| match column.role {
        Role::Gradient { of, .. } => gradient(of).is_none(),
        _ => true,
    };
    let shown = table.columns.iter().enumerate().filter(|(_, column)| is_shown(column));
    let mut quantities: Vec<Quantity> =
        shown.map(|(place, column)| Quantity { column, gradient: gradient(place) }).collect();
    // What was asked for is the picture; the density comes along in every table.
    if quantities.len() > 1 {
        quantities.retain(|quantity| quantity.column.role != Role::Density);
    }
    quantities
}

/// A plane of cells of a grid.
struct Slice {
    plane: Plane,
    /// Where in a 3-D grid it is.
    title: String,
    /// The grid's axes that the plane's axes are.
    axes: [usize; 2],
    /// The cells of the plane, from left to right, then upwards.
    cells: Vec<usize>,
}

impl Slice {
    /// All of a 2-D grid; of a 3-D one the slice across z in its middle, or the only one across an axis of a single cell.
    fn of(grid: &Grid) -> Self {
        let counts = grid.counts();
        let normal = (counts.len() == 3).then(|| (0..3).rev().find(|&axis| counts[axis] == 1).unwrap_or(2));
        let axes = match normal {
            Some(0) => [1, 2],
            Some(1) => [0, 2],
            _ => [0, 1],
        };
        let stride = |axis: usize| counts[..axis].iter().product::<usize>();
        let (offset, title) = normal.map_or((0, String::new()), |axis| {
            let middle = counts[axis] / 2;
            (
                middle * stride(axis),
                format!("slice at {} = {}", grid.axis_name(axis), rounded(grid.centre(axis, middle))),
            )
        });
        let cell = |row: usize, column: usize| offset + row * stride(axes[1]) + column * stride(axes[0]);
        let (nx, ny) = (counts[axes[0]], counts[axes[1]]);
        let cells = (0..ny)
            .flat_map(|row| (0..nx).map(move |column| (row, column)))
            .map(|(row, column)| cell(row, column));
        let plane = Plane {
            counts: [nx, ny],
            lower: axes.map(|axis| grid.lower()[axis]),
            upper: axes.map(|axis| grid.upper()[axis]),
            axes: axes.map(|axis| grid.axis_name(axis).to_owned()),
        };
        Self { plane, title, axes, cells: cells.collect() }
    }

    fn values(&self, column: &Column) -> Vec<f64> {
        self.cells.iter().map(|&cell| column.values[cell]).collect()
    }
}

/// The quantity, and beside it its gradient's magnitude with arrows.
fn panels(Quantity { column, gradient }: &Quantity, slice: &Slice) -> Vec<Panel> {
    let values = slice.values(column);
    let mut panels = vec![Panel {
        title: with_range(&column.name, &values),
        values,
        palette: Palette::Viridis,
        arrows: None,
    }];
    if let Some(components) = gradient {
        let components: Vec<Vec<f64>> = components.iter().map(|component| slice.values(component)).collect();
        let magnitude = |cell: usize| components.iter().fold(0.0_f64, |sum, values| sum.hypot(values[cell]));
        let values: Vec<f64> = (0..slice.cells.len()).map(magnitude).collect();
        panels.push(Panel {
            title: with_range(&format!("|∇{}|", column.name), &values),
            values,
            palette: Palette::Inferno,
            arrows: Some(slice.axes.map(|axis| components[axis].clone())),
        });
    }
    panels
}

/// A name and the range of its values.
fn with_range(name: &str, values: &[f64]) -> String {
    let finite = values.iter().copied().filter(|value| value.is_finite());
    let (lower, upper) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(lower, upper), value| {
        (lower.min(value), upper.max(value))
    });
    match (rounded(lower), rounded(upper)) {
        _ if lower > upper => format!("{name}: no values"),
        (lower, upper) if lower == upper => format!("{name}: {lower}"),
        (lower, upper) => format!("{name}: {lower} to {upper}"),
    }
}

/// Four digits of a value.
fn rounded(value: f64) -> String {
    let digits = format!("{value:.3e}").parse().unwrap_or(value);
    let text = shortest(digits, Precision::F64);
    text.strip_suffix(".0").unwrap_or(&text).replace('-', "−")
}

/// Each quantity of a 1-D grid as a line, with its slope beside it.
fn draw_lines(table: &Table, grid: &Grid, quantities: &[Quantity]) -> Result<Image, PictureError> {
    let line = |title: String, column: &Column| Plot {
        title,
        x_title: grid.axis_name(0).to_owned(),
        y_title: column.name.clone(),
        series: vec![Series {
            name: String::new(),
            points: column
                .values
                .iter()
                .enumerate()
                .map(|(cell, &value)| [grid.centre(0, cell), value])
                .collect(),
            mark: Mark::Line,
        }],
        x_range: Some([grid.lower()[0], grid.upper()[0]]),
        ..Plot::default()
    };
    let rows: Vec<Vec<Plot>> = quantities
        .iter()
        .map(|Quantity { column, gradient }| {
            let slopes =
                gradient.iter().flatten().map(|slope| line(format!("slope of {}", column.name), slope));
            std::iter::once(line(column.name.clone(), column)).chain(slopes).collect()
        })
        .collect();
    plot::draw(&table.caption, &rows)
}
