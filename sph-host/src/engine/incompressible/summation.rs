//! The sums over neighbours on registers and threads: sph-core's terms on several pairs at a time, over contacts that are found once
//! a step.

use std::ops::Range;

use sph_core::Error;
use sph_core::fluid::incompressible::{Scheme, Shape, Summation, Wall};

use super::contacts::Contacts;
use super::jobs::{Scales, SumOfWalls, SumPushes, SumRates, SumShapes, SumWalls};
use crate::engine::neighbourhoods::{Needed, Neighbourhoods, Search, SimdKernel};
use crate::engine::records::ParticleRecords;
use crate::engine::verlet_lists::{LIST_CHUNK, ListChunk, VerletLists};
use crate::fast::{InstructionSet, Isa, Real};
use crate::kernel_choice::AnyInfluence;
use crate::parallel;

/// Particles whose neighbours are found together: they fit the first cache.
const GROUP: usize = 8;

pub(super) type Host<T, const D: usize> = Scheme<T, D, AnyInfluence<T, D>>;

/// A vector and a number for each record.
#[derive(Default)]
pub(super) struct Carried<T>(Vec<[T; 4]>);

impl<T: Real> Carried<T> {
    /// Those of a register of records.
    #[inline(always)]
    #[expect(clippy::manual_memcpy, reason = "a loop keeps registers in registers")]
    pub(super) fn at<I: Isa<T>, const D: usize>(&self, isa: I, records: &[u32]) -> ([I::Reg; D], I::Reg) {
        let four = isa.transpose(
            #[inline(always)]
            |k| &self.0[records[k] as usize],
        );
        let mut vector = [four[0]; D];
        for axis in 1..D {
            vector[axis] = four[axis];
        }
        (vector, four[3])
    }

    fn set_vectors<const D: usize>(&mut self, vectors: &[[T; D]]) {
        for (four, vector) in self.0.iter_mut().zip(vectors) {
            four[..D].copy_from_slice(vector);
        }
    }

    fn set_numbers(&mut self, numbers: &[T]) {
        for (four, &number) in self.0.iter_mut().zip(numbers) {
            four[3] = number;
        }
    }
}

/// What sums over neighbours.
pub(super) struct SimdSummation<T, const D: usize> {
    pub(super) rows: VerletLists<T, D>,
    kernel: SimdKernel<T>,
    /// Where particles are; their states are not used.
    records: ParticleRecords<T>,
    carried: Carried<T>,
    of_fluid: Vec<Contacts<T, D>>,
    of_walls: Vec<Contacts<T, D>>,
    /// The walls that have fluid near.
    walls: Vec<Wall<T>>,
    wall_values: Vec<T>,
    /// Wall particles.
    wall_count: usize,
}

impl<T: Real, const D: usize> SimdSummation<T, D> {
    pub(super) fn new(rows: VerletLists<T, D>, kernel: SimdKernel<T>, wall_count: usize) -> Self {
        Self {
            rows,
            kernel,
            records: ParticleRecords { places: Vec::new(), states: Vec::new() },
            carried: Carried(Vec::new()),
            of_fluid: Vec::new(),
            of_walls: Vec::new(),
            walls: Vec::new(),
            wall_values: Vec::new(),
            wall_count,
        }
    }

    /// The same with the code of another instruction set.
    pub(super) fn at_level(mut self, level: InstructionSet) -> Self {
        (self.kernel.level, self.rows.level) = (level, level);
        self
    }

    fn scales(&self, scheme: &Host<T, D>) -> Scales<T> {
        Scales {
            influence: scheme.volume * self.kernel.influence_scale,
            gradient: scheme.volume * self.kernel.gradient_scale,
        }
    }

    /// Lists rows anew where that is needed, and records where all particles are.
    fn refresh_records(&mut self, positions: &[[T; D]], fluid: usize) -> Result<(), Error> {
        let (of_fluid, of_walls) = positions.split_at(fluid);
        let is_new = self.rows.update(of_fluid, of_walls)?;
        let count = positions.len() + 1 + self.rows.images.len();
        if is_new {
            // padding: beyond every support, so never a neighbour
            self.records.places.clear();
            self.records.places.resize(count, [T::from_f64(1e9); 4]);
            self.carried.0.clear();
            self.carried.0.resize(count, [T::ZERO; 4]);
            for (place, x) in self.records.places[fluid..].iter_mut().zip(of_walls) {
                place[..D].copy_from_slice(x);
            }
        }
        for (k, (place, x)) in self.records.places.iter_mut().zip(of_fluid).enumerate() {
            place[..D].copy_from_slice(&self.rows.unwrapped(k, x));
        }
        for (k, image) in self.rows.images.iter().enumerate() {
            let mut place = self.records.places[image.of as usize];
            place.iter_mut().zip(&image.shift).for_each(|(x, &shift)| *x += shift);
            self.records.places[positions.len() + 1 + k] = place;
        }
        Ok(())
    }

    /// Images carry what their particles do.
    fn carry_to_images(&mut self, fluid: usize) {
        let first = fluid + self.wall_count + 1;
        for (k, image) in self.rows.images.iter().enumerate() {
            self.carried.0[first + k] = self.carried.0[image.of as usize];
        }
    }

    /// Gives the walls that have fluid near a number each.
    fn carry_of_walls(&mut self, numbers: impl Fn(usize) -> T) {
        for (k, &wall) in self.rows.wet.iter().enumerate() {
            self.carried.0[wall as usize][3] = numbers(k);
        }
    }

    /// Finds the neighbours of the walls that have fluid near, and what those walls know.
    fn find_walls(&mut self, scheme: &Host<T, D>) {
        let (scales, level) = (self.scales(scheme), self.kernel.level);
        self.walls.clear();
        self.walls.resize(self.rows.wet.len(), Wall::DRY);
        self.wall_values.clear();
        self.wall_values.resize(self.walls.len(), T::ZERO);
        let wet = &self.rows.wet;
        let search = Search {
            kernel: &self.kernel,
            records: &self.records,
            padding: self.rows.padding,
            needed: Needed::Both,
        };
        each(
            search,
            &self.rows.of_walls,
            &mut self.of_walls,
            &mut self.walls,
            |k| wet[k] as usize,
            |near, _, contacts, out| {
                T::dispatch(level, SumWalls { scheme, scales, near, contacts, out });
            },
        );
    }

    /// q_w of the walls, or what flows into them.
    fn sum_walls(&mut self, scheme: &Host<T, D>, of_values: bool) {
        let (carried, all, level) = (&self.carried, &self.walls, self.kernel.level);
        let work = self.of_walls.iter().zip(self.wall_values.chunks_mut(LIST_CHUNK));
        parallel::for_each(work, |chunk, (contacts, out)| {
            let walls = &all[chunk * LIST_CHUNK..][..out.len()];
            T::dispatch(level, SumOfWalls { scheme, carried, contacts, walls, of_values, out });
        });
        let values = std::mem::take(&mut self.wall_values);
        self.carry_of_walls(|k| values[k]);
        self.wall_values = values;
    }
}

/// Finds the neighbours of all particles of the chunks, whose records are at `place(k)`, and sums them.
fn each<T: Real, U: Send, const D: usize>(
    search: Search<'_, T>,
    chunks: &[ListChunk],
    contacts: &mut Vec<Contacts<T, D>>,
    out: &mut [U],
    place: impl Fn(usize) -> usize + Sync,
    sum: impl Fn(&Neighbourhoods<T, D>, Range<usize>, &mut Contacts<T, D>, &mut [U]) + Sync,
) {
    contacts.resize_with(chunks.len(), Contacts::default);
    let work = chunks.iter().zip(contacts.iter_mut()).zip(out.chunks_mut(LIST_CHUNK));
    parallel::for_each_with(work, |near: &mut Neighbourhoods<T, D>, number, ((chunk, contacts), out)| {
        contacts.clear();
        for (group, out) in out.chunks_mut(GROUP).enumerate() {
            let first = group * GROUP;
            let range = number * LIST_CHUNK + first..number * LIST_CHUNK + first + out.len();
            near.find_neighbours(search, chunk, first, range.clone().map(&place));
            sum(near, range, contacts, out);
        }
    });
}

impl<T: Real, const D: usize> Summation<T, D, AnyInfluence<T, D>> for SimdSummation<T, D> {
    fn shapes(
        &mut self,
        scheme: &Host<T, D>,
        positions: &[[T; D]],
        velocities: &[[T; D]],
        shapes: &mut [Shape<T, D>],
    ) -> Result<(), Error> {
        let fluid = shapes.len();
        self.refresh_records(positions, fluid)?;
        self.find_walls(scheme);
        self.carried.set_vectors(velocities);
        let walls = std::mem::take(&mut self.walls);
        for (&wall, known) in self.rows.wet.iter().zip(&walls) {
            self.carried.0[wall as usize] = [known.stiffness, T::ZERO, T::ZERO, known.head];
        }
        self.walls = walls;
        self.carry_to_images(fluid);
        let (scales, level, carried) = (self.scales(scheme), self.kernel.level, &self.carried);
        let search = Search {
            kernel: &self.kernel,
            records: &self.records,
            padding: self.rows.padding,
            needed: Needed::Both,
        };
        each(
            search,
            &self.rows.of_fluid,
            &mut self.of_fluid,
            shapes,
            |k| k,
            |near, range, contacts, out| {
                let velocities = &velocities[range];
                T::dispatch(level, SumShapes { scheme, scales, carried, near, contacts, velocities, out });
            },
        );
        Ok(())
    }

    fn pushes(
        &mut self,
        scheme: &Host<T, D>,
        _: &[[T; D]],
        shapes: &[Shape<T, D>],
        values: &[T],
        pushes: &mut [[T; D]],
    ) -> Result<(), Error> {
        self.carried.set_numbers(values);
        self.carry_to_images(values.len());
        self.sum_walls(scheme, true);
        self.carry_to_images(values.len());
        let (carried, level) = (&self.carried, self.kernel.level);
        let work = self.of_fluid.iter().zip(pushes.chunks_mut(LIST_CHUNK));
        parallel::for_each(work, |chunk, (contacts, out)| {
            let range = chunk * LIST_CHUNK..chunk * LIST_CHUNK + out.len();
            let (shapes, values) = (&shapes[range.clone()], &values[range]);
            T::dispatch(level, SumPushes { scheme, carried, contacts, shapes, values, out });
        });
        Ok(())
    }

    fn rates(
        &mut self,
        scheme: &Host<T, D>,
        _: &[[T; D]],
        shapes: &[Shape<T, D>],
        velocities: &[[T; D]],
        rates: &mut [T],
    ) -> Result<(), Error> {
        self.carried.set_vectors(velocities);
        self.carry_to_images(velocities.len());
        self.sum_walls(scheme, false);
        self.carry_to_images(velocities.len());
        let (carried, level) = (&self.carried, self.kernel.level);
        let work = self.of_fluid.iter().zip(rates.chunks_mut(LIST_CHUNK));
        parallel::for_each(work, |chunk, (contacts, out)| {
            let range = chunk * LIST_CHUNK..chunk * LIST_CHUNK + out.len();
            let (shapes, velocities) = (&shapes[range.clone()], &velocities[range]);
            T::dispatch(level, SumRates { scheme, carried, contacts, shapes, velocities, out });
        });
        Ok(())
    }
}
