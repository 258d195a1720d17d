//! The sums over neighbours on vectors and threads: sph-core's terms on sixteen pairs at a time, over rows that are kept.

use std::ops::Range;

use rayon::prelude::*;
use sph_core::fluid::wcsph::{ForceSums, Forces, Pair, RateSums, Scheme, Seen, Summation, WallSums};
use sph_core::{Error, Lane};

use super::neighbourhoods::{Blocks, Neighbourhoods, SimdKernel};
use super::records::{ParticleRecords, record};
use super::verlet_lists::{LIST_CHUNK, ListChunk, VerletLists};
use crate::fast::{Isa, Job, Real};
use crate::kernel_choice::AnyInfluence;

#[cfg(test)]
mod tests;

/// Particles about which is looked at once: what is found fits the first cache.
const GROUP: usize = 8;

/// What sums over neighbours.
pub(super) struct SimdSummation<T, const D: usize> {
    pub(super) rows: VerletLists<T, D>,
    kernel: SimdKernel<T>,
    records: ParticleRecords<T>,
}

type Host<T, const D: usize> = Scheme<T, D, AnyInfluence<T, D>>;

impl<T: Real, const D: usize> SimdSummation<T, D> {
    pub(super) fn new(rows: VerletLists<T, D>, kernel: SimdKernel<T>) -> Self {
        Self { rows, kernel, records: ParticleRecords { places: Vec::new(), states: Vec::new() } }
    }

    /// Lists rows anew where that is needed, and takes down fluid particles as they are seen.
    fn refresh_records(
        &mut self,
        scheme: &Host<T, D>,
        positions: &[[T; D]],
        seen: &[Seen<T, D>],
        fluid: usize,
    ) -> Result<(), Error> {
        let (of_fluid, of_walls) = positions.split_at(fluid);
        let before = self.rows.wet.clone();
        if self.rows.update(of_fluid, of_walls)? {
            self.make_room(scheme, of_walls, fluid);
            let dry = scheme.dry_wall();
            for wall in before.into_iter().filter(|wall| self.rows.wet.binary_search(wall).is_err()) {
                self.records.set(wall as usize, &positions[wall as usize], &dry);
            }
        }
        let rows = &self.rows;
        let (places, states) = (&mut self.records.places[..fluid], &mut self.records.states[..fluid]);
        let of_fluid = (places, states, of_fluid, &seen[..fluid]).into_par_iter().with_min_len(LIST_CHUNK);
        of_fluid.enumerate().for_each(|(k, (place, state, x, seen))| {
            (*place, *state) = record(&rows.unwrapped(k, x), seen);
        });
        self.set_images(positions.len(), self.rows.images.len());
        Ok(())
    }

    /// A record for everybody and every image; walls are dry to begin with.
    fn make_room(&mut self, scheme: &Host<T, D>, walls: &[[T; D]], fluid: usize) {
        let (all, is_new) = (fluid + walls.len(), self.records.places.is_empty());
        self.records.resize::<D>(all + 1 + self.rows.images.len());
        if is_new {
            let dry = scheme.dry_wall();
            walls.iter().enumerate().for_each(|(k, x)| self.records.set(fluid + k, x, &dry));
        }
    }

    /// Records the first so many images of all particles.
    fn set_images(&mut self, all: usize, count: usize) {
        for (k, image) in self.rows.images[..count].iter().enumerate() {
            self.records.set_image(all + 1 + k, image.of as usize, &image.shift);
        }
    }

    /// out[k] = sum of the k-th row of the chunks, whose particles' records are at `place(k)`.
    fn each<U: Send>(
        &self,
        chunks: &[ListChunk],
        out: &mut [U],
        place: impl Fn(usize) -> usize + Sync,
        sum: impl Fn(&Neighbourhoods<T, D>, Range<usize>, &mut [U]) + Sync,
    ) {
        let padding = self.rows.padding;
        let work = chunks.par_iter().zip(out.par_chunks_mut(LIST_CHUNK)).enumerate();
        work.for_each_init(Neighbourhoods::default, |near, (number, (chunk, out))| {
            for (group, out) in out.chunks_mut(GROUP).enumerate() {
                let first = group * GROUP;
                let range = number * LIST_CHUNK + first..number * LIST_CHUNK + first + out.len();
                near.find_neighbours(
                    &self.kernel,
                    &self.records,
                    chunk,
                    first,
                    range.clone().map(&place),
                    padding,
                );
                sum(near, range, out);
            }
        });
    }

    /// The walls that have fluid near, as it sees them.
    fn walls(&mut self, scheme: &Host<T, D>, positions: &[[T; D]], seen: &mut [Seen<T, D>]) {
        let mut found = vec![Seen::NONE; self.rows.wet.len()];
        let (rows, records, level) = (&self.rows, &self.records, self.kernel.level);
        self.each(
            &rows.of_walls,
            &mut found,
            |k| rows.wet[k] as usize,
            |near, _, out| {
                T::dispatch(level, SumWalls { scheme, records, near, out });
            },
        );
        for (&wall, found) in self.rows.wet.iter().zip(found) {
            let wall = wall as usize;
            seen[wall] = found;
            self.records.set(wall, &positions[wall], &found);
        }
        self.set_images(positions.len(), self.rows.wall_images);
    }
}

impl<T: Real, const D: usize> Summation<T, D, AnyInfluence<T, D>> for SimdSummation<T, D> {
    fn rates(
        &mut self,
        scheme: &Host<T, D>,
        positions: &[[T; D]],
        seen: &[Seen<T, D>],
        rates: &mut [T],
    ) -> Result<(), Error> {
        self.refresh_records(scheme, positions, seen, rates.len())?;
        let (records, level) = (&self.records, self.kernel.level);
        let gradient_scale = self.kernel.gradient_scale;
        self.each(
            &self.rows.of_fluid,
            rates,
            |k| k,
            |near, range, out| {
                T::dispatch(
                    level,
                    SumRates {
                        scheme,
                        gradient_scale,
                        records,
                        near,
                        seen: &seen[range.clone()],
                        first: range.start,
                        out,
                    },
                );
            },
        );
        Ok(())
    }

    fn forces(
        &mut self,
        scheme: &Host<T, D>,
        positions: &[[T; D]],
        seen: &mut [Seen<T, D>],
        forces: &mut [Forces<T, D>],
    ) -> Result<(), Error> {
        self.refresh_records(scheme, positions, seen, forces.len())?;
        self.walls(scheme, positions, seen);
        let (records, level) = (&self.records, self.kernel.level);
        let gradient_scale = self.kernel.gradient_scale;
        self.each(
            &self.rows.of_fluid,
            forces,
            |k| k,
            |near, range, out| {
                T::dispatch(
                    level,
                    SumForces { scheme, gradient_scale, records, near, first: range.start, out },
                );
            },
        );
        Ok(())
    }
}

/// dρ/dt of some consecutive particles.
struct SumRates<'a, T, const D: usize> {
    scheme: &'a Host<T, D>,
    gradient_scale: T,
    records: &'a ParticleRecords<T>,
    near: &'a Neighbourhoods<T, D>,
    seen: &'a [Seen<T, D>],
    first: usize,
    out: &'a mut [T],
}

impl<T: Real, const D: usize> SumRates<'_, T, D> {
    /// Adds the fluid, or the walls.
    #[inline(always)]
    fn add<I: Isa<T>, const FLUID: bool>(
        &self,
        isa: I,
        own: &Seen<I::Reg, D>,
        span: &Range<usize>,
        part: usize,
        sums: &mut RateSums<T, I::Reg>,
    ) {
        let wanted = [false, FLUID, FLUID, !FLUID];
        let blocks = self.near.blocks(span, &self.near.slopes);
        let gradient_scale = I::Reg::splat(self.gradient_scale);
        for block in 0..blocks.len() {
            let (other, pair) = pair(isa, self.records, &blocks, block, part, gradient_scale, wanted);
            self.scheme.add_rate(sums, own, &other, &pair, FLUID);
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
            for (part, sums) in parts.as_mut().iter_mut().enumerate() {
                self.add::<I, true>(isa, &own, &spans[0], part, sums);
                self.add::<I, false>(isa, &own, &spans[1], part, sums);
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
struct SumForces<'a, T, const D: usize> {
    scheme: &'a Host<T, D>,
    gradient_scale: T,
    records: &'a ParticleRecords<T>,
    near: &'a Neighbourhoods<T, D>,
    first: usize,
    out: &'a mut [Forces<T, D>],
}

impl<T: Real, const D: usize> SumForces<'_, T, D> {
    /// Adds the fluid, or the walls.
    #[inline(always)]
    fn add<I: Isa<T>, const FLUID: bool>(
        &self,
        isa: I,
        own: &Seen<I::Reg, D>,
        span: &Range<usize>,
        part: usize,
        sums: &mut ForceSums<T, I::Reg, D>,
    ) {
        let wanted = [false, true, true, true];
        let blocks = self.near.blocks(span, &self.near.slopes);
        let gradient_scale = I::Reg::splat(self.gradient_scale);
        for block in 0..blocks.len() {
            let (other, pair) = pair(isa, self.records, &blocks, block, part, gradient_scale, wanted);
            self.scheme.add_force(sums, own, &other, &pair, FLUID);
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
            for (part, sums) in parts.as_mut().iter_mut().enumerate() {
                self.add::<I, true>(isa, &own, &spans[0], part, sums);
                self.add::<I, false>(isa, &own, &spans[1], part, sums);
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
struct SumWalls<'a, T, const D: usize> {
    scheme: &'a Host<T, D>,
    records: &'a ParticleRecords<T>,
    near: &'a Neighbourhoods<T, D>,
    out: &'a mut [Seen<T, D>],
}

impl<T: Real, const D: usize> Job<T> for SumWalls<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { scheme, records, near, out } = self;
        for (out, spans) in out.iter_mut().zip(&near.spans) {
            let blocks = near.blocks(&spans[0], &near.profiles);
            let mut parts = I::parts(WallSums::<T, I::Reg, D>::EMPTY);
            for (part, sums) in parts.as_mut().iter_mut().enumerate() {
                for block in 0..blocks.len() {
                    let (places, offset, weight) = blocks.part::<I>(block, part);
                    let other = records.seen_at(isa, places, [true, true, false, false]);
                    scheme.add_to_wall(sums, &other, &offset, weight);
                }
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
