//! A file larger than memory: one slab of space at a time.
//!
//! The file is read twice, some particles at a time. The first time says what it spans, and so where slabs across its longest
//! axis hold about as many particles each; the second time writes every particle to a temporary file for each slab that it
//! matters to. What is summed within a slab depends on nothing beyond 2 h on both sides of it: sums reach h, and the densities
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
        let mut outline = Outline::default();
        for piece in Pieces::open(path, most)? {
            let piece = piece?;
            table::check_coordinates(&piece)?;
            outline.add(&table::particles(piece, None, request)?)?;
        }
        let empty = || SampleError::NoParticles { file: path.display().to_string() };
        let span = outline.span()?.ok_or_else(empty)?;
        let axes = planes::axes(&span.file, &span.coordinates, request.dim)?;
        let extent = |axis: usize| span.coordinates[axis].1 - span.coordinates[axis].0;
        let longest = axes.iter().copied().max_by(|&a, &b| extent(a).total_cmp(&extent(b)));
        let axis = longest.unwrap_or(0);
        let cuts = outline.cuts(axis, span.count.div_ceil(most.max(1)));
        let (lower, upper) = span.coordinates[axis];
        // positions are rounded to the scalar, which has 23 bits for what all span at least
        let rounding = (upper - lower) * 2_f64.powi(-20);
        let reach = 2.0 * (MARGIN * span.supports.1 + rounding);
        let spool = tempfile::tempfile().map_err(no_spool)?;
        let segments = vec![Vec::new(); cuts.len() + 1];
        let mut slabs = Self { axis, cuts, reach, spool, segments };
        for piece in Pieces::open(path, most)? {
            slabs.write(&table::particles(piece?, None, request)?).map_err(no_spool)?;
        }
        Ok((slabs, span, axes))
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
