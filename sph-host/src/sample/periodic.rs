//! Periodic boxes: sums over the images of particles as well.
//!
//! Along a periodic axis a particle at x is also at x + k L for every whole k, L being the length of the box. The particles are moved into the
//! box, and each is followed by those of its images that sums in the box can depend on: they reach h, and the densities in them h
//! more. Points are moved into the box too, for the sums alone. What comes of it equals, to the bit, what a file with these images
//! written out gives.

use super::error::SampleError;
use super::particles::Particles;
use super::region::MARGIN;
use super::request::Request;
use super::span::Span;

/// The ends of the box along a periodic axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    lower: f64,
    upper: f64,
}

/// A periodic box over the axes of a file. An axis with equal ends is open.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PeriodicBox {
    /// Of each coordinate of the file; none: open.
    sides: Vec<Option<Side>>,
    /// The axis in space of each.
    space: Vec<usize>,
    /// How far beyond the box there are images.
    reach: f64,
}

/// Most images of one particle: more say that the box is not that of the particles.
const MOST_IMAGES: f64 = 1e4;

impl Side {
    fn length(self) -> f64 {
        self.upper - self.lower
    }

    /// The number in the box that is the same as x: x itself in the box.
    fn wrapped(self, x: f64) -> f64 {
        if x >= self.lower && x < self.upper {
            return x;
        }
        let moved = x - ((x - self.lower) / self.length()).floor() * self.length();
        if moved >= self.lower && moved < self.upper { moved } else { self.lower }
    }

    /// Where a particle at x is once more, within `reach` of the box, ascending; itself among them.
    fn places(self, x: f64, reach: f64) -> Vec<f64> {
        let times = (reach / self.length()).ceil() as i64 + 1;
        let images = (-times..=times).map(|k| x + k as f64 * self.length());
        images.filter(|image| (self.lower - reach..=self.upper + reach).contains(image)).collect()
    }
}

impl PeriodicBox {
    /// The box of a request for particles that span this, of which sums run over `axes`; none: nothing is periodic.
    pub(super) fn of(request: &Request, span: &Span, axes: &[usize]) -> Result<Option<Self>, SampleError> {
        let Some(ends) = &request.periodic else { return Ok(None) };
        let (given, own, support) = (ends.len() / 2, span.coordinates.len(), span.supports.1);
        if given != axes.len() && given != own {
            let (file, expected) = (span.file.clone(), axes.len());
            return Err(SampleError::PeriodicDimensions { file, given, expected });
        }
        let mut sides = vec![None; own];
        for (at, &axis) in axes.iter().enumerate() {
            // for the axes that sums run over, or for all of the file
            let at = if given == axes.len() { at } else { axis };
            let side = Side { lower: ends[at], upper: ends[at + given] };
            sides[axis] = (side.length() > 0.0).then_some(side);
        }
        let reach = 2.0 * MARGIN * support;
        let images =
            sides.iter().flatten().fold(1.0, |all, side| all * (2.0 * (reach / side.length()) + 1.0));
        if images > MOST_IMAGES {
            return Err(SampleError::PeriodicTooSmall { file: span.file.clone(), support, images });
        }
        Ok(Some(Self { sides, space: span.space.clone(), reach }))
    }

    /// The numbers in the box that are the same as these along an axis in space.
    pub(super) fn wrap(&self, axis: usize, along: &mut [f64]) {
        let own = self.space.iter().position(|&known| known == axis);
        if let Some(Some(side)) = own.and_then(|own| self.sides.get(own)) {
            along.iter_mut().for_each(|x| *x = side.wrapped(*x));
        }
    }

    /// The particles in the box, each followed by its images.
    pub(super) fn with_images(&self, mut particles: Particles) -> Particles {
        particles.coordinates.iter_mut().zip(&self.space).for_each(|(along, &axis)| self.wrap(axis, along));
        let mut places: Vec<Vec<f64>> = vec![Vec::new(); particles.coordinates.len()];
        let mut origins: Vec<usize> = Vec::new();
        for particle in 0..particles.len() {
            origins.push(particle);
            places
                .iter_mut()
                .zip(&particles.coordinates)
                .for_each(|(place, along)| place.push(along[particle]));
            if self.is_inside(|axis| particles.coordinates[axis][particle]) {
                continue;
            }
            let own: Vec<f64> = particles.coordinates.iter().map(|along| along[particle]).collect();
            self.each_image(&own, |image| {
                if image != own {
                    origins.push(particle);
                    places.iter_mut().zip(image).for_each(|(place, &x)| place.push(x));
                }
            });
        }
        particles.taken(&origins, places)
    }

    /// Whether a particle in the box is so far from its ends that it has no images.
    fn is_inside(&self, along: impl Fn(usize) -> f64) -> bool {
        self.sides.iter().enumerate().all(|(axis, side)| {
            let x = along(axis);
            side.is_none_or(|side| x - side.lower > self.reach && side.upper - x > self.reach)
        })
    }

    /// Calls `f` with each place within reach of the box where a particle is, itself among them.
    fn each_image(&self, own: &[f64], mut f: impl FnMut(&[f64])) {
        let along: Vec<Vec<f64>> = (self.sides.iter().zip(own))
            .map(|(side, &x)| side.map_or_else(|| vec![x], |side| side.places(x, self.reach)))
            .collect();
        let count: usize = along.iter().map(Vec::len).product();
        let mut image = own.to_vec();
        for number in 0..count {
            let mut rest = number;
            for (x, places) in image.iter_mut().zip(&along) {
                *x = places[rest % places.len()];
                rest /= places.len();
            }
            f(&image);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_moved_into_the_box_and_those_in_it_are_left() {
        let side = Side { lower: -1.0, upper: 2.0 };
        for (x, inside) in [(-1.0, -1.0), (0.3, 0.3), (2.0, -1.0), (2.5, -0.5), (-1.25, 1.75), (-7.5, 1.5)] {
            assert_eq!(side.wrapped(x), inside, "{x}");
        }
        // what rounds to the upper end is the lower one
        assert_eq!(Side { lower: 0.0, upper: 1.0 }.wrapped(-1e-20), 0.0);
    }

    #[test]
    fn images_are_within_reach_of_the_box() {
        let side = Side { lower: 0.0, upper: 1.0 };
        assert_eq!(side.places(0.25, 0.5), [0.25, 1.25]);
        assert_eq!(side.places(0.25, 0.8), [-0.75, 0.25, 1.25]);
        assert_eq!(side.places(0.5, 2.5), [-2.5, -1.5, -0.5, 0.5, 1.5, 2.5, 3.5]);
    }
}
