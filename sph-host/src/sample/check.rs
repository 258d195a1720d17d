//! From tables to checked particles and points.

use super::error::SampleError;
use super::particles::Particles;
use super::planes;
use super::points::{self, Points};
use super::read::{Input, Tables};
use super::request::Request;
use super::slabs::Slabs;
use super::span::Span;
use super::table;

/// Everything that sums need, checked.
pub(super) struct Checked {
    pub(super) particles: Set,
    /// What all particles span.
    pub(super) span: Span,
    /// The axes that sums run over.
    pub(super) axes: Vec<usize>,
    pub(super) points: Points,
}

/// All particles at once, or in slabs of space.
pub(super) enum Set {
    Whole(Particles),
    Slabs(Slabs),
}

/// Checks particles and points.
pub(super) fn check(tables: Tables, request: &Request) -> Result<Checked, SampleError> {
    let (particles, span, axes) = match tables.particles {
        Input::Whole(read, own_support) => {
            table::check_coordinates(&read)?;
            let axes = planes::axes_of(&read, request.dim)?;
            let particles = table::particles(read, own_support, request)?;
            let span = Span::of(&particles);
            (Set::Whole(particles), span, axes)
        }
        Input::Pieces(path, most) => {
            let (slabs, span, axes) = Slabs::read(&path, most, request)?;
            (Set::Slabs(slabs), span, axes)
        }
    };
    let whole = if let Set::Whole(particles) = &particles { Some(particles) } else { None };
    let points = points::points(request, tables.points, whole, &span, &axes)?;
    Ok(Checked { particles, span, axes, points })
}
