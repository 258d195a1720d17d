//! What a result consists of: its columns, each with what it means and its unit.

use std::collections::HashMap;

use sph_core::Scalar;

use super::error::{AXES, SampleError};
use super::found::AtPoint;
use super::planes;
use super::points::Points;
use super::request::Request;
use super::significant::Significant;
use super::span::Span;
use super::units::{Units, is_float};
use super::warning::Warning;
use crate::output::{Column, Precision, Role};
use crate::scalar_choice::{ScalarName, with_scalar};

/// A column of the result before it has values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct OutputColumn {
    pub(super) name: String,
    /// What values of the scalar are multiplied with to be in the file's units.
    pub(super) unit: f64,
    pub(super) role: Role,
}

/// Everything that is known before the sums.
pub(super) struct Plan<'a> {
    pub(super) request: &'a Request,
    pub(super) span: Span,
    /// How many particles there are, without images.
    pub(super) particles: usize,
    /// The coordinates that sums run over, by their numbers among those of the file.
    pub(super) axes: Vec<usize>,
    /// The axes in space of these: 0 is x.
    pub(super) space: Vec<usize>,
    pub(super) units: Units,
    pub(super) columns: Vec<OutputColumn>,
    pub(super) precision: Precision,
}

impl<'a> Plan<'a> {
    /// Chooses units and columns; no two columns have the same name.
    pub(super) fn new(
        request: &'a Request,
        span: Span,
        particles: usize,
        axes: Vec<usize>,
        points: &Points,
    ) -> Result<Self, SampleError> {
        let units = with_scalar!(request.scalar, T => Units::of::<T>(&span, &axes));
        let space = span.in_space(&axes);
        let columns = columns(&span, &space, &units, request.gradient);
        require_one_name_each(&span, points, &columns)?;
        require_surface_column(request, &span, points, &columns)?;
        let precision = if request.scalar == ScalarName::F32 { Precision::F32 } else { Precision::F64 };
        Ok(Self { request, span, particles, axes, space, units, columns, precision })
    }

    /// Writes what was found at a point into a row of the columns; returns how many values are outside the range of the scalar.
    pub(super) fn write<T: Scalar, const D: usize>(
        &self,
        found: &AtPoint<T, D>,
        row: usize,
        columns: &mut [&mut [f64]],
    ) -> usize {
        let mut overflowed = 0;
        for (column, values) in self.columns.iter().zip(columns) {
            let local = match self.subject(column.role) {
                Role::Field(number) => found.fields.get(number).copied().flatten(),
                _ => found.density,
            };
            let Some((value, gradient)) = local else { continue };
            let number = match column.role {
                Role::Gradient { axis, .. } => {
                    self.space.iter().position(|&known| known == axis).map_or(value, |k| gradient[k])
                }
                _ => value,
            };
            let scaled = number.to_f64() * column.unit;
            let written = if self.precision == Precision::F32 { f64::from(scaled as f32) } else { scaled };
            if number.is_finite() && written.is_finite() {
                values[row] = written;
            } else {
                overflowed += 1;
            }
        }
        overflowed
    }

    /// What a column is the value or the gradient of.
    fn subject(&self, role: Role) -> Role {
        match role {
            Role::Gradient { of, .. } => self.columns.get(of).map_or(Role::Density, |column| column.role),
            own => own,
        }
    }

    /// The columns with their values.
    pub(super) fn into_columns(self, values: Vec<Vec<f64>>) -> Vec<Column> {
        let columns = self.columns.into_iter().zip(values);
        columns.map(|(column, values)| Column { name: column.name, role: column.role, values }).collect()
    }

    /// One line for people: what was evaluated.
    pub(super) fn caption(&self) -> String {
        let (Span { file, supports, is_uniform, .. }, count) = (&self.span, self.particles);
        let support = if *is_uniform {
            format!("h = {:.4}", Significant(supports.0))
        } else {
            String::from("h of each particle")
        };
        format!("{file}: {count} particles, {}, {support}", self.request.kernel.name())
    }

    /// What there is to know before the sums.
    pub(super) fn warnings(&self, points: usize) -> Vec<Warning> {
        let empty = (points == 0).then_some(Warning::NoPoints);
        empty.into_iter().chain(self.flat()).chain(self.coarse()).collect()
    }

    /// Particles in space that could lie in a plane, unless the dimensions were asked for.
    fn flat(&self) -> Option<Warning> {
        let constant = planes::constant(&self.span.coordinates);
        let is_flat = self.request.dim.is_none() && self.axes.len() == 3 && (1..3).contains(&constant.len());
        let constant = constant
            .iter()
            .map(|&axis| (AXES[self.span.space[axis]], self.span.coordinates[axis].0))
            .collect();
        is_flat.then(|| Warning::Flat { file: self.span.file.clone(), constant })
    }

    /// Particles that span so much that rounding moves them by a hundredth of h.
    fn coarse(&self) -> Option<Warning> {
        let scalar = self.units.scalar.clone();
        let (epsilon, is_float) =
            with_scalar!(self.request.scalar, T => (T::EPSILON.to_f64(), is_float::<T>()));
        let farthest = self.axes.iter().zip(&self.units.origin).fold(0.0_f64, |most, (&axis, origin)| {
            let (lower, upper) = self.span.coordinates[axis];
            most.max((lower - origin).abs()).max((upper - origin).abs())
        });
        let (resolution, support) = (epsilon * farthest, self.span.supports.0);
        let is_coarse = is_float && resolution > 0.01 * support;
        is_coarse.then_some(Warning::Coarse { scalar, resolution, support })
    }
}

/// Density and fields, each with its gradient after it.
fn columns(span: &Span, axes: &[usize], units: &Units, gradient: bool) -> Vec<OutputColumn> {
    let density = span.masses.map(|_| ("density", Role::Density, units.density));
    let fields = units.quantities.iter().enumerate();
    let fields = fields.map(|(number, (name, unit))| (name.as_str(), Role::Field(number), *unit));
    let mut columns: Vec<OutputColumn> = Vec::new();
    for (name, role, unit) in density.into_iter().chain(fields) {
        let of = columns.len();
        columns.push(OutputColumn { name: name.to_owned(), unit, role });
        for &axis in axes.iter().filter(|_| gradient) {
            let (name, unit) = (format!("{name}_d{}", AXES[axis]), unit / units.length);
            columns.push(OutputColumn { name, unit, role: Role::Gradient { of, axis } });
        }
    }
    columns
}

/// That no two columns of the result have the same name.
fn require_one_name_each(span: &Span, points: &Points, columns: &[OutputColumn]) -> Result<(), SampleError> {
    let origin = |role: Role| match role {
        Role::Field(number) => format!("`{}`", span.fields[number].quantity),
        _ => String::from("the density"),
    };
    let origin = |role: Role| match role {
        Role::Gradient { of, .. } => format!("the gradient of {}", origin(columns[of].role)),
        own => origin(own),
    };
    let coordinates = points.axes().map(|axis| (AXES[axis], String::from("the coordinates")));
    let columns = columns.iter().map(|column| (column.name.as_str(), origin(column.role)));
    let mut seen = HashMap::new();
    for (name, origin) in coordinates.chain(columns) {
        if let Some(first) = seen.insert(name, origin.clone()) {
            let (file, name, second) = (span.file.clone(), name.to_owned(), origin);
            return Err(SampleError::SameName { file, name, first, second });
        }
    }
    Ok(())
}

/// That the result has the column that a surface is to be taken of.
fn require_surface_column(
    request: &Request,
    span: &Span,
    points: &Points,
    columns: &[OutputColumn],
) -> Result<(), SampleError> {
    let Some(name) = &request.surface else { return Ok(()) };
    let known: Vec<&str> = points
        .axes()
        .map(|axis| AXES[axis])
        .chain(columns.iter().map(|column| column.name.as_str()))
        .collect();
    if known.contains(&name.as_str()) {
        return Ok(());
    }
    Err(SampleError::NoColumn { file: span.file.clone(), name: name.clone(), known: known.join(", ") })
}
