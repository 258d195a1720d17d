//! The surface on which a column of a grid has a level.

use thiserror::Error;

use super::{Column, Precision, Table, shortest};
use crate::surface::{Lattice, Mesh, TooManyVertices, march};

/// A surface, ready to be written, and what a person should know of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Vertices and triangles.
    pub mesh: Mesh,
    /// One line for people.
    pub caption: String,
    /// What a person should know, whatever the format.
    pub warnings: Vec<SurfaceWarning>,
    /// The smallest width of a cell of the grid.
    pub cell: f64,
}

impl Surface {
    /// What a person should know who writes `.ply`: that single precision tells fewer than a thousand places apart within a cell.
    #[must_use]
    pub fn coarse(&self) -> Option<SurfaceWarning> {
        let coordinates = self.mesh.vertices.iter().flat_map(|vertex| vertex.position);
        let farthest = coordinates.fold(0.0_f64, |most, x| most.max(x.abs())) as f32;
        let (resolution, cell) = (f64::from(farthest.next_up()) - f64::from(farthest), self.cell);
        (resolution > cell / 1000.0).then_some(SurfaceWarning::Coarse { resolution, cell })
    }
}

/// Why there is no surface.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SurfaceError {
    /// The points are no grid in space.
    #[error("a surface is taken of a grid of 3 axes, got {}", number_of(*.axes))]
    NotInSpace {
        /// How many axes the grid has; none where the points are no grid.
        axes: Option<usize>,
    },
    /// There is no such column.
    #[error("there is no column `{name}`, but {known}")]
    NoColumn {
        /// Its name.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// The column has no value anywhere.
    #[error("`{name}` has no value anywhere on the grid, so there is no surface at {}", text(*.level))]
    NoValues {
        /// The column.
        name: String,
        /// The level.
        level: f64,
    },
    /// The column does not cross the level.
    #[error(
        "`{name}` goes from {} to {} on the grid and crosses {} nowhere, so there is no surface", text(*.lower), text(*.upper), text(*.level)
    )]
    NotCrossed {
        /// The column.
        name: String,
        /// The level.
        level: f64,
        /// The least value.
        lower: f64,
        /// The greatest value.
        upper: f64,
    },
    /// More vertices than files hold.
    #[error(transparent)]
    TooMany(#[from] TooManyVertices),
}

/// What a person should know of a surface.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SurfaceWarning {
    /// It goes on beyond the grid.
    #[error(
        "the surface meets the border of the grid and is open there: {open} of its {edges} edges have one triangle"
    )]
    Border {
        /// Edges with one triangle, at the border.
        open: usize,
        /// All edges.
        edges: usize,
    },
    /// Points of the grid without a value.
    #[error(
        "`{name}` has no value at {missing} of {points} points of the grid: the surface has holes where it meets them, and {open} of its \
         {edges} edges have one triangle there"
    )]
    Gaps {
        /// The column.
        name: String,
        /// Points without a value.
        missing: usize,
        /// All points.
        points: usize,
        /// Edges with one triangle, beside such points.
        open: usize,
        /// All edges.
        edges: usize,
    },
    /// Positions that single precision, which `.ply` has, tells apart by so much at best.
    #[error(
        "single precision, which .ply holds, tells positions apart by {resolution:.1e} at best, where a cell is {cell:.1e} wide: .obj holds \
         them to the bit"
    )]
    Coarse {
        /// The distance of neighbouring numbers at the farthest vertex.
        resolution: f64,
        /// The smallest width of a cell.
        cell: f64,
    },
}

fn text(number: f64) -> String {
    shortest(number, Precision::F64)
}

fn number_of(axes: Option<usize>) -> String {
    axes.map_or_else(|| String::from("points that are no grid"), |axes| format!("one of {axes}"))
}

impl Table {
    /// The surface on which the column of this name has the value `level`, greater values inside.
    ///
    /// Normals are interpolated from the column's gradient where the table has it, else from differences of neighbouring values. Points whose
    /// value is NaN make holes.
    ///
    /// # Errors
    ///
    /// [`SurfaceError`]: the points are no grid of three axes, there is no such column, or it does not cross the level.
    pub fn surface(&self, name: &str, level: f64) -> Result<Surface, SurfaceError> {
        let axes = self.grid.as_ref().map(|grid| grid.axes().len());
        let grid = self.grid.as_ref().filter(|_| axes == Some(3)).ok_or(SurfaceError::NotInSpace { axes })?;
        let column =
            self.all_columns().find(|column| column.name == name).ok_or_else(|| self.no_column(name))?;
        let along: [Vec<f64>; 3] = std::array::from_fn(|axis| {
            (0..grid.counts()[axis]).map(|index| grid.centre(axis, index)).collect()
        });
        let of = self.columns.iter().position(|known| known.name == name);
        let gradient = of.and_then(|of| self.gradient(grid, of));
        let gradient = gradient.and_then(|columns| <[&Column; 3]>::try_from(columns).ok());
        let lattice = Lattice {
            axes: along.each_ref().map(Vec::as_slice),
            values: &column.values,
            gradient: gradient.map(|columns| columns.map(|column| column.values.as_slice())),
        };
        let mesh = march(&lattice, level)?;
        if mesh.triangles.is_empty() {
            return Err(no_surface(column, level));
        }
        let warnings = warnings(&mesh, column);
        let cell = (0..3).map(|axis| grid.spacing(axis)).fold(f64::INFINITY, f64::min);
        Ok(Surface { mesh, caption: format!("{name} = {}, {}", text(level), self.caption), warnings, cell })
    }

    fn no_column(&self, name: &str) -> SurfaceError {
        let known: Vec<&str> = self.all_columns().map(|column| column.name.as_str()).collect();
        SurfaceError::NoColumn { name: name.to_owned(), known: known.join(", ") }
    }
}

fn no_surface(column: &Column, level: f64) -> SurfaceError {
    let name = column.name.clone();
    let values = column.values.iter().copied().filter(|value| value.is_finite());
    let range = values.fold(None, |range: Option<(f64, f64)>, value| {
        let (lower, upper) = range.unwrap_or((value, value));
        Some((lower.min(value), upper.max(value)))
    });
    match range {
        Some((lower, upper)) => SurfaceError::NotCrossed { name, level, lower, upper },
        None => SurfaceError::NoValues { name, level },
    }
}

fn warnings(mesh: &Mesh, column: &Column) -> Vec<SurfaceWarning> {
    let (name, points, edges) = (column.name.clone(), column.values.len(), mesh.edges());
    let missing = column.values.iter().filter(|value| !value.is_finite()).count();
    let border = SurfaceWarning::Border { open: mesh.open_at_border, edges };
    let gaps = SurfaceWarning::Gaps { name, missing, points, open: mesh.open_at_gaps, edges };
    let found = [(mesh.open_at_border > 0, border), (missing > 0, gaps)];
    found.into_iter().filter(|(holds, _)| *holds).map(|(_, warning)| warning).collect()
}
