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

use super::evaluate::{Evaluated, columns, names};
use super::load::{self, Particles, Support, Values};
use super::outline::Outline;
use super::points::Points;
use super::request::Request;
use crate::failure::Failure;
use crate::io::Pieces;
use crate::output::Column;
use crate::progress::Progress;

/// Margin over what sums can depend on, for the rounding of distances.
const MARGIN: f64 = 1.001;

/// Particles in a temporary file, slab by slab.
pub(super) struct Slabs {
    outline: Outline,
    axis: usize,
    /// Where one slab ends and the next begins, ascending.
    cuts: Vec<f64>,
    spool: File,
    /// Of each slab, where its rows are in the temporary file: offset and bytes.
    segments: Vec<Vec<(u64, usize)>>,
}

impl Slabs {
    /// Reads the particles of a file, `most` at a time, into slabs that own about `most` particles each.
    pub(super) fn read(path: &Path, most: usize, request: &Request) -> Result<Self, Failure> {
        let mut outline = Outline::default();
        for piece in Pieces::open(path, most)? {
            outline.add(&load::checked(piece?, None, request)?)?;
        }
        let source = path.display();
        outline.check().map_err(|problem| Failure::input(format!("{source}: {problem}")))?;
        let (axis, cuts) = outline.cuts(outline.count().div_ceil(most.max(1)));
        let spool = tempfile::tempfile().map_err(no_spool)?;
        let segments = vec![Vec::new(); cuts.len() + 1];
        let mut slabs = Self { outline, axis, cuts, spool, segments };
        for piece in Pieces::open(path, most)? {
            slabs.write(&load::checked(piece?, None, request)?).map_err(no_spool)?;
        }
        Ok(slabs)
    }

    /// What all particles are like, with two of them at opposite corners of the box.
    pub(super) fn corners(&self) -> Result<Particles, Failure> {
        self.outline.corners().ok_or_else(|| Failure::input("there are no particles"))
    }

    /// How many particles there are.
    pub(super) fn count(&self) -> usize {
        self.outline.count()
    }

    /// Evaluates a request, slab after slab.
    pub(super) fn evaluate(
        &mut self,
        request: &Request,
        points: &Points,
        progress: &dyn Progress,
    ) -> Result<Evaluated, Failure> {
        let corners = self.corners()?;
        let names = names(&corners, request.gradient);
        let mut done = Evaluated { columns: columns(names, &[]), ..Evaluated::default() };
        done.columns.iter_mut().for_each(|column| column.values = vec![f64::NAN; points.len()]);
        let mut numbers = vec![Vec::new(); self.segments.len()];
        for (number, &x) in points.along(self.axis).iter().enumerate() {
            numbers[self.cuts.partition_point(|&cut| cut <= x)].push(number);
        }
        for (slab, numbers) in numbers.iter().enumerate().filter(|(_, numbers)| !numbers.is_empty()) {
            let particles = self.load(slab, &corners).map_err(no_spool)?;
            let part = super::evaluate(request, &particles, &points.some(numbers), progress)?;
            for (Column { values, .. }, part) in done.columns.iter_mut().zip(&part.columns) {
                numbers.iter().zip(&part.values).for_each(|(&number, &value)| values[number] = value);
            }
            done.counts = done.counts + part.counts;
            done.search_seconds += part.search_seconds;
            done.evaluate_seconds += part.evaluate_seconds;
        }
        Ok(done)
    }

    /// The slabs that a particle matters to.
    fn concerned(&self, x: f64) -> Range<usize> {
        let reach = 2.0 * MARGIN * self.outline.reach();
        let first = self.cuts.partition_point(|&cut| cut + reach < x);
        let last = self.cuts.partition_point(|&cut| cut - reach <= x);
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

    fn load(&mut self, slab: usize, like: &Particles) -> io::Result<Particles> {
        let width = in_columns(like).len();
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
        Ok(from_columns(columns, like))
    }
}

fn no_spool(error: io::Error) -> Failure {
    Failure::input(format!("a temporary file in {}: {error}", std::env::temp_dir().display()))
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

/// Particles of the numbers that [`in_columns`] gives of such as `like`.
fn from_columns(columns: Vec<Vec<f64>>, like: &Particles) -> Particles {
    let mut columns = columns.into_iter();
    let mut next = || columns.next().unwrap_or_default();
    Particles {
        source: like.source.clone(),
        dim: like.dim,
        coordinates: like.coordinates.iter().map(|_| next()).collect(),
        masses: like.masses.as_ref().map(|_| next()),
        densities: like.densities.as_ref().map(|_| next()),
        support: match &like.support {
            Support::Uniform(h) => Support::Uniform(*h),
            Support::PerParticle(_) => Support::PerParticle(next()),
        },
        quantities: (like.quantities.iter())
            .map(|quantity| Values { name: quantity.name.clone(), values: next() })
            .collect(),
    }
}
