//! The neighbours of particles as all sums of a step read them.

use sph_core::{Arithmetic, Lane};

use crate::engine::neighbourhoods::{Neighbourhoods, Span};
use crate::fast::{BLOCK, Isa, Real, Register};

/// The neighbours of some consecutive particles in blocks: of each particle the blocks of fluid and of walls.
#[derive(Clone, Debug)]
pub(super) struct Contacts<T, const D: usize> {
    pub(super) spans: Vec<[Span; 2]>,
    /// Records.
    places: Vec<[u32; BLOCK]>,
    /// V W_ij
    influences: Vec<[T; BLOCK]>,
    /// V ∇W_ij, axis by axis.
    gradients: [Vec<[T; BLOCK]>; D],
}

impl<T, const D: usize> Default for Contacts<T, D> {
    fn default() -> Self {
        Self {
            spans: Vec::new(),
            places: Vec::new(),
            influences: Vec::new(),
            gradients: std::array::from_fn(|_| Vec::new()),
        }
    }
}

impl<T: Real, const D: usize> Contacts<T, D> {
    /// No particles.
    pub(super) fn clear(&mut self) {
        self.spans.clear();
        self.places.clear();
        self.influences.clear();
        self.gradients.iter_mut().for_each(Vec::clear);
    }

    /// Adds the particles of a search, with V σ h^{-D} and V σ h^{-D−2}.
    #[inline(always)]
    pub(super) fn add<I: Isa<T>>(
        &mut self,
        _: I,
        near: &Neighbourhoods<T, D>,
        influence_scale: T,
        gradient_scale: T,
    ) {
        let first = self.places.len();
        let blocks = near.spans.last().map_or(0, |spans| spans[1].blocks().end);
        self.spans.extend(
            near.spans.iter().map(|spans| spans.map(|span| Span { first: first + span.first, ..span })),
        );
        self.places.extend_from_slice(&near.places.as_chunks().0[..blocks]);
        self.influences.resize(first + blocks, [T::ZERO; BLOCK]);
        self.gradients.iter_mut().for_each(|axis| axis.resize(first + blocks, [T::ZERO; BLOCK]));
        let (profiles, slopes) =
            (near.blocks_in(0..blocks, &near.profiles), near.blocks_in(0..blocks, &near.slopes));
        let [influence_scale, gradient_scale] = [influence_scale, gradient_scale].map(I::Reg::splat);
        for block in 0..blocks {
            for part in 0..I::PARTS {
                let lanes = part * I::Reg::WIDTH..(part + 1) * I::Reg::WIDTH;
                let (_, _, profile) = profiles.part::<I>(block, part);
                let (_, offset, slope) = slopes.part::<I>(block, part);
                (profile * influence_scale).store(&mut self.influences[first + block][lanes.clone()]);
                let slope = slope * gradient_scale;
                for axis in 0..D {
                    (offset[axis] * slope).store(&mut self.gradients[axis][first + block][lanes.clone()]);
                }
            }
        }
    }

    /// The blocks of a span.
    #[inline(always)]
    pub(super) fn blocks(&self, span: Span) -> Blocks<'_, T, D> {
        let span = span.blocks();
        let mut gradients = [&self.gradients[0][span.clone()]; D];
        for axis in 0..D {
            gradients[axis] = &self.gradients[axis][span.clone()];
        }
        Blocks { places: &self.places[span.clone()], influences: &self.influences[span.clone()], gradients }
    }
}

/// The neighbours of one particle in blocks.
pub(super) struct Blocks<'a, T, const D: usize> {
    places: &'a [[u32; BLOCK]],
    influences: &'a [[T; BLOCK]],
    gradients: [&'a [[T; BLOCK]]; D],
}

impl<'a, T: Real, const D: usize> Blocks<'a, T, D> {
    /// The records of one part of a block.
    #[inline(always)]
    pub(super) fn places<I: Isa<T>>(&self, block: usize, part: usize) -> &'a [u32] {
        &self.places[block][part * I::Reg::WIDTH..(part + 1) * I::Reg::WIDTH]
    }

    /// V W_ij of one part of a block.
    #[inline(always)]
    pub(super) fn influence<I: Isa<T>>(&self, block: usize, part: usize) -> I::Reg {
        I::Reg::load_at(&self.influences[block], part * I::Reg::WIDTH)
    }

    /// V ∇W_ij of one part of a block.
    #[inline(always)]
    pub(super) fn gradient<I: Isa<T>>(&self, block: usize, part: usize) -> [I::Reg; D] {
        let mut gradient = [I::Reg::ZERO; D];
        for axis in 0..D {
            gradient[axis] = I::Reg::load_at(&self.gradients[axis][block], part * I::Reg::WIDTH);
        }
        gradient
    }
}
