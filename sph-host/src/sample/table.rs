//! From a table to checked particles.

use super::error::SampleError;
use super::particles::{Particles, Support, Values, bounds};
use super::request::{Request, SupportFrom};
use crate::io::PointTable;

/// That there are rows, and all their coordinates finite.
pub(super) fn check_coordinates(table: &PointTable) -> Result<(), SampleError> {
    if table.is_empty() {
        return Err(SampleError::NoParticles { file: table.source.clone() });
    }
    Ok(table.require_finite_coordinates()?)
}

/// The particles of a table, or of a piece of one, with the support radius of a built-in set.
pub(super) fn particles(
    table: PointTable,
    own_support: Option<f64>,
    request: &Request,
) -> Result<Particles, SampleError> {
    table.require_one_name_each()?;
    let masses = masses(&table, request)?;
    let densities = densities(&table, request)?;
    if masses.is_none() && (request.estimate.needs_mass() || request.recompute_density) {
        return Err(SampleError::NoMass { file: table.source });
    }
    Ok(Particles {
        support: support(&table, request, own_support)?,
        quantities: quantities(&table, request)?,
        file: table.source,
        space: table.space,
        coordinates: table.coordinates,
        masses,
        densities,
    })
}

fn masses(table: &PointTable, request: &Request) -> Result<Option<Vec<f64>>, SampleError> {
    if let Some(mass) = request.mass {
        return Ok(Some(vec![mass; table.len()]));
    }
    let Some(column) = table.mass()? else { return Ok(None) };
    table.require_positive(&column)?;
    Ok(Some(column.values.into_owned()))
}

fn densities(table: &PointTable, request: &Request) -> Result<Option<Vec<f64>>, SampleError> {
    if request.recompute_density {
        return Ok(None);
    }
    let Some(column) = table.density()? else { return Ok(None) };
    table.require_positive(&column)?;
    Ok(Some(column.values.into_owned()))
}

fn support(table: &PointTable, request: &Request, own: Option<f64>) -> Result<Support, SampleError> {
    let ratio = request.kernel.support_ratio();
    let column = |name: &str, factor: f64| -> Result<Support, SampleError> {
        let mut column = table.scalar(name)?;
        table.require_positive(&column)?;
        column.values.to_mut().iter_mut().for_each(|h| *h *= factor);
        table.require_positive(&column)?;
        Ok(Support::PerParticle(column.values.into_owned()))
    };
    match &request.support {
        Some(SupportFrom::Radius(h)) => Ok(Support::Uniform(*h)),
        Some(SupportFrom::SmoothingLength(length)) => Ok(Support::Uniform(length * ratio)),
        Some(SupportFrom::RadiusColumn(name, factor)) => column(name, *factor),
        Some(SupportFrom::SmoothingLengthColumn(name, factor)) => column(name, ratio * factor),
        None => own.map(Support::Uniform).ok_or_else(|| no_support(table, request)),
    }
}

/// The error for a missing support.
fn no_support(table: &PointTable, request: &Request) -> SampleError {
    let extent = |axis: &Vec<f64>| {
        let (lower, upper) = bounds(axis);
        upper - lower
    };
    let extents: Vec<f64> = table.coordinates.iter().map(extent).filter(|&extent| extent > 0.0).collect();
    let volume: f64 = extents.iter().product();
    let spacing = (volume / table.len() as f64).powf(1.0 / extents.len() as f64);
    let spacing = (!extents.is_empty() && spacing > 0.0 && spacing.is_finite()).then_some(spacing);
    SampleError::NoSupport { file: table.source.clone(), spacing, kernel: request.kernel }
}

fn quantities(table: &PointTable, request: &Request) -> Result<Vec<Values>, SampleError> {
    let names =
        if request.quantities.is_empty() { table.default_quantities() } else { request.quantities.clone() };
    let mut quantities: Vec<Values> = Vec::new();
    for asked in &names {
        let quantity = table.quantity(asked)?;
        table.require_finite(&quantity)?;
        let components = quantity.components();
        for (component, label) in quantity.labels.iter().enumerate() {
            // `density` is the name of the sum of Thm 3.2 in the result.
            let name = if label.eq_ignore_ascii_case("density") { "density_interpolated" } else { label };
            let values = quantity.values.iter().skip(component).step_by(components).copied().collect();
            let field = Values { name: name.to_owned(), quantity: asked.clone(), values };
            // asked for twice, once by component perhaps; others of one name are for the plan to refuse
            let is_known = |known: &Values| known.name == field.name && known.values == field.values;
            if !quantities.iter().any(is_known) {
                quantities.push(field);
            }
        }
    }
    Ok(quantities)
}
