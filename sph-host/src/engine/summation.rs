//! The sums over neighbours on registers and threads: sph-core's terms on several pairs at a time, over rows that are kept.

use std::ops::Range;

use sph_core::Error;
use sph_core::fluid::wcsph::{Forces, Scheme, Seen, Summation};

use super::neighbourhoods::{Needed, Neighbourhoods, Search, SimdKernel};
use super::records::{ParticleRecords, record};
use super::verlet_lists::{LIST_CHUNK, ListChunk, VerletLists};
use crate::fast::{InstructionSet, Real};
use crate::kernel_choice::AnyInfluence;
use crate::parallel;

mod jobs;
#[cfg(test)]
mod tests;

use jobs::{SumForces, SumRates, SumWalls};

/// Particles whose neighbours are found together: they fit the first cache.
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

    /// The same with the code of another instruction set.
    pub(super) fn at_level(mut self, level: InstructionSet) -> Self {
        (self.kernel.level, self.rows.level) = (level, level);
        self
    }

    /// Lists rows anew where that is needed, and records fluid particles as they are seen.
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
        let chunks = places.chunks_mut(LIST_CHUNK).zip(states.chunks_mut(LIST_CHUNK));
        parallel::for_each(chunks, |chunk, (places, states)| {
            for (offset, (place, state)) in places.iter_mut().zip(states).enumerate() {
                let k = chunk * LIST_CHUNK + offset;
                (*place, *state) = record(&rows.unwrapped(k, &of_fluid[k]), &seen[k]);
            }
        });
        self.set_images(positions.len(), self.rows.images.len());
        Ok(())
    }

    /// Makes a record for every particle and every image; walls are dry to begin with.
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
        needed: Needed,
        place: impl Fn(usize) -> usize + Sync,
        sum: impl Fn(&Neighbourhoods<T, D>, Range<usize>, &mut [U]) + Sync,
    ) {
        let search =
            Search { kernel: &self.kernel, records: &self.records, padding: self.rows.padding, needed };
        let work = chunks.iter().zip(out.chunks_mut(LIST_CHUNK));
        parallel::for_each_with(work, |near: &mut Neighbourhoods<T, D>, number, (chunk, out)| {
            for (group, out) in out.chunks_mut(GROUP).enumerate() {
                let first = group * GROUP;
                let range = number * LIST_CHUNK + first..number * LIST_CHUNK + first + out.len();
                near.find_neighbours(search, chunk, first, range.clone().map(&place));
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
            Needed::Profiles,
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
            Needed::Slopes,
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
            Needed::Slopes,
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
