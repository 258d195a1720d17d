//! From tables to checked particles and points.

use super::error::SampleError;
use super::only::Taken;
use super::particles::Particles;
use super::periodic::PeriodicBox;
use super::planes;
use super::points::{self, Points};
use super::read::{Input, Tables};
use super::region::Region;
use super::request::Request;
use super::slabs::{FirstReading, Slabs};
use super::span::Span;
use super::table;

/// Everything that sums need, checked.
pub(super) struct Checked {
    pub(super) particles: Set,
    /// What all particles span, their images among them.
    pub(super) span: Span,
    /// The coordinates that sums run over.
    pub(super) axes: Vec<usize>,
    pub(super) points: Points,
    /// How many particles there are, without images, of how many in the file.
    pub(super) taken: Taken,
}

/// All particles at once, or in slabs of space.
pub(super) enum Set {
    Whole(Particles),
    Slabs(Slabs),
}

/// Checks particles and points.
pub(super) fn check(tables: Tables, request: &Request) -> Result<Checked, SampleError> {
    match tables.particles {
        Input::Whole(read, taken, own_support) => {
            table::check_coordinates(&read)?;
            let axes = planes::summed_of(&read, request.dim)?;
            let mut particles = table::particles(read, own_support, request)?;
            let mut span = Span::of(&particles);
            let mut points = points::points(request, tables.points, Some(&particles), &span, &axes)?;
            if let Some(periodic) = PeriodicBox::of(request, &span, &axes)? {
                (particles, points) = (periodic.with_images(particles), points.wrapped(&periodic));
                span = Span::of(&particles);
                span.check()?;
            }
            if let Some(region) = Region::of(request, &points, &span, &axes) {
                particles = region.of_particles(particles);
            }
            Ok(Checked { particles: Set::Whole(particles), span, axes, points, taken })
        }
        Input::Pieces(file) => {
            let first = FirstReading::new(&file, request)?;
            let mut points = points::points(request, tables.points, None, &first.read, &first.axes)?;
            if let Some(periodic) = &first.periodic {
                points = points.wrapped(periodic);
            }
            let region = Region::of(request, &points, &first.span, &first.axes);
            let slabs = Slabs::read(&file, request, &first, region.as_ref())?;
            let FirstReading { span, axes, taken, .. } = first;
            Ok(Checked { particles: Set::Slabs(slabs), span, axes, points, taken })
        }
    }
}
