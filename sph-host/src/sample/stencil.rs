//! The neighbours of one point with their influence, found once and summed over many times.
//!
//! A [`Stencil`] is at once the search, the influence and the gathered values that sph-core's sums ask for, its samples
//! numbered from 0 in the order in which the search found them. The sums' bits are those of a sum over the search itself.

use sph_core::{Influence, InfluenceOf, Neighbour, Neighbours, PerSample, Scalar};

/// One particle in reach of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contribution<T, const D: usize> {
    particle: usize,
    offset: [T; D],
    distance_squared: T,
    support_radius: T,
    influence: T,
    gradient: [T; D],
}

/// The particles in reach of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stencil<'a, T, const D: usize> {
    contributions: &'a [Contribution<T, D>],
    reach: T,
}

impl<'a, T: Scalar, const D: usize> Stencil<'a, T, D> {
    /// Finds the particles in reach of x, at most the largest support radius away, and evaluates their influence there, and its
    /// gradient if that is wanted; `buffer` is overwritten.
    pub(super) fn gather(
        buffer: &'a mut Vec<Contribution<T, D>>,
        search: &impl Neighbours<T, D>,
        w: impl InfluenceOf<T, D>,
        reach: T,
        x: &[T; D],
        with_gradient: bool,
    ) -> Self {
        buffer.clear();
        search.for_each(x, reach, |Neighbour { index: particle, offset, distance_squared }| {
            let Some(own) = w.of(particle) else { return };
            let support_radius = own.support_radius();
            if distance_squared < support_radius * support_radius {
                let (influence, gradient) = match with_gradient {
                    true => own.value_and_gradient(&offset, distance_squared),
                    false => (own.influence(distance_squared), [T::ZERO; D]),
                };
                buffer.push(Contribution {
                    particle,
                    offset,
                    distance_squared,
                    support_radius,
                    influence,
                    gradient,
                });
            }
        });
        Self { contributions: buffer, reach }
    }

    /// Whether no particle is in reach.
    pub(super) fn is_empty(&self) -> bool {
        self.contributions.is_empty()
    }

    /// The values of the stencil's particles among those of all.
    pub(super) fn pick(&self, values: &'a [T]) -> Picked<'a, T, D> {
        Picked { contributions: self.contributions, values }
    }
}

impl<T: Scalar, const D: usize> Neighbours<T, D> for Stencil<'_, T, D> {
    /// None: the samples of a stencil are known by their offsets.
    fn positions(&self) -> &[[T; D]] {
        &[]
    }

    #[inline]
    fn for_each(&self, _: &[T; D], _: T, mut visit: impl FnMut(Neighbour<T, D>)) {
        for (index, one) in self.contributions.iter().enumerate() {
            visit(Neighbour { index, offset: one.offset, distance_squared: one.distance_squared });
        }
    }
}

impl<'a, T: Scalar, const D: usize> InfluenceOf<T, D> for Stencil<'a, T, D> {
    type Influence = &'a Contribution<T, D>;

    #[inline]
    fn of(&self, j: usize) -> Option<Self::Influence> {
        self.contributions.get(j)
    }

    fn reach(&self) -> T {
        self.reach
    }
}

impl<T: Scalar, const D: usize> Influence<T, D> for Contribution<T, D> {
    fn support_radius(&self) -> T {
        self.support_radius
    }

    #[inline]
    fn influence(&self, _: T) -> T {
        self.influence
    }

    #[inline]
    fn gradient(&self, _: &[T; D], _: T) -> [T; D] {
        self.gradient
    }
}

/// Values of a stencil's particles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Picked<'a, T, const D: usize> {
    contributions: &'a [Contribution<T, D>],
    values: &'a [T],
}

impl<T: Scalar, const D: usize> PerSample<T> for Picked<'_, T, D> {
    #[inline]
    fn get(&self, j: usize) -> Option<T> {
        self.values.get(self.contributions.get(j)?.particle).copied()
    }

    fn count(&self) -> Option<usize> {
        None
    }
}
