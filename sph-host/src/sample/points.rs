//! The points at which fields are wanted.

use sysinfo::System;

use super::load::{self, Particles};
use super::request::{ParticleSource, Request, SamplePoints};
use crate::failure::Failure;
use crate::io;
use crate::output::{Column, Grid};

/// Points as coordinates axis by axis, and the grid they come from, if they do.
#[derive(Clone, Debug)]
pub(super) struct Points {
    coordinates: Vec<Vec<f64>>,
    grid: Option<Grid>,
}

impl Points {
    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.coordinates[0].len()
    }

    /// Some of them, by number.
    pub(super) fn some(&self, numbers: &[usize]) -> Self {
        let some = |axis: &Vec<f64>| numbers.iter().map(|&number| axis[number]).collect();
        Self { coordinates: self.coordinates.iter().map(some).collect(), grid: None }
    }

    /// The coordinates along one axis.
    pub(super) fn along(&self, axis: usize) -> &[f64] {
        &self.coordinates[axis]
    }

    /// The coordinate columns of the result.
    pub(super) fn into_table(self) -> (Vec<Column>, Option<Grid>) {
        let columns = ["x", "y", "z"].into_iter().zip(self.coordinates);
        (columns.map(|(name, values)| Column::new(name, values)).collect(), self.grid)
    }
}

/// Makes or reads the points of a request.
pub(super) fn points(request: &Request, particles: &Particles) -> Result<Points, Failure> {
    match &request.at {
        SamplePoints::AtParticles => Ok(Points { coordinates: particles.coordinates.clone(), grid: None }),
        SamplePoints::At(path) => {
            let table = io::read(path)?;
            table.require_finite_coordinates()?;
            let dim =
                if table.is_empty() { table.dimensions() } else { load::dimensions(&table, request.dim)? };
            if dim != particles.dim && !table.is_empty() {
                let (source, theirs, own) = (&table.source, dim, particles.dim);
                return Err(Failure::input(format!(
                    "{source}: its points have {theirs} coordinates, the particles of {} have {own}",
                    particles.source
                )));
            }
            Ok(Points { coordinates: table.coordinates, grid: None })
        }
        SamplePoints::Grid { counts, bounds } => grid(counts, bounds.as_deref(), particles),
    }
}

fn grid(counts: &[usize], bounds: Option<&[f64]>, particles: &Particles) -> Result<Points, Failure> {
    let dim = particles.dim;
    if counts.len() != dim {
        return Err(Failure::input(format!(
            "{}: the particles have {dim} dimensions, --grid {} has {}",
            particles.source,
            counts.iter().map(usize::to_string).collect::<Vec<_>>().join(","),
            counts.len()
        )));
    }
    let (lower, upper): (Vec<f64>, Vec<f64>) = match bounds {
        Some(bounds) => (bounds[..dim].to_vec(), bounds[dim..].to_vec()),
        None => particles.coordinates.iter().take(dim).map(|axis| load::bounds(axis)).unzip(),
    };
    let grid = Grid::new(counts, &lower, &upper).map_err(|error| {
        let hint = if bounds.is_none() { ": give the box with --bounds" } else { "" };
        Failure::input(format!("{}: {error}{hint}", particles.source))
    })?;
    let coordinates = grid.coordinates().into_iter().map(|column| column.values).collect();
    Ok(Points { coordinates, grid: Some(grid) })
}

/// Refuses what cannot fit in memory, before anything is read.
pub(super) fn refuse_oversize(request: &Request) -> Result<(), Failure> {
    let fields = request.quantities.len().max(1) as f64 + 1.0;
    let particles = match &request.particles {
        ParticleSource::Demo(_, Some(particles)) => *particles as f64,
        _ => 0.0,
    };
    let (points, dim): (f64, _) = match &request.at {
        SamplePoints::Grid { counts, .. } => (counts.iter().map(|&n| n as f64).product(), counts.len()),
        SamplePoints::AtParticles => (particles, 3),
        SamplePoints::At(_) => (0.0, 3),
    };
    let columns = fields * (1.0 + if request.gradient { dim as f64 } else { 0.0 });
    // coordinates and columns as f64, the columns once more while they are gathered; a built-in set's particles likewise
    let bytes = points * 8.0 * (dim as f64 + 2.0 * columns) + particles * 8.0 * 16.0;
    // Where the system does not say, there is nothing to refuse by.
    let Ok(mut system) = System::new() else { return Ok(()) };
    system.refresh_memory();
    let available = system.available_memory() as f64;
    if bytes <= available {
        return Ok(());
    }
    let gigabytes = |bytes: f64| format!("{:.3} GB", bytes / 1e9);
    Err(Failure::input(format!(
        "the result has {points} points{} and needs {}, but {} of memory are free",
        if particles > 0.0 { format!(" from {particles} particles") } else { String::new() },
        gigabytes(bytes),
        gigabytes(available)
    )))
}
