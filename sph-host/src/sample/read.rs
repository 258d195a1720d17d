//! From files and built-in sets to tables, nothing in them checked.

use std::path::PathBuf;

use super::error::SampleError;
use super::request::{ParticleSource, Request, SamplePoints};
use crate::demo;
use crate::io::{self, PointTable};

/// The particles and points of a request as they were read.
pub(super) struct Tables {
    pub(super) particles: Input,
    /// The table of points, where they have one of their own.
    pub(super) points: Option<PointTable>,
}

/// A table of particles.
pub(super) enum Input {
    /// All of it, with the support radius of a built-in set.
    Whole(PointTable, Option<f64>),
    /// A file to be read so many rows at a time, twice.
    Pieces(PathBuf, usize),
}

/// Reads the tables of a request.
pub(super) fn read(request: &Request) -> Result<Tables, SampleError> {
    let particles = match (&request.particles, request.chunk) {
        (ParticleSource::File(path), Some(most)) => Input::Pieces(path.clone(), most),
        (ParticleSource::File(path), None) => Input::Whole(io::read(path)?, None),
        (ParticleSource::Demo(name, count), _) => {
            let unknown = || SampleError::UnknownSet { name: name.clone() };
            let set = demo::set(name, *count).ok_or_else(unknown)?;
            Input::Whole(set.table, Some(set.support_radius))
        }
    };
    let points = match &request.at {
        SamplePoints::At(path) => Some(io::read(path)?),
        SamplePoints::Grid { .. } | SamplePoints::AtParticles => None,
    };
    Ok(Tables { particles, points })
}
