//! Where particles matter to some points.

use super::particles::{Particles, bounds};
use super::points::Points;
use super::request::Request;
use super::span::{Bounds, Span};

/// Margin over what sums can depend on, for the rounding of distances in the coarsest scalar.
pub(super) const MARGIN: f64 = 1.01;

/// How far from points particles matter to sums there: h, and h more for the densities in them.
pub(super) fn reach(span: &Span, axis: usize) -> f64 {
    let (lower, upper) = span.coordinates[axis];
    // positions are rounded to the scalar, which has 23 bits for what all span at least
    let rounding = (upper - lower) * 2_f64.powi(-20);
    2.0 * (MARGIN * span.supports.1 + rounding)
}

/// A box outside of which no particle matters to the points of a part.
pub(super) struct Region {
    sides: Vec<(usize, Bounds)>,
}

impl Region {
    /// The region of points, of particles that span this; none where all points are asked for, for then all particles are looked at.
    pub(super) fn of(request: &Request, points: &Points, span: &Span, axes: &[usize]) -> Option<Self> {
        request.part.filter(|_| points.len() > 0)?;
        let side = |&axis: &usize| {
            let ((lower, upper), reach) = (bounds(points.along(span.space[axis])), reach(span, axis));
            (axis, (lower - reach, upper + reach))
        };
        Some(Self { sides: axes.iter().map(side).collect() })
    }

    /// Whether a particle matters.
    pub(super) fn holds(&self, particles: &Particles, row: usize) -> bool {
        self.sides
            .iter()
            .all(|(axis, (lower, upper))| (*lower..=*upper).contains(&particles.coordinates[*axis][row]))
    }

    /// The particles that matter, in their order.
    pub(super) fn of_particles(&self, particles: Particles) -> Particles {
        let kept: Vec<usize> = (0..particles.len()).filter(|&row| self.holds(&particles, row)).collect();
        let take = |along: &Vec<f64>| kept.iter().map(|&row| along[row]).collect();
        let coordinates = particles.coordinates.iter().map(take).collect();
        particles.taken(&kept, coordinates)
    }
}
