//! What would not fit in memory.

use super::error::SampleError;
use super::request::{ParticleSource, Request, SamplePoints};
use crate::memory;

/// Refuses what cannot fit in memory, before anything is read.
pub(super) fn refuse_oversize(request: &Request) -> Result<(), SampleError> {
    let fields = request.quantities.len().max(1) as f64 + 1.0;
    let particles = match &request.particles {
        ParticleSource::Demo(_, count) => *count,
        ParticleSource::File(_) => None,
    };
    let count = particles.map_or(0.0, |count| count as f64);
    let (points, dim): (f64, _) = match &request.at {
        SamplePoints::Grid { counts, .. } => (counts.iter().map(|&n| n as f64).product(), counts.len()),
        SamplePoints::AtParticles => (count, 3),
        SamplePoints::At(_) => (0.0, 3),
    };
    let points = request.part.map_or(points, |part| (points / part.part.of() as f64).ceil());
    let columns = fields * (1.0 + if request.gradient { dim as f64 } else { 0.0 });
    // coordinates and columns as f64; a built-in set's particles with what sums need of them
    let needed = points * 8.0 * (dim as f64 + columns) + count * 8.0 * 16.0;
    let Some(available) = memory::short_of(needed) else { return Ok(()) };
    Err(SampleError::TooLarge { points, at: Box::new(request.at.clone()), particles, needed, available })
}
