//! Verlet lists, rows of candidates that are kept for several steps: all particles within the support radius and a skin, listed anew when
//! one has moved by half the skin.
//!
//! Along a periodic axis, particles near its ends have images beyond the other end: records of their own, which follow the
//! particle for as long as the rows are kept.

use sph_core::vector::{add, norm_squared, sub};
use sph_core::{Axis, Domain, Error};

use crate::fast::{BLOCK, Block, InstructionSet, Isa, Job, Real, SortedCells, list_places, sixteen_mut};
use crate::parallel;

/// The skin over the support radius, in support radii. Wider, rows last longer and each look at them takes longer.
const SKIN: f64 = 0.12;

/// Particles whose rows are kept together.
pub(super) const LIST_CHUNK: usize = 256;

/// The rows of the fluid, and of the walls that have fluid near.
pub(super) struct VerletLists<T, const D: usize> {
    domain: Domain<T, D>,
    /// The support radius with the skin.
    reach: T,
    /// How far a particle may move before rows are listed anew.
    max_displacement: T,
    /// Where the fluid was when the rows were listed; empty when they are to be listed anew. Walls do not move.
    listed_at: Vec<[T; D]>,
    walls: CandidateSet<T, D>,
    /// Where the images of walls are among the records, and after them those of the fluid.
    pub(super) images: Vec<Image<T, D>>,
    /// How many of them are of walls.
    pub(super) wall_images: usize,
    pub(super) of_fluid: Vec<ListChunk>,
    pub(super) of_walls: Vec<ListChunk>,
    /// The records of walls that have fluid near, to each of which a row of `of_walls` belongs.
    pub(super) wet: Vec<u32>,
    /// The record that pads blocks: never a neighbour.
    pub(super) padding: u32,
    pub(super) level: InstructionSet,
}

/// A particle again, elsewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Image<T, const D: usize> {
    /// The record of the particle.
    pub(super) of: u32,
    pub(super) shift: [T; D],
}

/// Particles that are candidates together, with their images.
struct CandidateSet<T, const D: usize> {
    cells: SortedCells<T, D>,
    /// The record of each, in the order of the cells.
    records: Vec<u32>,
}

/// The rows of [`LIST_CHUNK`] particles: candidates from the fluid, then from the walls, each filled up to whole blocks with padding.
#[derive(Clone, Debug, Default)]
pub(super) struct ListChunk {
    ends: Vec<[usize; 2]>,
    candidates: Vec<u32>,
}

impl ListChunk {
    /// How many rows there are.
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The candidates of the k-th particle in blocks: from the fluid, from the walls.
    #[inline(always)]
    pub(super) fn row(&self, k: usize) -> [&[[u32; BLOCK]]; 2] {
        let first = if k == 0 { 0 } else { self.ends[k - 1][1] };
        let [middle, last] = self.ends[k];
        [self.candidates[first..middle].as_chunks().0, self.candidates[middle..last].as_chunks().0]
    }
}

impl<T: Real, const D: usize> VerletLists<T, D> {
    /// For walls that stand still after so many fluid particles.
    pub(super) fn new(
        domain: Domain<T, D>,
        support: T,
        fluid: usize,
        walls: &[[T; D]],
    ) -> Result<Self, Error> {
        let reach = support * T::from_f64(1.0 + SKIN);
        let mut images = Vec::new();
        let padding = fluid + walls.len();
        let walls = CandidateSet::new(&domain, reach, walls, fluid, padding + 1, &mut images)?;
        Ok(Self {
            domain,
            reach,
            max_displacement: support * T::from_f64(0.499 * SKIN),
            listed_at: Vec::new(),
            walls,
            wall_images: images.len(),
            images,
            of_fluid: Vec::new(),
            of_walls: Vec::new(),
            wet: Vec::new(),
            padding: padding as u32,
            level: InstructionSet::best(),
        })
    }

    /// Has rows listed anew: particles have changed places.
    pub(super) fn forget(&mut self) {
        self.listed_at.clear();
    }

    /// The numbers of fluid particles in the order of their cells, by number within a cell.
    pub(super) fn order(&self, fluid: &[[T; D]]) -> Result<Vec<u32>, Error> {
        Ok(SortedCells::sort(fluid, self.reach)?.order().to_vec())
    }

    /// Where a particle is on the side where it was when the rows were listed.
    #[inline(always)]
    pub(super) fn unwrapped(&self, k: usize, x: &[T; D]) -> [T; D] {
        unwrapped(&self.domain, x, &self.listed_at[k])
    }

    /// Lists rows anew where that is needed, and says whether it was.
    pub(super) fn update(&mut self, fluid: &[[T; D]], walls: &[[T; D]]) -> Result<bool, Error> {
        let (max_displacement, domain) = (self.max_displacement * self.max_displacement, &self.domain);
        let is_near = |(x, at): (&[T; D], &[T; D])| {
            norm_squared(&sub(&unwrapped(domain, x, at), at)) < max_displacement
        };
        let chunks = fluid.chunks(LIST_CHUNK).zip(self.listed_at.chunks(LIST_CHUNK));
        let are_near = parallel::map(chunks, |_, (fluid, at)| fluid.iter().zip(at).all(is_near));
        if !self.listed_at.is_empty() && are_near.into_iter().all(|near| near) {
            return Ok(false);
        }
        self.images.truncate(self.wall_images);
        let first_image = fluid.len() + walls.len() + 1 + self.wall_images;
        let candidates_of_fluid =
            CandidateSet::new(&self.domain, self.reach, fluid, 0, first_image, &mut self.images)?;
        let padding = self.padding;
        list(&mut self.of_fluid, self.level, padding, fluid, &[&candidates_of_fluid, &self.walls]);
        self.find_wet(fluid.len(), walls.len());
        let wet: Vec<[T; D]> = self.wet.iter().map(|&wall| walls[wall as usize - fluid.len()]).collect();
        list(&mut self.of_walls, self.level, padding, &wet, &[&candidates_of_fluid]);
        self.listed_at.clear();
        self.listed_at.extend_from_slice(fluid);
        Ok(true)
    }

    /// Finds the walls that are candidates of the fluid, themselves or by an image.
    fn find_wet(&mut self, fluid: usize, walls: usize) {
        let mut is_wet = vec![false; walls];
        for chunk in &self.of_fluid {
            for k in 0..chunk.len() {
                for &record in chunk.row(k)[1].as_flattened() {
                    let record = record as usize;
                    let image = record.checked_sub(fluid + walls + 1).map(|image| &self.images[image]);
                    let wall = image.map_or(record, |image| image.of as usize) - fluid;
                    if let Some(wet) = is_wet.get_mut(wall) {
                        *wet = true;
                    }
                }
            }
        }
        self.wet.clear();
        self.wet.extend((0..walls).filter(|&wall| is_wet[wall]).map(|wall| (fluid + wall) as u32));
    }
}

impl<T: Real, const D: usize> CandidateSet<T, D> {
    /// Particles whose records begin at `first`, and their images, whose records begin at `first_image`.
    fn new(
        domain: &Domain<T, D>,
        reach: T,
        particles: &[[T; D]],
        first: usize,
        first_image: usize,
        images: &mut Vec<Image<T, D>>,
    ) -> Result<Self, Error> {
        let old = images.len();
        let mut all = particles.to_vec();
        for (axis, kind) in domain.axes().iter().enumerate() {
            let Axis::Periodic { lower, length } = *kind else { continue };
            for k in 0..all.len() {
                let x = all[k][axis];
                for (is_near, period) in [(x < lower + reach, length), (x > lower + length - reach, -length)]
                {
                    if is_near {
                        let mut image = match k.checked_sub(particles.len()) {
                            None => Image { of: (first + k) as u32, shift: [T::ZERO; D] },
                            Some(image) => images[old + image],
                        };
                        image.shift[axis] = period;
                        images.push(image);
                        all.push(add(&particles[image.of as usize - first], &image.shift));
                    }
                }
            }
        }
        let cells = SortedCells::sort(&all, reach)?;
        let record = |&place: &u32| match (place as usize).checked_sub(particles.len()) {
            None => first as u32 + place,
            Some(image) => (first_image + image) as u32,
        };
        Ok(Self { records: cells.order().iter().map(record).collect(), cells })
    }
}

#[inline(always)]
fn unwrapped<T: Real, const D: usize>(domain: &Domain<T, D>, x: &[T; D], at: &[T; D]) -> [T; D] {
    let mut near = *x;
    for axis in 0..D {
        if let Axis::Periodic { length, .. } = domain.axes()[axis] {
            let (moved, half) = (x[axis] - at[axis], length * T::ratio(1, 2));
            if moved > half {
                near[axis] -= length;
            } else if moved < -half {
                near[axis] += length;
            }
        }
    }
    near
}

/// Lists the rows of particles at `positions` in chunks.
fn list<T: Real, const D: usize>(
    chunks: &mut Vec<ListChunk>,
    level: InstructionSet,
    padding: u32,
    positions: &[[T; D]],
    candidate_sets: &[&CandidateSet<T, D>],
) {
    chunks.resize(positions.len().div_ceil(LIST_CHUNK), ListChunk::default());
    parallel::for_each(chunks.iter_mut().zip(positions.chunks(LIST_CHUNK)), |_, (chunk, positions)| {
        T::dispatch(level, List { chunk, padding, positions, candidate_sets });
    });
}

/// Lists the rows of a chunk.
struct List<'a, T, const D: usize> {
    chunk: &'a mut ListChunk,
    padding: u32,
    positions: &'a [[T; D]],
    candidate_sets: &'a [&'a CandidateSet<T, D>],
}

impl<T: Real, const D: usize> Job<T> for List<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { chunk: ListChunk { ends: chunk_ends, candidates }, padding, positions, candidate_sets } =
            self;
        let mut blocks: Vec<Block> = Vec::new();
        chunk_ends.clear();
        let mut end = 0;
        for x in positions {
            let mut ends = [0; 2];
            for part in 0..2 {
                if let Some(set) = candidate_sets.get(part) {
                    let first = end;
                    end = list_places(isa, &set.cells, x, &mut blocks, candidates, first);
                    for place in &mut candidates[first..end] {
                        *place = set.records[*place as usize];
                    }
                    *sixteen_mut(candidates, end) = [padding; BLOCK];
                    end = end.next_multiple_of(BLOCK);
                }
                ends[part] = end;
            }
            chunk_ends.push(ends);
        }
    }
}
