//! From files and built-in sets to tables, nothing in them checked.

use std::path::PathBuf;

use super::error::{SampleError, Warning};
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

impl Tables {
    /// What the files have to say.
    pub(super) fn notes(&self) -> Vec<Warning> {
        let particles = match &self.particles {
            Input::Whole(table, _) => Some(table),
            Input::Pieces(..) => None,
        };
        let of = |table: &PointTable| {
            let file = table.source.clone();
            table
                .notes
                .iter()
                .map(move |note| Warning::Note { file: file.clone(), note: note.clone() })
                .collect::<Vec<_>>()
        };
        particles.into_iter().chain(&self.points).flat_map(of).collect()
    }
}

/// Reads the tables of a request.
pub(super) fn read(request: &Request) -> Result<Tables, SampleError> {
    let particles = match (&request.particles, request.chunk) {
        (ParticleSource::File(path), Some(most)) => Input::Pieces(path.clone(), most),
        (ParticleSource::File(path), None) => {
            Input::Whole(io::read_group(path, request.group.as_deref())?, None)
        }
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
