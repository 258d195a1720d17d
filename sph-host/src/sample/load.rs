//! From a particle file or a built-in set to checked particles.

use super::request::{Estimate, ParticleSource, Request, SupportFrom};
use crate::demo;
use crate::failure::Failure;
use crate::io::{self, PointTable};
use crate::kernel_choice::KernelName;

/// Support radii h.
#[derive(Clone, Debug, PartialEq)]
pub enum Support {
    /// One for all.
    Uniform(f64),
    /// One for each particle (scatter form).
    PerParticle(Vec<f64>),
}

/// A field to evaluate: its name in the result and its values at the particles.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    /// The column's name in the result.
    pub name: String,
    /// One value a particle.
    pub values: Vec<f64>,
}

/// Particles whose every number in use is finite, and positive where it must be.
#[derive(Clone, Debug)]
pub struct Particles {
    /// The file or set, for messages.
    pub source: String,
    /// Dimensions that the sums run over.
    pub dim: usize,
    /// All coordinates as read, axis by axis: `dim` of them, or more.
    pub coordinates: Vec<Vec<f64>>,
    /// m_i; none: weights without mass.
    pub masses: Option<Vec<f64>>,
    /// ρ_i of the file, unless they are to be summed.
    pub densities: Option<Vec<f64>>,
    /// h
    pub support: Support,
    /// The fields.
    pub quantities: Vec<Values>,
}

impl Particles {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.coordinates[0].len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Reads and checks the particles of a request.
pub(super) fn particles(request: &Request) -> Result<Particles, Failure> {
    let (table, own_support) = table(&request.particles)?;
    checked(table, own_support, request)
}

/// The particles of a table, with the support radius of a built-in set.
pub(super) fn checked(
    table: PointTable,
    own_support: Option<f64>,
    request: &Request,
) -> Result<Particles, Failure> {
    if table.is_empty() {
        return Err(Failure::input(format!("{}: there are no particles in it", table.source)));
    }
    table.require_finite_coordinates()?;
    let dim = dimensions(&table, request.dim)?;
    table.require_one_name_each()?;
    let masses = masses(&table, request)?;
    let densities = densities(&table, request)?;
    if masses.is_none() && (request.estimate != Estimate::Shepard || request.recompute_density) {
        return Err(Failure::input(format!(
            "{}: there is no mass: neither a column `m` or `mass` nor --mass; only --estimate shepard does without, \
             and not where densities are summed",
            table.source
        )));
    }
    Ok(Particles {
        dim,
        support: support(&table, request, own_support, dim)?,
        quantities: quantities(&table, request)?,
        source: table.source,
        coordinates: table.coordinates,
        masses,
        densities,
    })
}

fn table(particulars: &ParticleSource) -> Result<(PointTable, Option<f64>), Failure> {
    match particulars {
        ParticleSource::File(path) => Ok((io::read(path)?, None)),
        ParticleSource::Demo(name, particles) => {
            let demo = demo::set(name, *particles).ok_or_else(|| demo::unknown(name))?;
            Ok((demo.table, Some(demo.support_radius)))
        }
    }
}

/// The dimensions that are meant: the table's own, or fewer where the further coordinates are all equal.
pub(super) fn dimensions(table: &PointTable, asked: Option<usize>) -> Result<usize, Failure> {
    let own = table.dimensions();
    let dim = asked.unwrap_or(own);
    if dim > own {
        return Err(Failure::input(format!(
            "{}: it has {own} coordinates, --dim {dim} asks for more",
            table.source
        )));
    }
    for axis in dim..own {
        let coordinates = &table.coordinates[axis];
        if let Some(row) = coordinates.iter().position(|&value| value != coordinates[0]) {
            return Err(Failure::input(format!(
                "{}: {}: {} is {}, not {} as before: --dim {dim} needs it to be the same everywhere",
                table.source,
                table.locate(row),
                ["x", "y", "z"][axis],
                coordinates[row],
                coordinates[0]
            )));
        }
    }
    Ok(dim)
}

fn masses(table: &PointTable, request: &Request) -> Result<Option<Vec<f64>>, Failure> {
    if let Some(mass) = request.mass {
        return Ok(Some(vec![mass; table.len()]));
    }
    let Some(column) = table.mass()? else { return Ok(None) };
    table.require_positive(&column)?;
    Ok(Some(column.values.to_vec()))
}

fn densities(table: &PointTable, request: &Request) -> Result<Option<Vec<f64>>, Failure> {
    if request.recompute_density {
        return Ok(None);
    }
    let Some(column) = table.density()? else { return Ok(None) };
    table.require_positive(&column)?;
    Ok(Some(column.values.to_vec()))
}

fn support(table: &PointTable, request: &Request, own: Option<f64>, dim: usize) -> Result<Support, Failure> {
    let ratio = request.kernel.support_ratio();
    let column = |name: &str, factor: f64| -> Result<Support, Failure> {
        let mut column = table.scalar(name)?;
        table.require_positive(&column)?;
        column.values.to_mut().iter_mut().for_each(|h| *h *= factor);
        table.require_positive(&column)?;
        Ok(Support::PerParticle(column.values.into_owned()))
    };
    match &request.support {
        Some(SupportFrom::Radius(h)) => Ok(Support::Uniform(*h)),
        Some(SupportFrom::SmoothingLength(length)) => Ok(Support::Uniform(length * ratio)),
        Some(SupportFrom::RadiusColumn(name)) => column(name, 1.0),
        Some(SupportFrom::SmoothingLengthColumn(name)) => column(name, ratio),
        None => own.map(Support::Uniform).ok_or_else(|| no_support(table, request.kernel, dim)),
    }
}

/// The error for a missing support, with a value that would give a customary number of neighbours.
fn no_support(table: &PointTable, kernel: KernelName, dim: usize) -> Failure {
    let extents = table.coordinates.iter().take(dim).map(|axis| extent(axis)).filter(|&extent| extent > 0.0);
    let (volume, axes) = extents.fold((1.0, 0), |(volume, axes), extent| (volume * extent, axes + 1));
    let spacing = if axes == 0 { 1.0 } else { (volume / table.len() as f64).powf(1.0 / f64::from(axes)) };
    Failure::input(format!(
        "{}: no support radius is given: try --support {:.3}, 2.6 times the mean spacing (or --smoothing-length {:.3} for \
         {}), or name a column with --support-column",
        table.source,
        Significant(2.6 * spacing),
        Significant(2.6 * spacing / kernel.support_ratio()),
        kernel.name(),
    ))
}

/// The span from the least to the greatest.
fn extent(values: &[f64]) -> f64 {
    let (lower, upper) = bounds(values);
    upper - lower
}

/// The least and the greatest.
pub(super) fn bounds(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lower, upper), &x| (lower.min(x), upper.max(x)))
}

/// A number for people, to a few significant digits whatever its size.
pub(super) struct Significant(pub(super) f64);

impl std::fmt::Display for Significant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = f.precision().unwrap_or(3);
        let rounded: f64 = format!("{:.*e}", digits - 1, self.0).parse().unwrap_or(self.0);
        write!(f, "{rounded}")
    }
}

fn quantities(table: &PointTable, request: &Request) -> Result<Vec<Values>, Failure> {
    let names =
        if request.quantities.is_empty() { table.default_quantities() } else { request.quantities.clone() };
    let mut quantities: Vec<Values> = Vec::new();
    for name in &names {
        let quantity = table.quantity(name)?;
        table.require_finite(&quantity)?;
        let components = quantity.components();
        for (component, label) in quantity.labels.iter().enumerate() {
            // `density` is the name of the sum of Thm 3.2 in the result.
            let name = if label.eq_ignore_ascii_case("density") { "density_interpolated" } else { label };
            let values = quantity.values.iter().skip(component).step_by(components).copied().collect();
            let values = Values { name: name.to_owned(), values };
            // asked for twice, once by component perhaps; others of one name are for the table to refuse
            if !quantities.contains(&values) {
                quantities.push(values);
            }
        }
    }
    Ok(quantities)
}
