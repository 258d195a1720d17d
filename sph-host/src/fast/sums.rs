//! The sums of an [`Estimate`] at some consecutive points: its terms, a register at a time.

use sph_core::Arithmetic;
use sph_core::field::{Estimate, Reads, SumOf, Summand};

use super::simd::{Isa, Job, Real, Register};
use super::terms::{Group, OneRegister, PointScratch, Terms};

/// The sums of an estimate at each point of a group.
pub(super) struct PointSums<T: Real, const D: usize, E: Estimate<T, D>> {
    moments: Vec<SumOf<T, T, E::Moments<T>>>,
    /// Point by point, a sum for each field.
    fields: Vec<SumOf<T, T, E::Sums<T>>>,
    width: usize,
}

impl<T: Real, const D: usize, E: Estimate<T, D>> Default for PointSums<T, D, E> {
    fn default() -> Self {
        Self { moments: Vec::new(), fields: Vec::new(), width: 0 }
    }
}

impl<T: Real, const D: usize, E: Estimate<T, D>> PointSums<T, D, E> {
    /// Begins anew, with so many fields at so many points.
    pub(super) fn reset(&mut self, points: usize, width: usize) {
        self.width = width;
        self.moments.clear();
        self.moments.resize(points, <E::Moments<T> as Summand<T>>::EMPTY);
        self.fields.clear();
        self.fields.resize(points * width, <E::Sums<T> as Summand<T>>::EMPTY);
    }

    /// Hands over what the sums of each field mean at a point. Returns whether the samples in reach carry the estimate.
    pub(super) fn finish(&self, point: usize, reach: T, mut put: impl FnMut(Option<(T, [T; D])>)) -> bool {
        if self.width == 0 {
            return true;
        }
        let basis = E::basis(<E::Moments<T> as Summand<T>>::total(self.moments[point]), reach);
        for &sums in &self.fields[point * self.width..][..self.width] {
            let sums = <E::Sums<T> as Summand<T>>::total(sums);
            put(basis.as_ref().and_then(|basis| E::finish(basis, sums)));
        }
        basis.is_some()
    }
}

impl<T: Real, const D: usize> Group<'_, T, D> {
    /// Adds the terms of what [`find`](Self::find) found to the sums of an estimate: V_j, unless it has no moments, and the
    /// weighted values of each field.
    pub(super) fn add<E: Estimate<T, D>>(
        &self,
        volumes: &[T],
        weighted_values: &[Vec<T>],
        sums: &mut PointSums<T, D, E>,
        scratch: &mut PointScratch<T, D>,
    ) {
        let level = self.part.cells.level;
        if size_of::<E::Moments<T>>() > 0 && sums.width > 0 {
            self.pick(volumes, scratch);
            T::dispatch(level, AddMoments { group: self, scratch, sums });
        }
        for (field, column) in weighted_values.iter().enumerate() {
            self.pick(column, scratch);
            T::dispatch(level, AddField { group: self, scratch, sums, field });
        }
    }

    /// Sums over what is in reach of each point, a register at a time, and hands over what they come to.
    #[inline(always)]
    fn sum_up<I: Isa<T>, S: Summand<T, I::Reg>>(
        &self,
        scratch: &PointScratch<T, D>,
        reads: Reads,
        add: impl Fn(&mut S::Sum, &OneRegister<'_, T, I, D>),
        mut put: impl FnMut(usize, S::Total),
    ) {
        for (point, (place, &span)) in self.range.clone().zip(&scratch.found.spans).enumerate() {
            let terms = Terms::<T, I, D>::new(self, scratch, reads, span, place);
            let mut parts = I::parts(S::EMPTY);
            for (part, out) in parts.as_mut().iter_mut().enumerate() {
                let mut sums = S::EMPTY;
                for block in 0..terms.weights.len() {
                    add(&mut sums, &OneRegister { terms: &terms, block, first: part * I::Reg::WIDTH });
                }
                *out = sums;
            }
            put(point, S::total(I::join_parts(parts, S::join)));
        }
    }
}

/// Adds to the moments of an estimate.
struct AddMoments<'a, T: Real, const D: usize, E: Estimate<T, D>> {
    group: &'a Group<'a, T, D>,
    scratch: &'a PointScratch<T, D>,
    sums: &'a mut PointSums<T, D, E>,
}

impl<T: Real, const D: usize, E: Estimate<T, D>> Job<T> for AddMoments<'_, T, D, E> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        let Self { group, scratch, sums } = self;
        group.sum_up::<I, E::Moments<I::Reg>>(
            scratch,
            E::READS,
            #[inline(always)]
            |sums, term| E::add_moments(sums, term),
            #[inline(always)]
            |point, total| total.add_weighted(&mut sums.moments[point], group.constant),
        );
    }
}

/// Adds to the sums of one field.
struct AddField<'a, T: Real, const D: usize, E: Estimate<T, D>> {
    group: &'a Group<'a, T, D>,
    scratch: &'a PointScratch<T, D>,
    sums: &'a mut PointSums<T, D, E>,
    field: usize,
}

impl<T: Real, const D: usize, E: Estimate<T, D>> Job<T> for AddField<'_, T, D, E> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, _: I) {
        let Self { group, scratch, sums, field } = self;
        group.sum_up::<I, E::Sums<I::Reg>>(
            scratch,
            E::READS,
            // the value is in the weight
            #[inline(always)]
            |sums, term| E::add(sums, term, I::Reg::ONE),
            #[inline(always)]
            |point, total| total.add_weighted(&mut sums.fields[point * sums.width + field], group.constant),
        );
    }
}
