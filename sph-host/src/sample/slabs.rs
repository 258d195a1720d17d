//! A file larger than memory: one slab of space at a time.
//!
//! The file is read twice, some particles at a time. The first time says what it spans, and so where slabs across its longest
//! axis hold about as many particles each; the second time writes every particle to a temporary file for each slab that it
//! matters to, and must read the same numbers. What is summed within a slab depends on nothing beyond 2 h on both sides of it: sums reach h, and the densities
//! in them h more. Each slab is then evaluated as if it were all there is.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

use super::error::SampleError;
use super::outline::Outline;
use super::particles::{Particles, Support, Values};
use super::planes;
use super::points::Points;
use super::request::Request;
use super::span::Span;
use super::table;
use crate::io::Pieces;

/// Margin over what sums can depend on, for the rounding of distances in the coarsest scalar.
const MARGIN: f64 = 1.01;

/// Particles in a temporary file, slab by slab.
pub(super) struct Slabs {
    /// The axis in space that slabs lie across.
    axis: usize,
    /// Where one slab ends and the next begins, ascending.
    cuts: Vec<f64>,
    /// How far from a slab particles matter to it.
    reach: f64,
    spool: File,
    /// Of each slab, where its rows are in the temporary file: offset and bytes.
    segments: Vec<Vec<(u64, usize)>>,
}

impl Slabs {
    /// Reads the particles of a file, `most` at a time, into slabs that own about `most` particles each; what all of them span,
    /// and the axes that sums run over.
    pub(super) fn read(
        path: &Path,
        most: usize,
        request: &Request,
    ) -> Result<(Self, Span, Vec<usize>), SampleError> {
        let first = FirstReading::new(path, most, request)?;
        Self::read_again(path, most, request, &first)
    }

    /// Reads the file for the second time.
    fn read_again(
        path: &Path,
        most: usize,
        request: &Request,
        first: &FirstReading,
    ) -> Result<(Self, Span, Vec<usize>), SampleError> {
        let empty = || SampleError::NoParticles { file: path.display().to_string() };
        let span = first.outline.span()?.ok_or_else(empty)?;
        let axes = planes::axes(&span.file, &span.coordinates, request.dim)?;
        let extent = |axis: usize| span.coordinates[axis].1 - span.coordinates[axis].0;
        let longest = axes.iter().copied().max_by(|&a, &b| extent(a).total_cmp(&extent(b)));
        let axis = longest.unwrap_or(0);
        let cuts = first.outline.cuts(axis, span.count.div_ceil(most.max(1)));
        let (lower, upper) = span.coordinates[axis];
        // positions are rounded to the scalar, which has 23 bits for what all span at least
        let rounding = (upper - lower) * 2_f64.powi(-20);
        let reach = 2.0 * (MARGIN * span.supports.1 + rounding);
        let spool = tempfile::tempfile().map_err(no_spool)?;
        let segments = vec![Vec::new(); cuts.len() + 1];
        let mut slabs = Self { axis, cuts, reach, spool, segments };
        let changed = || SampleError::Changed { file: path.display().to_string() };
        let mut digest = 0;
        for piece in Pieces::open(path, most)? {
            let particles = table::particles(piece?, None, request)?;
            if in_columns(&particles).len() != first.columns {
                return Err(changed());
            }
            digest = add_to_digest(digest, &particles);
            slabs.write(&particles).map_err(no_spool)?;
        }
        if digest == first.digest { Ok((slabs, span, axes)) } else { Err(changed()) }
    }

    /// The numbers of the points in each slab.
    pub(super) fn points_of_each(&self, points: &Points) -> Vec<Vec<usize>> {
        let mut numbers = vec![Vec::new(); self.segments.len()];
        for (number, &x) in points.along(self.axis).iter().enumerate() {
            numbers[self.cuts.partition_point(|&cut| cut <= x)].push(number);
        }
        numbers
    }

    /// The slabs that a particle matters to.
    fn concerned(&self, x: f64) -> Range<usize> {
        let first = self.cuts.partition_point(|&cut| cut + self.reach < x);
        let last = self.cuts.partition_point(|&cut| cut - self.reach <= x);
        first..last + 1
    }

    fn write(&mut self, particles: &Particles) -> io::Result<()> {
        let columns = in_columns(particles);
        let mut rows = vec![Vec::new(); self.segments.len()];
        for row in 0..particles.len() {
            for slab in self.concerned(columns[self.axis][row]) {
                for column in &columns {
                    rows[slab].extend(column[row].to_le_bytes());
                }
            }
        }
        for (segments, rows) in self.segments.iter_mut().zip(&rows).filter(|(_, rows)| !rows.is_empty()) {
            segments.push((self.spool.stream_position()?, rows.len()));
            self.spool.write_all(rows)?;
        }
        Ok(())
    }

    /// The particles that matter to a slab, of all that span this.
    pub(super) fn load(&mut self, slab: usize, span: &Span) -> Result<Particles, SampleError> {
        let special = usize::from(span.masses.is_some()) + usize::from(span.densities.is_some());
        let own = usize::from(!span.is_uniform);
        let width = span.coordinates.len() + special + own + span.fields.len();
        let columns = self.columns(slab, width).map_err(no_spool)?;
        Ok(from_columns(columns, span))
    }

    fn columns(&mut self, slab: usize, width: usize) -> io::Result<Vec<Vec<f64>>> {
        let mut columns = vec![Vec::new(); width];
        for &(offset, bytes) in &self.segments[slab] {
            let mut rows = vec![0; bytes];
            self.spool.seek(SeekFrom::Start(offset))?;
            self.spool.read_exact(&mut rows)?;
            for row in rows.as_chunks::<8>().0.chunks_exact(width) {
                for (column, &value) in columns.iter_mut().zip(row) {
                    column.push(f64::from_le_bytes(value));
                }
            }
        }
        Ok(columns)
    }
}

/// What was read of a file for the first time.
struct FirstReading {
    outline: Outline,
    /// How many numbers a particle has.
    columns: usize,
    /// Of all numbers, in their order.
    digest: u64,
}

impl FirstReading {
    fn new(path: &Path, most: usize, request: &Request) -> Result<Self, SampleError> {
        let mut reading = Self { outline: Outline::default(), columns: 0, digest: 0 };
        for piece in Pieces::open(path, most)? {
            let piece = piece?;
            table::check_coordinates(&piece)?;
            let particles = table::particles(piece, None, request)?;
            reading.columns = in_columns(&particles).len();
            reading.digest = add_to_digest(reading.digest, &particles);
            reading.outline.add(&particles)?;
        }
        Ok(reading)
    }
}

/// Goes on with a digest: other numbers, or as many in another order, give another one but for one chance in 2⁶⁴.
fn add_to_digest(digest: u64, particles: &Particles) -> u64 {
    let columns = in_columns(particles);
    (0..particles.len()).fold(digest, |digest, row| {
        columns.iter().fold(digest, |digest, column| {
            (digest.rotate_left(5) ^ column[row].to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        })
    })
}

fn no_spool(error: io::Error) -> SampleError {
    SampleError::Spool { folder: std::env::temp_dir(), error }
}

/// All numbers of the particles.
fn in_columns(particles: &Particles) -> Vec<&[f64]> {
    let own = match &particles.support {
        Support::Uniform(_) => None,
        Support::PerParticle(radii) => Some(radii),
    };
    let coordinates = particles.coordinates.iter();
    let special = [&particles.masses, &particles.densities].into_iter().flatten().chain(own);
    let quantities = particles.quantities.iter().map(|quantity| &quantity.values);
    coordinates.chain(special).chain(quantities).map(Vec::as_slice).collect()
}

/// Particles of the numbers that [`in_columns`] gives of such as span this.
fn from_columns(columns: Vec<Vec<f64>>, span: &Span) -> Particles {
    let mut columns = columns.into_iter();
    let mut next = || columns.next().unwrap_or_default();
    Particles {
        file: span.file.clone(),
        coordinates: span.coordinates.iter().map(|_| next()).collect(),
        masses: span.masses.map(|_| next()),
        densities: span.densities.map(|_| next()),
        support: if span.is_uniform {
            Support::Uniform(span.supports.0)
        } else {
            Support::PerParticle(next())
        },
        quantities: (span.fields.iter())
            .map(|field| Values {
                name: field.name.clone(),
                quantity: field.quantity.clone(),
                values: next(),
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate_choice::Estimate;
    use crate::kernel_choice::KernelName;
    use crate::sample::request::{ParticleSource, SamplePoints, SupportFrom};
    use crate::scalar_choice::ScalarName;

    fn request(path: &Path) -> Request {
        Request {
            particles: ParticleSource::File(path.to_owned()),
            at: SamplePoints::Grid { counts: vec![2, 2], bounds: None },
            kernel: KernelName::Poly6,
            dim: None,
            quantities: Vec::new(),
            gradient: false,
            surface: None,
            support: Some(SupportFrom::Radius(0.5)),
            estimate: Estimate::Plain,
            mass: None,
            recompute_density: false,
            scalar: ScalarName::F64,
            threads: None,
            chunk: Some(2),
            exact: false,
        }
    }

    #[test]
    fn a_file_that_changed_between_its_readings_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.csv");
        let request = request(&path);
        let read = |text: &str, later: &str| {
            std::fs::write(&path, text).unwrap();
            let first = FirstReading::new(&path, 2, &request).unwrap();
            std::fs::write(&path, later).unwrap();
            Slabs::read_again(&path, 2, &request, &first).map(|(slabs, ..)| slabs.segments.len())
        };
        let text = "x,y,m\n0,0,1\n1,0,1\n0,1,1\n";
        assert!(read(text, text).is_ok());
        for later in [
            "x,y,m\n0,0,1\n1,0,1\n",
            "x,y,m\n0,0,1\n1,0,1\n0,1,1\n2,2,1\n",
            "x,y,m\n0,0,1\n1,0,1\n0,1,2\n",
            "x,y,m\n1,0,1\n0,0,1\n0,1,1\n",
            "x,y,z,m\n0,0,0,1\n1,0,0,1\n0,1,0,1\n",
        ] {
            let error = read(text, later).unwrap_err();
            assert!(matches!(error, SampleError::Changed { .. }), "{later}: {error}");
            assert!(error.to_string().contains("p.csv: changed"), "{error}");
        }
    }
}
