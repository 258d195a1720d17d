//! The sums of [`Fields`](super::Fields) at some consecutive points.

use std::marker::PhantomData;

use sph_core::kernel::Kernel;

use super::collect::{Found, collect};
use super::evaluate::{Columns, profile, profile_and_slope};
use super::fields::{Fields, Part};
use super::lanes::Lanes;
use super::simd::{BLOCK, Isa, Job, Real};
use super::sort::Sorted;

/// Memory that jobs use again: a number for each particle in reach of a point, whole blocks of them.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch<T> {
    found: Found<T>,
    /// (x − x_j) / h, axis by axis.
    offsets: [Vec<T>; 3],
    /// r² / h²
    squares: Vec<T>,
    /// f(q)
    profiles: Vec<T>,
    /// f′(q) / q
    slopes: Vec<T>,
    /// c_j, times h_j^{-D} where each has its own h_j.
    picked: Vec<T>,
    /// The same once more divided by h_j.
    steep: Vec<T>,
}

/// Puts one number for each particle found into a list, and `rest` after them up to a whole block.
#[inline(always)]
fn fill<T: Copy>(list: &mut Vec<T>, rest: T, values: impl ExactSizeIterator<Item = T>) {
    let size = values.len().next_multiple_of(BLOCK);
    list.clear();
    list.extend(values);
    list.resize(size, rest);
}

/// The job.
pub(super) struct At<'a, T, const D: usize, K> {
    pub(super) fields: &'a Fields<'a, T, D>,
    pub(super) points: &'a Sorted<T, D>,
    /// σ_D h^{-D} of each part.
    pub(super) constants: &'a [T],
    pub(super) first: usize,
    pub(super) gradient: bool,
    pub(super) values: &'a mut [T],
    pub(super) reached: &'a mut [u32],
    pub(super) scratch: &'a mut Scratch<T>,
    pub(super) kernel: PhantomData<K>,
}

impl<T: Real, const D: usize, K: Kernel> Job<T> for At<'_, T, D, K> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>, const N: usize>(self, isa: I) {
        let row = self.values.len() / self.reached.len();
        let width = self.fields.width;
        for (k, (values, reached)) in
            self.values.chunks_exact_mut(row).zip(self.reached.iter_mut()).enumerate()
        {
            let x = self.points.position(self.first + k);
            for (part, &constant) in self.fields.parts.iter().zip(self.constants) {
                let one = OnePart { part, constant, x: &x, width };
                *reached += if self.gradient {
                    one.add::<K, I, N, true>(isa, values, self.scratch)
                } else {
                    one.add::<K, I, N, false>(isa, values, self.scratch)
                };
            }
        }
    }
}

/// One part's contribution at one point.
struct OnePart<'a, T, const D: usize> {
    part: &'a Part<'a, T, D>,
    constant: T,
    x: &'a [T; D],
    width: usize,
}

impl<T: Real, const D: usize> OnePart<'_, T, D> {
    /// Adds the sums to a row of values; returns how many particles are in reach.
    #[inline(always)]
    fn add<K: Kernel, I: Isa<T>, const N: usize, const GRADIENT: bool>(
        &self,
        isa: I,
        values: &mut [T],
        scratch: &mut Scratch<T>,
    ) -> u32 {
        let limits = self.part.own.map(|own| &own.squares[..]);
        let count =
            collect::<T, D, I, true, true>(isa, self.part.cells, limits, self.x, &mut scratch.found, 0);
        if count == 0 {
            return 0;
        }
        self.prepare(count, scratch);
        if GRADIENT {
            self.offsets(count, scratch);
        }
        kernels::<T, K, D, N, GRADIENT>(scratch);
        let stride = if GRADIENT { 1 + D } else { 1 };
        for field in 0..self.width {
            self.pick::<GRADIENT>(field, count, scratch);
            self.sum::<N, GRADIENT>(scratch, &mut values[field * stride..][..stride]);
        }
        count as u32
    }

    /// r² / h²
    #[inline(always)]
    fn prepare(&self, count: usize, scratch: &mut Scratch<T>) {
        let found = &scratch.found;
        let squares = found.squares[..count].iter();
        match self.part.own {
            None => {
                let inverse = T::ONE / self.part.cells.radius;
                let inverse_square = inverse * inverse;
                fill(&mut scratch.squares, T::ONE, squares.map(|&r2| r2 * inverse_square));
            }
            Some(own) => {
                let places = found.places[..count].iter();
                let inverses = places.map(|&place| own.inverses[place as usize]);
                fill(
                    &mut scratch.squares,
                    T::ONE,
                    squares.zip(inverses).map(|(&r2, inverse)| r2 * (inverse * inverse)),
                );
            }
        }
    }

    /// (x − x_j) / h
    #[inline(always)]
    fn offsets(&self, count: usize, scratch: &mut Scratch<T>) {
        for axis in 0..D {
            let (x, coordinates) = (self.x[axis], &self.part.cells.sorted.coordinates[axis][..]);
            let offsets = scratch.found.places[..count].iter().map(|&place| x - coordinates[place as usize]);
            match self.part.own {
                None => {
                    let inverse = T::ONE / self.part.cells.radius;
                    fill(&mut scratch.offsets[axis], T::ZERO, offsets.map(|offset| offset * inverse));
                }
                Some(own) => {
                    let inverses =
                        scratch.found.places[..count].iter().map(|&place| own.inverses[place as usize]);
                    fill(
                        &mut scratch.offsets[axis],
                        T::ZERO,
                        offsets.zip(inverses).map(|(offset, inverse)| offset * inverse),
                    );
                }
            }
        }
    }

    /// The coefficients of one field.
    #[inline(always)]
    fn pick<const GRADIENT: bool>(&self, field: usize, count: usize, scratch: &mut Scratch<T>) {
        let places = scratch.found.places[..count].iter();
        let picked = places.map(|&place| self.part.coefficients[place as usize * self.width + field]);
        let Some(own) = self.part.own else {
            fill(&mut scratch.picked, T::ZERO, picked);
            return;
        };
        let inverses = scratch.found.places[..count].iter().map(|&place| own.inverses[place as usize]);
        let powers = inverses.clone().map(|inverse| (1..D).fold(inverse, |power, _| power * inverse));
        fill(&mut scratch.picked, T::ZERO, picked.zip(powers).map(|(c, power)| c * power));
        if GRADIENT {
            let picked = scratch.picked[..count].iter();
            fill(&mut scratch.steep, T::ZERO, picked.zip(inverses).map(|(&c, inverse)| c * inverse));
        }
    }

    /// Adds one field's sums to its values.
    #[inline(always)]
    fn sum<const N: usize, const GRADIENT: bool>(&self, scratch: &Scratch<T>, values: &mut [T]) {
        let picked = scratch.picked.as_chunks::<BLOCK>().0;
        let mut value = Columns::<T, N>::ZERO;
        for (f, c) in scratch.profiles.as_chunks().0.iter().zip(picked) {
            for group in 0..BLOCK / N {
                value.add(group, Lanes::of(c, group) * Lanes::of(f, group));
            }
        }
        values[0] += value.total() * self.constant;
        if !GRADIENT {
            return;
        }
        let (steep, unit) = match self.part.own {
            None => (picked, self.constant / self.part.cells.radius),
            Some(_) => (scratch.steep.as_chunks::<BLOCK>().0, self.constant),
        };
        for axis in 0..D {
            let mut slope = Columns::<T, N>::ZERO;
            let offsets = scratch.offsets[axis].as_chunks().0;
            for ((f, c), offset) in scratch.slopes.as_chunks().0.iter().zip(steep).zip(offsets) {
                for group in 0..BLOCK / N {
                    slope.add(group, Lanes::of(c, group) * (Lanes::of(f, group) * Lanes::of(offset, group)));
                }
            }
            values[1 + axis] += slope.total() * unit;
        }
    }
}

/// f(q) and, for gradients, f′(q) / q of all that was found.
#[inline(always)]
fn kernels<T: Real, K: Kernel, const D: usize, const N: usize, const GRADIENT: bool>(
    scratch: &mut Scratch<T>,
) {
    scratch.profiles.resize(scratch.squares.len(), T::ZERO);
    scratch.slopes.resize(scratch.squares.len(), T::ZERO);
    let squares = scratch.squares.as_chunks::<BLOCK>().0;
    let profiles = scratch.profiles.as_chunks_mut::<BLOCK>().0;
    let slopes = scratch.slopes.as_chunks_mut::<BLOCK>().0;
    for ((squares, profiles), slopes) in squares.iter().zip(profiles).zip(slopes) {
        for group in 0..BLOCK / N {
            let s = Lanes::<T, N>::of(squares, group);
            if GRADIENT {
                let (profile, slope) = profile_and_slope::<T, K, D, N>(s);
                profile.put(profiles, group);
                slope.put(slopes, group);
            } else {
                profile::<T, K, D, N>(s).put(profiles, group);
            }
        }
    }
}
