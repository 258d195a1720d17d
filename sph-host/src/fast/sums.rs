//! The sums of [`Fields`](super::Fields) at some consecutive points.

use std::marker::PhantomData;
use std::ops::Range;

use sph_core::Arithmetic;
use sph_core::kernel::Kernel;

use super::blocks::reserve;
use super::collect::{Collect, Found, Pick};
use super::evaluate::Evaluate;
use super::fields::Part;
use super::simd::{Isa, Job, Real, Register};
use super::sort::Sorted;

/// Memory that is used again: a number for each particle found, for all points of a group.
#[derive(Clone, Debug)]
pub(super) struct PointScratch<T, const D: usize> {
    found: Found<T>,
    /// f(q)
    profiles: Vec<T>,
    /// f′(q) / q
    slopes: Vec<T>,
    /// x_j, axis by axis.
    coordinates: [Vec<T>; D],
    /// 1 / h_j, where each has its own h_j.
    inverses: Vec<T>,
    /// c_j
    coefficients: Vec<T>,
}

impl<T, const D: usize> Default for PointScratch<T, D> {
    fn default() -> Self {
        Self {
            found: Found { squares: Vec::new(), blocks: Vec::new(), spans: Vec::new() },
            profiles: Vec::new(),
            slopes: Vec::new(),
            coordinates: [const { Vec::new() }; D],
            inverses: Vec::new(),
            coefficients: Vec::new(),
        }
    }
}

/// One part's contribution at a group of consecutive points.
pub(super) struct Group<'a, T, const D: usize> {
    pub(super) part: &'a Part<'a, T, D>,
    /// σ_D h^{-D}, or σ_D.
    pub(super) constant: T,
    pub(super) points: &'a Sorted<T, D>,
    pub(super) range: Range<usize>,
    pub(super) gradient: bool,
}

impl<T: Real, const D: usize> Group<'_, T, D> {
    /// Adds the sums to rows of values, and how many particles are in reach.
    pub(super) fn add<K: Kernel>(
        &self,
        values: &mut [T],
        reached: &mut [u32],
        scratch: &mut PointScratch<T, D>,
    ) {
        let Part { cells, own, coefficients } = self.part;
        let level = cells.level;
        let PointScratch { found, profiles, slopes, coordinates, inverses, coefficients: _ } = scratch;
        let own_limits = own.map(|own| &own.squares[..]);
        let (points, range) = (self.points, self.range.clone());
        let end = T::dispatch(level, Collect { cells, own_limits, points, range, found });
        for (reached, span) in reached.iter_mut().zip(&found.spans) {
            *reached += span.count as u32;
        }
        if let Some(own) = own {
            T::dispatch(level, Pick { found, columns: [&own.inverses], out: [inverses] });
        }
        if self.gradient {
            let out = coordinates.each_mut();
            T::dispatch(level, Pick { found, columns: cells.sorted.padded(), out });
        }
        reserve(profiles, end);
        reserve(slopes, end);
        let evaluate = Evaluate::<T, K, D> {
            squares: &found.squares[..end],
            inverse: T::ONE / cells.radius,
            inverses: own.map(|_| &inverses[..end]),
            profiles: &mut profiles[..end],
            slopes: if self.gradient { &mut slopes[..end] } else { &mut [] },
            kernel: PhantomData::<K>,
        };
        T::dispatch(level, evaluate);
        let stride = if self.gradient { 1 + D } else { 1 };
        for (field, column) in coefficients.iter().enumerate() {
            T::dispatch(
                level,
                Pick { found: &scratch.found, columns: [column], out: [&mut scratch.coefficients] },
            );
            let rows = values.chunks_exact_mut(stride * coefficients.len());
            T::dispatch(level, SumUp { group: self, values: rows, first: field * stride, scratch });
        }
    }
}

/// Adds up what kernels and the coefficients of one field make together.
struct SumUp<'a, T, const D: usize> {
    group: &'a Group<'a, T, D>,
    /// A row for each point.
    values: std::slice::ChunksExactMut<'a, T>,
    /// Where in a row the field's values are.
    first: usize,
    scratch: &'a PointScratch<T, D>,
}

impl<T: Real, const D: usize> Job<T> for SumUp<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        match (self.group.gradient, self.group.part.own.is_some()) {
            (false, false) => self.all::<I, false, false>(),
            (false, true) => self.all::<I, false, true>(),
            (true, false) => self.all::<I, true, false>(),
            (true, true) => self.all::<I, true, true>(),
        }
    }
}

impl<T: Real, const D: usize> SumUp<'_, T, D> {
    /// OWN: each particle has its own h.
    #[inline(always)]
    fn all<I: Isa<T>, const GRADIENT: bool, const OWN: bool>(self) {
        let Self { group: Group { part, constant, points, range, .. }, values, first, scratch } = self;
        let inverse = if OWN { T::ONE } else { T::ONE / part.cells.radius };
        for ((place, &span), values) in range.clone().zip(&scratch.found.spans).zip(values) {
            let x: [I::Reg; D] = I::splat_vector(&points.position(place));
            let (f, c) = (span.blocks_of(&scratch.profiles), span.blocks_of(&scratch.coefficients));
            let slopes = if GRADIENT { span.blocks_of(&scratch.slopes) } else { c };
            let inverses = if OWN { span.blocks_of(&scratch.inverses) } else { c };
            let mut coordinates = [c; D];
            for axis in 0..D {
                if GRADIENT {
                    coordinates[axis] = span.blocks_of(&scratch.coordinates[axis]);
                }
            }
            let mut value = I::parts(I::Reg::ZERO);
            let mut gradient = [I::parts(I::Reg::ZERO); D];
            for block in 0..c.len() {
                for part in 0..I::PARTS {
                    let at = part * I::Reg::WIDTH;
                    let mut c = I::Reg::load_at(&c[block], at);
                    if OWN {
                        for _ in 0..D {
                            c = c * I::Reg::load_at(&inverses[block], at);
                        }
                    }
                    value.as_mut()[part] += c * I::Reg::load_at(&f[block], at);
                    if GRADIENT {
                        let mut slope = I::Reg::load_at(&slopes[block], at);
                        if OWN {
                            let inverse = I::Reg::load_at(&inverses[block], at);
                            (c, slope) = (c * inverse, slope * inverse);
                        }
                        for axis in 0..D {
                            let d = x[axis] - I::Reg::load_at(&coordinates[axis][block], at);
                            gradient[axis].as_mut()[part] += c * (slope * d);
                        }
                    }
                }
            }
            let values = &mut values[first..];
            values[0] += I::total_of_parts(value) * *constant;
            if GRADIENT {
                for axis in 0..D {
                    values[1 + axis] += (I::total_of_parts(gradient[axis]) * inverse) * (*constant * inverse);
                }
            }
        }
    }
}
