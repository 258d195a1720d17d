//! Particles that are seen some at a time: what they span, and a sample of where they are.

use super::error::SampleError;
use super::particles::Particles;
use super::span::Span;

/// What particles span, and a sample of their places.
#[derive(Default)]
pub(super) struct Outline {
    span: Option<Span>,
    sample: Vec<Sampled>,
    /// A number is in the sample where its scattered bits have none of these.
    coarseness: u64,
}

/// A particle of the sample: its scattered number and its place.
struct Sampled {
    bits: u64,
    at: Vec<f64>,
}

/// Most particles in the sample.
const MOST_SAMPLED: usize = 1 << 16;

impl Outline {
    /// Takes in some particles.
    pub(super) fn add(&mut self, particles: &Particles) -> Result<(), SampleError> {
        let before = self.span.as_ref().map_or(0, |span| span.count);
        for row in 0..particles.len() {
            self.sample(before + row, particles, row);
        }
        let more = Span::of(particles);
        self.span = Some(match self.span.take() {
            None => more,
            Some(span) => span.join(&more)?,
        });
        Ok(())
    }

    fn sample(&mut self, number: usize, particles: &Particles, row: usize) {
        let bits = (number as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(32);
        if bits & self.coarseness == 0 {
            let at = particles.coordinates.iter().map(|axis| axis[row]).collect();
            self.sample.push(Sampled { bits, at });
        }
        if self.sample.len() > MOST_SAMPLED {
            self.coarseness = 2 * self.coarseness + 1;
            let coarseness = self.coarseness;
            self.sample.retain(|sampled| sampled.bits & coarseness == 0);
        }
    }

    /// What all particles span, whose extent is a number; `None` before the first.
    pub(super) fn span(&self) -> Result<Option<Span>, SampleError> {
        self.span.as_ref().map(|span| span.check().map(|()| span.clone())).transpose()
    }

    /// Where to cut an axis into at most so many slabs that own about as many particles each.
    pub(super) fn cuts(&self, axis: usize, slabs: usize) -> Vec<f64> {
        let mut along: Vec<f64> = self.sample.iter().map(|sampled| sampled.at[axis]).collect();
        along.sort_unstable_by(f64::total_cmp);
        let mut cuts: Vec<f64> = (1..slabs).map(|slab| along[slab * along.len() / slabs]).collect();
        cuts.dedup();
        cuts
    }
}
