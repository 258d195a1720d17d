//! The sums as jobs: each is compiled once for each instruction set.

use sph_core::Lane;
use sph_core::fluid::wcsph::{ForceSums, Forces, Pair, RateSums, Seen, WallSums};

use super::Host;
use crate::engine::neighbourhoods::{Blocks, Neighbourhoods, Span};
use crate::engine::records::ParticleRecords;
use crate::fast::{Isa, Job, Real};

/// dρ/dt of some consecutive particles.
pub(super) struct SumRates<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) gradient_scale: T,
    pub(super) records: &'a ParticleRecords<T>,
    pub(super) near: &'a Neighbourhoods<T, D>,
    pub(super) seen: &'a [Seen<T, D>],
    pub(super) first: usize,
    pub(super) out: &'a mut [T],
}

impl<T: Real, const D: usize> SumRates<'_, T, D> {
    /// Adds the fluid, or the walls.
    #[inline(always)]
    fn add<I: Isa<T>, const FLUID: bool>(
        &self,
        isa: I,
        own: &Seen<I::Reg, D>,
        span: Span,
        part: usize,
        sums: &mut RateSums<T, I::Reg>,
    ) {
        let wanted = [false, FLUID, FLUID, !FLUID];
        let blocks = self.near.blocks(span, &self.near.slopes);
        let gradient_scale = I::Reg::splat(self.gradient_scale);
        // a copy, which nothing else can write to: its numbers are loaded before the loop
        let scheme = *self.scheme;
        for block in 0..span.blocks_of_part::<T, I>(part) {
            let (other, pair) = pair(isa, self.records, &blocks, block, part, gradient_scale, wanted);
            scheme.add_rate(sums, own, &other, &pair, FLUID);
        }
    }
}

impl<T: Real, const D: usize> Job<T> for SumRates<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        for (k, spans) in self.near.spans.iter().enumerate() {
            let own = self.records.seen(self.first + k);
            let mut parts = I::parts(RateSums::<T, I::Reg>::EMPTY);
            for part in 0..I::PARTS {
                // on their own while they grow, so that they stay in registers
                let mut sums = RateSums::<T, I::Reg>::EMPTY;
                self.add::<I, true>(isa, &own, spans[0], part, &mut sums);
                self.add::<I, false>(isa, &own, spans[1], part, &mut sums);
                parts.as_mut()[part] = sums;
            }
            let sums = I::join_parts(
                parts,
                #[inline(always)]
                |sums, other| sums.join(other),
            );
            self.out[k] = self.scheme.total_rate(&self.seen[k], sums);
        }
    }
}

/// The forces on some consecutive particles.
pub(super) struct SumForces<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) gradient_scale: T,
    pub(super) records: &'a ParticleRecords<T>,
    pub(super) near: &'a Neighbourhoods<T, D>,
    pub(super) first: usize,
    pub(super) out: &'a mut [Forces<T, D>],
}

impl<T: Real, const D: usize> SumForces<'_, T, D> {
    /// Adds the fluid, or the walls.
    #[inline(always)]
    fn add<I: Isa<T>, const FLUID: bool>(
        &self,
        isa: I,
        own: &Seen<I::Reg, D>,
        span: Span,
        part: usize,
        sums: &mut ForceSums<T, I::Reg, D>,
    ) {
        let wanted = [false, true, true, true];
        let blocks = self.near.blocks(span, &self.near.slopes);
        let gradient_scale = I::Reg::splat(self.gradient_scale);
        // a copy, which nothing else can write to: its numbers are loaded before the loop
        let scheme = *self.scheme;
        for block in 0..span.blocks_of_part::<T, I>(part) {
            let (other, pair) = pair(isa, self.records, &blocks, block, part, gradient_scale, wanted);
            scheme.add_force(sums, own, &other, &pair, FLUID);
        }
    }
}

impl<T: Real, const D: usize> Job<T> for SumForces<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        for (k, spans) in self.near.spans.iter().enumerate() {
            let own = self.records.seen(self.first + k);
            let mut parts = I::parts(ForceSums::<T, I::Reg, D>::EMPTY);
            for part in 0..I::PARTS {
                // on their own while they grow, so that they stay in registers
                let mut sums = ForceSums::<T, I::Reg, D>::EMPTY;
                self.add::<I, true>(isa, &own, spans[0], part, &mut sums);
                self.add::<I, false>(isa, &own, spans[1], part, &mut sums);
                parts.as_mut()[part] = sums;
            }
            let sums = I::join_parts(
                parts,
                #[inline(always)]
                |sums, other| sums.join(other),
            );
            self.out[k] = self.scheme.total_forces(sums);
        }
    }
}

/// What walls show.
pub(super) struct SumWalls<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) records: &'a ParticleRecords<T>,
    pub(super) near: &'a Neighbourhoods<T, D>,
    pub(super) out: &'a mut [Seen<T, D>],
}

impl<T: Real, const D: usize> Job<T> for SumWalls<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { scheme, records, near, out } = self;
        for (out, spans) in out.iter_mut().zip(&near.spans) {
            let blocks = near.blocks(spans[0], &near.profiles);
            let mut parts = I::parts(WallSums::<T, I::Reg, D>::EMPTY);
            for part in 0..I::PARTS {
                let mut sums = WallSums::<T, I::Reg, D>::EMPTY;
                for block in 0..spans[0].blocks_of_part::<T, I>(part) {
                    let (places, offset, weight) = blocks.part::<I>(block, part);
                    let other = records.seen_at(isa, places, [true, true, false, false]);
                    scheme.add_to_wall(&mut sums, &other, &offset, weight);
                }
                parts.as_mut()[part] = sums;
            }
            let sums = I::join_parts(
                parts,
                #[inline(always)]
                |sums, other| sums.join(other),
            );
            *out = scheme.total_wall(sums);
        }
    }
}

/// A register of neighbours, and their offsets and slopes.
#[inline(always)]
fn pair<T: Real, I: Isa<T>, const D: usize>(
    isa: I,
    records: &ParticleRecords<T>,
    blocks: &Blocks<T, D>,
    block: usize,
    part: usize,
    gradient_scale: I::Reg,
    wanted: [bool; 4],
) -> (Seen<I::Reg, D>, Pair<I::Reg, D>) {
    let (places, offset, slope) = blocks.part::<I>(block, part);
    let other = records.seen_at(isa, places, wanted);
    (other, Pair { offset, slope: slope * gradient_scale })
}
