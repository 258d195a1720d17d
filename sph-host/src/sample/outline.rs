//! What particles span that are seen some at a time.

use super::load::{Particles, Support, Values, bounds};
use crate::failure::Failure;

/// The box, the reach and the number of particles, and a sample of where they are.
#[derive(Default)]
pub(super) struct Outline {
    /// Like the particles, with two at the corners of the box.
    corners: Option<Particles>,
    count: usize,
    reach: f64,
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
    pub(super) fn add(&mut self, particles: &Particles) -> Result<(), Failure> {
        let corners = match self.corners.take() {
            None => with_corners(particles),
            Some(corners) => joined(&corners, particles)?,
        };
        self.reach = self.reach.max(match &particles.support {
            Support::Uniform(h) => *h,
            Support::PerParticle(radii) => bounds(radii).1,
        });
        self.corners = Some(corners);
        for row in 0..particles.len() {
            self.sample(self.count + row, particles, row);
        }
        self.count += particles.len();
        Ok(())
    }

    fn sample(&mut self, number: usize, particles: &Particles, row: usize) {
        let bits = (number as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(32);
        if bits & self.coarseness == 0 {
            let at = particles.coordinates.iter().take(particles.dim).map(|axis| axis[row]).collect();
            self.sample.push(Sampled { bits, at });
        }
        if self.sample.len() > MOST_SAMPLED {
            self.coarseness = 2 * self.coarseness + 1;
            let coarseness = self.coarseness;
            self.sample.retain(|sampled| sampled.bits & coarseness == 0);
        }
    }

    /// That the box is finite, and flat along the axes that are not meant.
    pub(super) fn check(&self) -> Result<(), String> {
        let Some(corners) = &self.corners else { return Err("there are no particles in it".to_owned()) };
        for (axis, bounds) in corners.coordinates.iter().enumerate() {
            let name = ["x", "y", "z"][axis];
            let (lower, upper) = (bounds[0], bounds[1]);
            if !(upper - lower).is_finite() {
                return Err(format!("{name} spans from {lower} to {upper}, more than a number can say"));
            }
            if axis >= corners.dim && lower != upper {
                let dim = corners.dim;
                return Err(format!(
                    "{name} is {lower} and {upper}: --dim {dim} needs it to be the same everywhere"
                ));
            }
        }
        Ok(())
    }

    /// The longest axis, and where to cut it into at most so many slabs that own about as many particles each.
    pub(super) fn cuts(&self, slabs: usize) -> (usize, Vec<f64>) {
        let extent = |axis: &Vec<f64>| axis[1] - axis[0];
        let axes = self.corners.iter().flat_map(|corners| corners.coordinates.iter().take(corners.dim));
        let axis =
            axes.map(extent).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(axis, _)| axis);
        let mut along: Vec<f64> = self.sample.iter().map(|sampled| sampled.at[axis]).collect();
        along.sort_unstable_by(f64::total_cmp);
        let mut cuts: Vec<f64> = (1..slabs).map(|slab| along[slab * along.len() / slabs]).collect();
        cuts.dedup();
        (axis, cuts)
    }

    /// What the particles are like, with two of them at the corners of the box; None before the first.
    pub(super) fn corners(&self) -> Option<Particles> {
        self.corners.clone()
    }

    /// How many particles there were.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The largest support radius.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }
}

/// Two particles at the corners of a box, otherwise like the particles given.
fn with_corners(like: &Particles) -> Particles {
    let two = |values: &[f64]| {
        let (lower, upper) = bounds(values);
        vec![lower, upper]
    };
    Particles {
        source: like.source.clone(),
        dim: like.dim,
        coordinates: like.coordinates.iter().map(|axis| two(axis)).collect(),
        masses: like.masses.as_deref().map(two),
        densities: like.densities.as_deref().map(two),
        support: match &like.support {
            Support::Uniform(h) => Support::Uniform(*h),
            Support::PerParticle(radii) => Support::PerParticle(two(radii)),
        },
        quantities: (like.quantities.iter())
            .map(|quantity| Values { name: quantity.name.clone(), values: two(&quantity.values) })
            .collect(),
    }
}

/// Corners about those so far and more particles, which must have the same quantities.
fn joined(corners: &Particles, more: &Particles) -> Result<Particles, Failure> {
    let names = |particles: &Particles| -> Vec<String> {
        particles.quantities.iter().map(|quantity| quantity.name.clone()).collect()
    };
    let (before, now) = (names(corners), names(more));
    if before != now {
        return Err(Failure::input(format!(
            "{}: numbers are there of {} in some rows and of {} in others: say which by --quantity",
            more.source,
            before.join(", "),
            now.join(", ")
        )));
    }
    let mut both = corners.clone();
    for (axis, more) in both.coordinates.iter_mut().zip(&more.coordinates) {
        let (lower, upper) = bounds(more);
        *axis = vec![axis[0].min(lower), axis[1].max(upper)];
    }
    Ok(both)
}
