//! Checked particles for other work than sampling.

use super::error::SampleError;
use super::particles::Support;
use super::planes;
use super::read::{self, Input};
use super::request::Request;
use super::table;
use crate::kernel_choice::KernelName;

/// Particles whose every number is finite, and positive where it must be.
#[derive(Clone, Debug)]
pub(crate) struct ParticleSet {
    /// The file or set, for messages.
    pub(crate) file: String,
    /// The coordinates along the axes that sums run over.
    pub(crate) coordinates: Vec<Vec<f64>>,
    /// m_i
    pub(crate) masses: Option<Vec<f64>>,
    /// ρ_i, unless they are to be summed.
    pub(crate) densities: Option<Vec<f64>>,
    /// h for all, or of each.
    pub(crate) supports: Vec<f64>,
    /// The fields' names and values.
    pub(crate) fields: Vec<(String, Vec<f64>)>,
    /// The kernel that densities are summed with.
    pub(crate) kernel: KernelName,
}

impl ParticleSet {
    /// The particles of a request that reads them at once.
    pub(crate) fn read(request: &Request) -> Result<Self, SampleError> {
        let (table, own_support) = match read::read(request)?.particles {
            Input::Whole(table, _, own_support) => (table, own_support),
            Input::Pieces(pieces) => {
                return Err(SampleError::PiecesAsPoints { file: pieces.file.name().to_owned() });
            }
        };
        table::check_coordinates(&table)?;
        let axes = planes::summed_of(&table, request.dim)?;
        let mut particles = table::particles(table, own_support, request)?;
        let coordinates =
            axes.into_iter().map(|axis| std::mem::take(&mut particles.coordinates[axis])).collect();
        Ok(Self {
            file: particles.file,
            coordinates,
            masses: particles.masses,
            densities: particles.densities,
            supports: match particles.support {
                Support::Uniform(h) => vec![h],
                Support::PerParticle(radii) => radii,
            },
            fields: particles.quantities.into_iter().map(|field| (field.name, field.values)).collect(),
            kernel: request.kernel,
        })
    }
}
