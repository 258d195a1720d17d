//! A file larger than memory: one slab of space at a time.
//!
//! The file is read twice, some particles at a time, and once more where a box is periodic, whose images depend on all h. The first
//! time says what it spans, and so where slabs across its longest axis hold about as many particles each; the last time writes every particle to a temporary file for each slab that it
//! matters to, and must read the same numbers. What is summed within a slab depends on nothing beyond 2 h on both sides of it: sums reach h, and the densities
//! in them h more. Each slab is then evaluated as if it were all there is.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::Range;

use super::error::SampleError;
use super::only::Taken;
use super::outline::Outline;
use super::particles::{Particles, Support, Values};
use super::periodic::PeriodicBox;
use super::planes;
use super::points::Points;
use super::read::PieceByPiece;
use super::region::{self, Region};
use super::request::Request;
use super::span::Span;

/// Particles in a temporary file, slab by slab.
pub(super) struct Slabs {
    /// The coordinate that slabs lie across, and its axis in space.
    across: usize,
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
    /// Reads the file for the last time: those of its particles that matter in a region, or all.
    pub(super) fn read(
        file: &PieceByPiece,
        request: &Request,
        first: &FirstReading,
        region: Option<&Region>,
    ) -> Result<Self, SampleError> {
        let FirstReading { span, axes, .. } = first;
        let extent = |axis: usize| span.coordinates[axis].1 - span.coordinates[axis].0;
        let longest = axes.iter().copied().max_by(|&a, &b| extent(a).total_cmp(&extent(b)));
        let across = longest.unwrap_or(0);
        let cuts = first.outline.cuts(across, span.count.div_ceil(file.most.max(1)));
        let reach = region::reach(span, across);
        let spool = tempfile::tempfile().map_err(no_spool)?;
        let segments = vec![Vec::new(); cuts.len() + 1];
        let mut slabs = Self { across, axis: span.space[across], cuts, reach, spool, segments };
        let changed = || SampleError::Changed { file: span.file.clone() };
        let mut digest = 0;
        file.each(request, first.periodic.as_ref(), |particles| {
            if in_columns(&particles).len() != first.columns {
                return Err(changed());
            }
            digest = add_to_digest(digest, &particles);
            slabs.write(&particles, region).map_err(no_spool)
        })?;
        if digest == first.digest { Ok(slabs) } else { Err(changed()) }
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

    fn write(&mut self, particles: &Particles, region: Option<&Region>) -> io::Result<()> {
        let columns = in_columns(particles);
        let mut rows = vec![Vec::new(); self.segments.len()];
        let matters = |row: &usize| region.is_none_or(|region| region.holds(particles, *row));
        for row in (0..particles.len()).filter(matters) {
            for slab in self.concerned(columns[self.across][row]) {
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

/// What is known of all particles of a file before they are put into slabs.
pub(super) struct FirstReading {
    /// What they span as they were read.
    pub(super) read: Span,
    /// What they span with their images.
    pub(super) span: Span,
    /// The axes that sums run over.
    pub(super) axes: Vec<usize>,
    pub(super) taken: Taken,
    pub(super) periodic: Option<PeriodicBox>,
    outline: Outline,
    /// How many numbers a particle has.
    columns: usize,
    /// Of all numbers, in their order.
    digest: u64,
}

impl FirstReading {
    /// Reads the file, and again where its box is periodic.
    pub(super) fn new(file: &PieceByPiece, request: &Request) -> Result<Self, SampleError> {
        let empty = || SampleError::NoParticles { file: file.file.name().to_owned() };
        let once = OneReading::new(file, request, None)?;
        let read = once.outline.span()?.ok_or_else(empty)?;
        let axes = planes::summed(&read, request.dim)?;
        let periodic = PeriodicBox::of(request, &read, &axes)?;
        let OneReading { outline, taken, columns, digest } = match &periodic {
            Some(periodic) => OneReading::new(file, request, Some(periodic))?,
            None => once,
        };
        let span = outline.span()?.ok_or_else(empty)?;
        Ok(Self { read, span, axes, taken, periodic, outline, columns, digest })
    }
}

/// What one reading of a file says.
struct OneReading {
    outline: Outline,
    taken: Taken,
    columns: usize,
    digest: u64,
}

impl OneReading {
    fn new(
        file: &PieceByPiece,
        request: &Request,
        periodic: Option<&PeriodicBox>,
    ) -> Result<Self, SampleError> {
        let (mut outline, mut columns, mut digest) = (Outline::default(), 0, 0);
        let taken = file.each(request, periodic, |particles| {
            columns = in_columns(&particles).len();
            digest = add_to_digest(digest, &particles);
            outline.add(&particles)
        })?;
        Ok(Self { outline, taken, columns, digest })
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
        space: span.space.clone(),
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

    fn request(path: &std::path::Path) -> Request {
        Request {
            particles: ParticleSource::File(path.into()),
            at: SamplePoints::Grid { counts: vec![2, 2], bounds: None },
            kernel: KernelName::Poly6,
            dim: None,
            quantities: Vec::new(),
            gradient: false,
            surface: None,
            support: Some(SupportFrom::Radius(0.5)),
            only: Vec::new(),
            periodic: None,
            part: None,
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
            let file = PieceByPiece::new(&path.as_path().into(), 2).unwrap();
            let first = FirstReading::new(&file, &request).unwrap();
            std::fs::write(&path, later).unwrap();
            Slabs::read(&file, &request, &first, None).map(|slabs| slabs.segments.len())
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
