//! What is found about some consecutive points, as the terms of their sums.

use std::ops::Range;

use sph_core::Lane;
use sph_core::field::{Reads, Term};

use super::blocks::reserve;
use super::collect::{Collect, Found, Pick, Span};
use super::evaluate::{Evaluate, Evaluator};
use super::part::Part;
use super::simd::{BLOCK, Isa, Job, Real, Register};
use super::sort::Sorted;

/// Memory that is used again: a number for each particle found, for all points of a group.
#[derive(Clone, Debug)]
pub(super) struct PointScratch<T, const D: usize> {
    pub(super) found: Found<T>,
    /// W over its constant.
    profiles: Vec<T>,
    /// The same of ∇W / (x − x_j), times h².
    slopes: Vec<T>,
    /// x_j, axis by axis.
    coordinates: [Vec<T>; D],
    /// h_j and 1 / h_j, where each has its own.
    own: [Vec<T>; 2],
    /// c_j, V_j or V_j A_j
    weights: Vec<T>,
}

impl<T, const D: usize> Default for PointScratch<T, D> {
    fn default() -> Self {
        Self {
            found: Found { squares: Vec::new(), blocks: Vec::new(), spans: Vec::new() },
            profiles: Vec::new(),
            slopes: Vec::new(),
            coordinates: [const { Vec::new() }; D],
            own: [Vec::new(), Vec::new()],
            weights: Vec::new(),
        }
    }
}

/// One part's particles about a group of consecutive points.
pub(super) struct Group<'a, T, const D: usize> {
    pub(super) part: &'a Part<'a, T, D>,
    /// σ_D h^{-D} for the h of the part's cells.
    pub(super) constant: T,
    /// The largest h of all parts.
    pub(super) reach: T,
    pub(super) points: &'a Sorted<T, D>,
    pub(super) range: Range<usize>,
}

impl<T: Real, const D: usize> Group<'_, T, D> {
    /// Finds the particles in reach, adds up how many they are, and works out of the kernel as much as is read.
    pub(super) fn find(
        &self,
        evaluate: Evaluator<T>,
        reads: Reads,
        reached: &mut [u32],
        scratch: &mut PointScratch<T, D>,
    ) {
        let Part { cells, own: radii, .. } = self.part;
        let level = cells.level;
        let PointScratch { found, profiles, slopes, coordinates, own, .. } = scratch;
        let own_limits = radii.map(|radii| &radii.squares[..]);
        let (points, range) = (self.points, self.range.clone());
        let end = T::dispatch(level, Collect { cells, own_limits, points, range, found });
        for (reached, span) in reached.iter_mut().zip(&found.spans) {
            *reached += span.count as u32;
        }
        if let Some(radii) = radii {
            T::dispatch(level, Pick { found, columns: [&radii.radii[..], &radii.inverses], out: own });
        }
        if reads.gradient || reads.offset {
            T::dispatch(level, Pick { found, columns: cells.sorted.padded(), out: coordinates });
        }
        reserve(profiles, end);
        reserve(slopes, end);
        let (profiles, slopes) = (
            if reads.influence { &mut profiles[..end] } else { &mut [] },
            if reads.gradient { &mut slopes[..end] } else { &mut [] },
        );
        let squares = &mut found.squares[..end];
        if radii.is_none() {
            let inverse = T::ONE / cells.radius;
            evaluate(level, Evaluate { squares, scale: inverse * inverse, profiles, slopes });
        } else {
            let inverses = &own[1][..end];
            T::dispatch(level, ToOwnUnits { inverses, squares });
            evaluate(
                level,
                Evaluate { squares, scale: T::ONE, profiles: &mut *profiles, slopes: &mut *slopes },
            );
            T::dispatch(level, FromOwnUnits::<T, D> { radius: cells.radius, inverses, profiles, slopes });
        }
    }

    /// Moves the weights of the particles found together.
    pub(super) fn pick(&self, column: &[T], scratch: &mut PointScratch<T, D>) {
        let PointScratch { found, weights, .. } = scratch;
        T::dispatch(
            self.part.cells.level,
            Pick { found, columns: [column], out: std::array::from_mut(weights) },
        );
    }
}

/// What was found about a point, without the constant of the kernel, which is the same in all terms.
pub(super) struct Terms<'a, T: Real, I: Isa<T>, const D: usize> {
    x: [I::Reg; D],
    pub(super) weights: &'a [[T; BLOCK]],
    profiles: &'a [[T; BLOCK]],
    slopes: &'a [[T; BLOCK]],
    coordinates: [&'a [[T; BLOCK]]; D],
    /// h_j, where each has its own.
    radii: Option<&'a [[T; BLOCK]]>,
    radius: I::Reg,
    inverse_square: I::Reg,
    inverse_reach: I::Reg,
}

impl<'a, T: Real, I: Isa<T>, const D: usize> Terms<'a, T, I, D> {
    #[inline(always)]
    pub(super) fn new(
        group: &Group<'_, T, D>,
        scratch: &'a PointScratch<T, D>,
        reads: Reads,
        span: Span,
        place: usize,
    ) -> Self {
        let weights = span.blocks_of(&scratch.weights);
        // of one length, so that one check of a block is enough; what is not read is not there
        let read = |list: &'a [T], is_read| {
            if is_read { &span.blocks_of(list)[..weights.len()] } else { weights }
        };
        let mut coordinates = [weights; D];
        for axis in 0..D {
            coordinates[axis] = read(&scratch.coordinates[axis], reads.gradient || reads.offset);
        }
        let inverse = T::ONE / group.part.cells.radius;
        Self {
            x: I::splat_vector(&group.points.position(place)),
            weights,
            profiles: read(&scratch.profiles, reads.influence),
            slopes: read(&scratch.slopes, reads.gradient),
            coordinates,
            radii: group.part.own.map(|_| read(&scratch.own[0], true)),
            radius: I::Reg::splat(group.part.cells.radius),
            inverse_square: I::Reg::splat(inverse * inverse),
            inverse_reach: I::Reg::splat(T::ONE / group.reach),
        }
    }
}

/// As many terms as a register holds, of a block from a number on.
pub(super) struct OneRegister<'a, T: Real, I: Isa<T>, const D: usize> {
    pub(super) terms: &'a Terms<'a, T, I, D>,
    pub(super) block: usize,
    pub(super) first: usize,
}

impl<T: Real, I: Isa<T>, const D: usize> OneRegister<'_, T, I, D> {
    #[inline(always)]
    fn load(&self, list: &[[T; BLOCK]]) -> I::Reg {
        I::Reg::load_at(&list[self.block], self.first)
    }
}

impl<T: Real, I: Isa<T>, const D: usize> Term<I::Reg, D> for OneRegister<'_, T, I, D> {
    #[inline(always)]
    fn weight(&self) -> I::Reg {
        self.load(self.terms.weights)
    }

    #[inline(always)]
    fn influence(&self) -> I::Reg {
        self.load(self.terms.profiles)
    }

    #[inline(always)]
    fn gradient(&self) -> [I::Reg; D] {
        let slope = self.load(self.terms.slopes) * self.terms.inverse_square;
        let mut gradient = self.offset();
        for axis in 0..D {
            gradient[axis] = slope * gradient[axis];
        }
        gradient
    }

    #[inline(always)]
    fn influence_and_gradient(&self) -> (I::Reg, [I::Reg; D]) {
        (self.influence(), self.gradient())
    }

    #[inline(always)]
    fn offset(&self) -> [I::Reg; D] {
        let mut offset = self.terms.x;
        for axis in 0..D {
            offset[axis] -= self.load(self.terms.coordinates[axis]);
        }
        offset
    }

    #[inline(always)]
    fn support_radius(&self) -> I::Reg {
        match self.terms.radii {
            Some(radii) => self.load(radii),
            None => self.terms.radius,
        }
    }

    #[inline(always)]
    fn inverse_reach(&self) -> I::Reg {
        self.terms.inverse_reach
    }
}

/// Takes r² to units of each particle's own h_j².
struct ToOwnUnits<'a, T> {
    /// 1 / h_j
    inverses: &'a [T],
    squares: &'a mut [T],
}

impl<T: Real> Job<T> for ToOwnUnits<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        let Self { inverses, squares } = self;
        let width = I::Reg::WIDTH;
        for first in (0..inverses.len()).step_by(width) {
            let inverse = I::Reg::load_at(inverses, first);
            let square = I::Reg::load_at(squares, first) * (inverse * inverse);
            square.store(&mut squares[first..first + width]);
        }
    }
}

/// Takes profiles and slopes, which are in units of each particle's own h_j, to those of the h of the cells.
struct FromOwnUnits<'a, T, const D: usize> {
    radius: T,
    /// 1 / h_j
    inverses: &'a [T],
    profiles: &'a mut [T],
    slopes: &'a mut [T],
}

impl<T: Real, const D: usize> Job<T> for FromOwnUnits<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        let Self { radius, inverses, profiles, slopes } = self;
        let (radius, width) = (I::Reg::splat(radius), I::Reg::WIDTH);
        for first in (0..inverses.len()).step_by(width) {
            let ratio = I::Reg::load_at(inverses, first) * radius;
            let mut power = ratio;
            for _ in 1..D {
                power = power * ratio;
            }
            if !profiles.is_empty() {
                let profile = I::Reg::load_at(profiles, first) * power;
                profile.store(&mut profiles[first..first + width]);
            }
            if !slopes.is_empty() {
                let slope = I::Reg::load_at(slopes, first) * (power * ratio * ratio);
                slope.store(&mut slopes[first..first + width]);
            }
        }
    }
}
