//! The sums of [`Fields`](super::Fields) at some consecutive points.

use std::marker::PhantomData;
use std::ops::Range;

use sph_core::kernel::Kernel;

use super::collect::{Collect, Found, Span};
use super::evaluate::{Columns, Evaluate};
use super::fields::Part;
use super::lanes::Lanes;
use super::simd::{BLOCK, Isa, Job, Real};
use super::sort::Sorted;

/// Memory that is used again: a number for each particle found, for all points of a group.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch<T> {
    found: Found<T>,
    spans: Vec<Span>,
    /// (x − x_j) / h, axis by axis.
    offsets: [Vec<T>; 3],
    /// f′(q) / q
    slopes: Vec<T>,
    /// c_j, times h_j^{-D} where each has its own h_j.
    picked: Vec<T>,
    /// The same once more divided by h_j.
    steep: Vec<T>,
}

/// One part's contribution at a group of consecutive points.
pub(super) struct Group<'a, T, const D: usize> {
    pub(super) part: &'a Part<'a, T, D>,
    /// σ_D h^{-D}, or σ_D.
    pub(super) constant: T,
    pub(super) points: &'a Sorted<T, D>,
    pub(super) range: Range<usize>,
    pub(super) width: usize,
    pub(super) gradient: bool,
}

impl<T: Real, const D: usize> Group<'_, T, D> {
    /// Adds the sums to rows of values, and how many particles are in reach.
    pub(super) fn add<K: Kernel>(&self, values: &mut [T], reached: &mut [u32], scratch: &mut Scratch<T>) {
        let (cells, level) = (self.part.cells, self.part.cells.level);
        let search = Collect {
            cells,
            own_limits: self.part.own.map(|own| &own.squares[..]),
            points: self.points,
            range: self.range.clone(),
            places: true,
            found: &mut scratch.found,
            spans: &mut scratch.spans,
        };
        let end = T::dispatch(level, search);
        for (reached, span) in reached.iter_mut().zip(&scratch.spans) {
            *reached += span.count as u32;
        }
        T::dispatch(level, Prepare { group: self, end, scratch });
        let slopes = if self.gradient { &mut scratch.slopes[..end] } else { &mut [] };
        let squares = &mut scratch.found.squares[..end];
        T::dispatch(level, Evaluate { squares, slopes, kernel: PhantomData::<K>, line: D == 1 });
        T::dispatch(level, SumUp { group: self, end, values, scratch });
    }

    /// Fills a list with a number for each particle found, and with zeros between.
    #[inline(always)]
    fn fill(
        list: &mut Vec<T>,
        spans: &[Span],
        places: &[u32],
        end: usize,
        value: impl Fn(usize, usize) -> T,
    ) {
        if list.len() < end {
            list.resize(end, T::ZERO);
        }
        for (point, span) in spans.iter().enumerate() {
            let out = &mut list[span.padded()];
            for (out, &place) in out.iter_mut().zip(&places[span.particles()]) {
                *out = value(point, place as usize);
            }
            out[span.count..].fill(T::ZERO);
        }
    }
}

/// Makes r² / h² of r², and (x − x_j) / h.
struct Prepare<'a, T, const D: usize> {
    group: &'a Group<'a, T, D>,
    end: usize,
    scratch: &'a mut Scratch<T>,
}

impl<T: Real, const D: usize> Job<T> for Prepare<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>, const N: usize>(self, _: I) {
        let (part, end) = (self.group.part, self.end);
        let Scratch { found, spans, offsets, slopes, .. } = self.scratch;
        let Found { squares, places } = found;
        let inverse = T::ONE / part.cells.radius;
        match part.own {
            None => squares[..end].iter_mut().for_each(|r2| *r2 = *r2 * (inverse * inverse)),
            Some(own) => {
                for span in spans.iter() {
                    for (r2, &place) in squares[span.particles()].iter_mut().zip(&places[span.particles()]) {
                        let inverse = own.inverses[place as usize];
                        *r2 = *r2 * (inverse * inverse);
                    }
                }
            }
        }
        if !self.group.gradient {
            return;
        }
        if slopes.len() < end {
            slopes.resize(end, T::ZERO);
        }
        for axis in 0..D {
            let coordinates = &part.cells.sorted.coordinates[axis][..];
            let points = &self.group.points.coordinates[axis][self.group.range.clone()];
            match part.own {
                None => Group::<T, D>::fill(
                    &mut offsets[axis],
                    spans,
                    places,
                    end,
                    #[inline(always)]
                    |point, place| (points[point] - coordinates[place]) * inverse,
                ),
                Some(own) => Group::<T, D>::fill(
                    &mut offsets[axis],
                    spans,
                    places,
                    end,
                    #[inline(always)]
                    |point, place| (points[point] - coordinates[place]) * own.inverses[place],
                ),
            }
        }
    }
}

/// Adds up what kernels and coefficients make together.
struct SumUp<'a, T, const D: usize> {
    group: &'a Group<'a, T, D>,
    end: usize,
    values: &'a mut [T],
    scratch: &'a mut Scratch<T>,
}

impl<T: Real, const D: usize> Job<T> for SumUp<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>, const N: usize>(mut self, _: I) {
        for field in 0..self.group.width {
            self.pick(field);
            self.add::<N>(field);
        }
    }
}

impl<T: Real, const D: usize> SumUp<'_, T, D> {
    /// The coefficients of one field.
    #[inline(always)]
    fn pick(&mut self, field: usize) {
        let Group { part, width, gradient, .. } = self.group;
        let Scratch { found, spans, picked, steep, .. } = &mut *self.scratch;
        let (places, end) = (&found.places[..], self.end);
        let Some(own) = part.own else {
            Group::<T, D>::fill(
                picked,
                spans,
                places,
                end,
                #[inline(always)]
                |_, place| part.coefficients[place * width + field],
            );
            return;
        };
        Group::<T, D>::fill(
            picked,
            spans,
            places,
            end,
            #[inline(always)]
            |_, place| {
                let inverse = own.inverses[place];
                part.coefficients[place * width + field] * (1..D).fold(inverse, |power, _| power * inverse)
            },
        );
        if *gradient {
            Group::<T, D>::fill(
                steep,
                spans,
                places,
                end,
                #[inline(always)]
                |_, place| own.inverses[place],
            );
            steep.iter_mut().zip(&picked[..end]).for_each(|(steep, &c)| *steep = *steep * c);
        }
    }

    /// Adds one field's sums to its values.
    #[inline(always)]
    fn add<const N: usize>(&mut self, field: usize) {
        let Group { part, constant, gradient, width, .. } = self.group;
        let stride = if *gradient { 1 + D } else { 1 };
        let Scratch { found, spans, offsets, slopes, picked, steep } = &*self.scratch;
        let (steep, unit) = match part.own {
            None => (picked, *constant / part.cells.radius),
            Some(_) => (steep, *constant),
        };
        for (span, values) in spans.iter().zip(self.values.chunks_exact_mut(stride * width)) {
            let values = &mut values[field * stride..][..stride];
            let blocks = span.padded();
            values[0] +=
                products::<T, N>(&picked[blocks.clone()], &found.squares[blocks.clone()]) * *constant;
            if *gradient {
                for axis in 0..D {
                    let (c, f, x) =
                        (&steep[blocks.clone()], &slopes[blocks.clone()], &offsets[axis][blocks.clone()]);
                    values[1 + axis] += triple_products::<T, N>(c, f, x) * unit;
                }
            }
        }
    }
}

/// Σ c f
#[inline(always)]
fn products<T: Real, const N: usize>(c: &[T], f: &[T]) -> T {
    let mut columns = Columns::<T, N>::ZERO;
    for (c, f) in c.as_chunks::<BLOCK>().0.iter().zip(f.as_chunks::<BLOCK>().0) {
        for group in 0..BLOCK / N {
            columns.add(group, Lanes::of(c, group) * Lanes::of(f, group));
        }
    }
    columns.total()
}

/// Σ c (f x)
#[inline(always)]
fn triple_products<T: Real, const N: usize>(c: &[T], f: &[T], x: &[T]) -> T {
    let mut columns = Columns::<T, N>::ZERO;
    let (c, f, x) = (c.as_chunks::<BLOCK>().0, f.as_chunks::<BLOCK>().0, x.as_chunks::<BLOCK>().0);
    for ((c, f), x) in c.iter().zip(f).zip(x) {
        for group in 0..BLOCK / N {
            columns.add(group, Lanes::of(c, group) * (Lanes::of(f, group) * Lanes::of(x, group)));
        }
    }
    columns.total()
}
