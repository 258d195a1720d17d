//! From files and built-in sets to tables, nothing in them checked.

use super::error::SampleError;
use super::only::Taken;
use super::particles::Particles;
use super::periodic::PeriodicBox;
use super::request::{ParticleSource, Request, SamplePoints};
use super::table;
use super::warning::Warning;
use crate::demo;
use crate::io::{AtHand, InputFile, PointTable, ReadError};

/// The particles and points of a request as they were read.
pub(super) struct Tables {
    pub(super) particles: Input,
    /// The table of points, where they have one of their own.
    pub(super) points: Option<PointTable>,
}

/// A table of particles.
pub(super) enum Input {
    /// Those of it that are wanted, how many these are, and the support radius of a built-in set.
    Whole(PointTable, Taken, Option<f64>),
    /// A file to be read so many rows at a time, twice.
    Pieces(PieceByPiece),
}

/// A file that is read so many rows at a time.
pub(super) struct PieceByPiece {
    pub(super) file: AtHand,
    pub(super) most: usize,
}

impl PieceByPiece {
    /// Makes the file ready to be read more than once.
    pub(super) fn new(file: &InputFile, most: usize) -> Result<Self, SampleError> {
        Ok(Self { file: file.at_hand()?, most })
    }

    /// Calls `f` with the particles of each piece that has some: those that are wanted, checked, and with their images.
    pub(super) fn each(
        &self,
        request: &Request,
        periodic: Option<&PeriodicBox>,
        mut f: impl FnMut(Particles) -> Result<(), SampleError>,
    ) -> Result<Taken, SampleError> {
        let mut taken = Taken::default();
        for piece in self.file.pieces(self.most)? {
            let table = taken.choose(piece?, &request.only)?;
            if table.is_empty() {
                continue;
            }
            table::check_coordinates(&table)?;
            let particles = table::particles(table, None, request)?;
            f(match periodic {
                Some(periodic) => periodic.with_images(particles),
                None => particles,
            })?;
        }
        taken.require_some(self.file.name(), &request.only)?;
        Ok(taken)
    }
}

impl Tables {
    /// What the files have to say.
    pub(super) fn notes(&self) -> Vec<Warning> {
        let particles = match &self.particles {
            Input::Whole(table, ..) => Some(table),
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

/// The points of a file: by the names that the particles' coordinates have, or else by usual ones.
fn points(file: &InputFile) -> Result<PointTable, SampleError> {
    match file.read() {
        Err(ReadError::Position { .. }) if !file.position.is_empty() && !file.is_standard_input() => {
            Ok(InputFile { position: Vec::new(), ..file.clone() }.read()?)
        }
        read => Ok(read?),
    }
}

/// Reads the tables of a request.
pub(super) fn read(request: &Request) -> Result<Tables, SampleError> {
    if let (ParticleSource::File(particles), SamplePoints::At(points)) = (&request.particles, &request.at)
        && particles.is_standard_input()
        && points.is_standard_input()
    {
        return Err(SampleError::StandardInputTwice);
    }
    let mut taken = Taken::default();
    let particles = match (&request.particles, request.chunk) {
        (ParticleSource::File(file), Some(most)) => Input::Pieces(PieceByPiece::new(file, most)?),
        (ParticleSource::File(file), None) => {
            Input::Whole(taken.choose(file.read()?, &request.only)?, taken, None)
        }
        (ParticleSource::Demo(name, count), _) => {
            let unknown = || SampleError::UnknownSet { name: name.clone() };
            let set = demo::set(name, *count).ok_or_else(unknown)?;
            Input::Whole(taken.choose(set.table, &request.only)?, taken, Some(set.support_radius))
        }
    };
    if let Input::Whole(table, taken, _) = &particles {
        taken.require_some(&table.source, &request.only)?;
    }
    let points = match &request.at {
        SamplePoints::At(file) => Some(points(file)?),
        SamplePoints::Grid { .. } | SamplePoints::AtParticles => None,
    };
    Ok(Tables { particles, points })
}
