//! The particles of a study, and those around some of them.

use sph_core::{CellGrid, CellLayout, Neighbours, Sources};

use super::costs;
use super::error::StudyError;
use crate::kernel_choice::{AnyInfluence, Influences, KernelName};
use crate::parallel;
use crate::sample::{ParticleSet, SampleError, cells};

/// How much farther than h particles count as near, in h: rounding moves them by less.
pub(super) const REACH: f64 = 1.25;

/// All particles in the file's units.
#[derive(Clone, Debug, Default)]
pub(super) struct Set<const D: usize> {
    pub(super) file: String,
    pub(super) positions: Vec<[f64; D]>,
    /// m_j
    pub(super) masses: Vec<f64>,
    /// V_j = m_j / ρ_j
    pub(super) volumes: Vec<f64>,
    /// h for all, or of each.
    pub(super) supports: Vec<f64>,
    /// The fields' names and values.
    pub(super) fields: Vec<(String, Vec<f64>)>,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

/// The particles near some of them: all that sums at these need.
#[derive(Clone, Debug)]
pub(super) struct Patch<const D: usize> {
    pub(super) set: Set<D>,
    /// Where the sums are made: numbers in the set.
    pub(super) points: Vec<usize>,
    /// The numbers of the particles near each point.
    pub(super) near: Vec<Vec<usize>>,
}

impl<const D: usize> Set<D> {
    /// Checks particles and sums the densities that they come without.
    pub(super) fn new(read: ParticleSet) -> Result<Self, StudyError> {
        let along: [&[f64]; D] = std::array::from_fn(|axis| &read.coordinates[axis][..]);
        let count = along[0].len();
        let positions: Vec<[f64; D]> = (0..count).map(|j| along.map(|axis| axis[j])).collect();
        let masses = read.masses.ok_or_else(|| SampleError::NoMass { file: read.file.clone() })?;
        let mut fields = read.fields;
        if fields.is_empty() {
            fields.push((String::from("1"), vec![1.0; count]));
        }
        let mut set =
            Self { file: read.file, positions, masses, supports: read.supports, fields, ..Self::default() };
        set.sort_into_cells()?;
        let densities = match read.densities {
            Some(densities) => densities,
            None => set.densities(read.kernel)?,
        };
        set.volumes = set.masses.iter().zip(&densities).map(|(m, rho)| m / rho).collect();
        match set.volumes.iter().position(|volume| !(volume.is_finite() && *volume > 0.0)) {
            Some(particle) => {
                let (file, density) = (set.file, densities[particle]);
                Err(StudyError::Density { file, particle, density })
            }
            None => Ok(set),
        }
    }

    /// Bare positions.
    #[cfg(test)]
    pub(super) fn of_positions(positions: Vec<[f64; D]>) -> Self {
        Self { positions, ..Self::default() }
    }

    /// Bytes of a particle in numbers of so many bits.
    pub(super) fn bytes(&self, bits: u32) -> u32 {
        let has_masses = self.masses.iter().any(|mass| *mass != self.masses[0]);
        costs::bytes(bits, D, self.fields.len(), has_masses)
    }

    /// h of particle j.
    pub(super) fn support(&self, j: usize) -> f64 {
        self.supports[if self.supports.len() == 1 { 0 } else { j }]
    }

    /// The largest h.
    pub(super) fn reach(&self) -> f64 {
        self.supports.iter().copied().fold(0.0, f64::max)
    }

    /// The corners of the particles' box.
    pub(super) fn corners(&self) -> [[f64; D]; 2] {
        let start = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
        self.positions.iter().fold(start, |[lower, upper], x| {
            [
                std::array::from_fn(|axis| lower[axis].min(x[axis])),
                std::array::from_fn(|axis| upper[axis].max(x[axis])),
            ]
        })
    }

    fn layout(&self) -> Result<CellLayout<f64, D>, StudyError> {
        let ([lower, mut upper], reach) = (self.corners(), self.reach());
        let boxes: [(f64, f64); D] = std::array::from_fn(|axis| (lower[axis], upper[axis]));
        let counts = cells(&boxes, reach, self.positions.len());
        let cells = std::array::from_fn(|axis| {
            if upper[axis] == lower[axis] {
                upper[axis] += reach;
            }
            counts[axis]
        });
        CellLayout::bounded(&lower, &upper, cells).map_err(|error| self.failed(error))
    }

    fn failed(&self, error: sph_core::Error) -> StudyError {
        StudyError::Sums { file: self.file.clone(), error }
    }

    fn sort_into_cells(&mut self) -> Result<(), StudyError> {
        let layout = self.layout()?;
        let (mut starts, mut entries) = (vec![0; layout.cells() + 1], vec![0; self.positions.len()]);
        CellGrid::build(layout, &self.positions, &mut starts, &mut entries)
            .map_err(|error| self.failed(error))?;
        (self.starts, self.entries) = (starts, entries);
        Ok(())
    }

    fn search(&self, layout: CellLayout<f64, D>) -> CellGrid<'_, f64, u32, D> {
        CellGrid::from_sorted(layout, &self.positions, &self.starts, &self.entries)
    }

    /// ρ of each particle.
    fn densities(&self, kernel: KernelName) -> Result<Vec<f64>, StudyError> {
        let influences: Result<Vec<_>, _> =
            self.supports.iter().map(|&h| AnyInfluence::<f64, D>::new(kernel, h)).collect();
        let influences = influences.map_err(|error| self.failed(error))?;
        let influences = match &influences[..] {
            [one] => Influences::uniform(one),
            each => Influences::per_sample(each),
        };
        let search = self.search(self.layout()?);
        let sources = Sources::new(search, &self.masses[..]).map_err(|error| self.failed(error))?;
        let mut densities = vec![0.0; self.positions.len()];
        parallel::fill(&mut densities, |i| sources.density_at(influences, &self.positions[i]));
        Ok(densities)
    }

    /// The particles near those of these numbers.
    pub(super) fn around(&self, points: &[usize]) -> Result<Patch<D>, StudyError> {
        let (layout, reach) = (self.layout()?, REACH * self.reach());
        let search = self.search(layout);
        let mut place = vec![usize::MAX; self.positions.len()];
        let mut numbers = Vec::new();
        let mut placed = |j: usize| {
            if place[j] == usize::MAX {
                place[j] = numbers.len();
                numbers.push(j);
            }
            place[j]
        };
        let near = points.iter().map(|&i| {
            let mut near = Vec::new();
            search.for_each(&self.positions[i], reach, |neighbour| near.push(placed(neighbour.index)));
            near
        });
        let near = near.collect();
        let points = points.iter().map(|&i| placed(i)).collect();
        let pick = |values: &[f64]| numbers.iter().map(|&j| values[j]).collect();
        let set = Self {
            file: self.file.clone(),
            positions: numbers.iter().map(|&j| self.positions[j]).collect(),
            masses: pick(&self.masses),
            volumes: pick(&self.volumes),
            supports: if self.supports.len() == 1 { self.supports.clone() } else { pick(&self.supports) },
            fields: self.fields.iter().map(|(name, values)| (name.clone(), pick(values))).collect(),
            starts: Vec::new(),
            entries: Vec::new(),
        };
        Ok(Patch { set, points, near })
    }
}

impl<const D: usize> Patch<D> {
    /// The mean number of particles in reach of a point, itself included.
    pub(super) fn neighbours(&self) -> f64 {
        let set = &self.set;
        let in_reach = |i: usize, j: usize| {
            let (x, y, h) = (&set.positions[i], &set.positions[j], set.support(j));
            sph_core::vector::norm_squared(&sph_core::vector::sub(x, y)) < h * h
        };
        let each = self.points.iter().zip(&self.near);
        let all: usize = each.map(|(&i, near)| near.iter().filter(|&&j| in_reach(i, j)).count()).sum();
        all as f64 / self.points.len().max(1) as f64
    }
}

/// At most `most` numbers below `count`, evenly spread, the first and the last among them.
pub(super) fn spread(count: usize, most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    (0..most).map(|k| k * (count - 1) / (most - 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_goes_from_end_to_end_without_repeats() {
        assert_eq!(spread(3, 64), [0, 1, 2]);
        let some = spread(1000, 64);
        assert_eq!((some.len(), some[0], some[63]), (64, 0, 999));
        assert!(some.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
