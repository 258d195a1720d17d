//! One frame: predict, sort by cell, then a density sweep and a correcting sweep for each iteration.

use super::particle::Packed;
use super::tuning::Tuning;
use super::{BorrowedFluid, FASTEST, Particle, STEEPEST, clamp_to_near, ratio};
use crate::Arithmetic;
use crate::fluid::Container;
use crate::kernel::Poly6;
use crate::neighbours::Index;
use crate::scalar::compact::{Compact, NearUnit, Pack};
use crate::vector::{add, scale, sub};

/// t = 1 − q² of a pair and its offset x_ij / h, within the support.
#[inline(always)]
fn closeness<T: Compact, const D: usize>(
    this: &Particle<T, D>,
    other: &Particle<T, D>,
) -> Option<([T::Near; D], T::Near)> {
    let offset = sub(&this.place, &other.place);
    let t = T::Near::ONE - T::Near::norm_squared(&offset);
    if t > T::Near::ZERO { Some((offset, t)) } else { None }
}

impl<T: Compact, C: Container<T, D>, I: Index, const D: usize> BorrowedFluid<'_, T, C, D, I> {
    pub(super) fn predict(&mut self, acceleration: [T; D]) {
        let acceleration = acceleration.map(|a| clamp_to_near(a, STEEPEST));
        let fastest = ratio(FASTEST);
        self.order.clear();
        for (i, p) in self.particles.iter_mut().enumerate() {
            let way = add(&p.velocity.unpack(), &acceleration).map(|along| along.clamp_abs(fastest));
            p.advance(&way, Pack::ZERO, (self.container, gap(i)));
            p.neighbour_mask = self.order.count(p.place.map(NearUnit::floor)) as i32;
        }
    }

    pub(super) fn sort(&mut self) {
        self.order.sort(self.particles, |p| p.neighbour_mask as usize);
    }

    /// Density, XSPH viscosity, and which pairs are in reach.
    pub(super) fn search(&mut self) {
        let (container, settings) = (self.container, self.settings);
        let tuning = const { Tuning::of::<D>() };
        let viscosity = T::Near::ratio(1, 256).times(settings.viscosity.min(tuning.most_viscosity).into());
        self.order.sweep(
            self.particles,
            (T::Near::ZERO, Packed::<T, D>::ZERO),
            closeness,
            |this, (weight, drag), other, (_, t)| {
                let w = Poly6::of_complement(t);
                *weight += w;
                other.partial_density = (T::Near::load_weight(other.partial_density) + w).store_weight();
                let difference = other.velocity.minus(this.velocity).unpack();
                let pull = Packed::<T, D>::pack(scale(&difference, w * viscosity));
                *drag = drag.plus(pull);
                other.push = other.push.minus(pull);
            },
            |p, (weight, drag), reach| {
                p.neighbour_mask = reach;
                finish_density(container, settings.cohesion, p, weight, drag.plus(p.push));
            },
        );
    }

    pub(super) fn density(&mut self) {
        let (container, settings) = (self.container, self.settings);
        self.order.revisit(
            self.particles,
            T::Near::ZERO,
            |p| p.neighbour_mask,
            closeness,
            |_, sum, other, (_, t)| {
                let w = Poly6::of_complement(t);
                *sum += w;
                other.partial_density = (T::Near::load_weight(other.partial_density) + w).store_weight();
            },
            |p, sum| finish_density(container, settings.cohesion, p, sum, Pack::ZERO),
        );
    }

    pub(super) fn correct(&mut self) {
        let container = self.container;
        let tuning = const { Tuning::of::<D>() };
        let limit = ratio(tuning.longest_correction);
        let core = ratio(tuning.core);
        let mut i = 0_usize;
        self.order.revisit(
            self.particles,
            Packed::<T, D>::ZERO,
            |p| p.neighbour_mask,
            closeness,
            |this, sum, other, (offset, t)| {
                let pressure = T::Near::load(this.pressure) + T::Near::load(other.pressure);
                let mut strength = pressure * Poly6::of_complement(t);
                if t > core {
                    strength += t - core;
                    if t == T::Near::ONE {
                        let parting = Packed::<T, D>::pack([ratio(tuning.parting); D]);
                        *sum = sum.plus(parting);
                        other.push = other.push.minus(parting);
                    }
                }
                let push = Packed::<T, D>::pack(scale(&offset, strength));
                *sum = sum.plus(push);
                other.push = other.push.minus(push);
            },
            |p, sum| {
                let way = sum.plus(p.push).unpack().map(|along| along.clamp_abs(limit));
                p.advance(&way, p.velocity, (container, gap(i)));
                i = i.wrapping_add(1);
                p.push = Pack::ZERO;
            },
        );
    }
}

/// From the kernel's sum to the pressure and the wall's push.
#[inline(always)]
fn finish_density<T: Compact, C: Container<T, D>, const D: usize>(
    container: &C,
    cohesion: u8,
    p: &mut Particle<T, D>,
    weight: T::Near,
    push: Packed<T, D>,
) {
    let wall = container.wall(&p.place);
    let share = wall.map_or(T::Near::ZERO, |wall| wall.share);
    let tuning = const { Tuning::of::<D>() };
    let sum = T::Near::ONE + weight + T::Near::load_weight(p.partial_density);
    let excess = sum * ratio(tuning.per_rest_sum) + share - T::Near::ONE;
    let raw = excess * ratio(tuning.stiffness) + T::Near::load(p.pressure) * ratio(tuning.kept_pressure);
    let kept = T::Near::ratio(1, 256).times(cohesion.min(tuning.most_cohesion).into());
    let highest = ratio(tuning.highest_pressure);
    let pressure = if raw > highest {
        highest
    } else if raw > T::Near::ZERO {
        raw
    } else {
        raw * kept
    };
    p.pressure = pressure.store_low();
    p.partial_density = T::Near::NO_WEIGHT;
    p.push = push;
    if let Some(wall) = wall {
        let on_wall = pressure * ratio(tuning.wall_push);
        p.push = push.plus(Pack::pack(wall.push.map(|along| along.mul_rounded(on_wall))));
    }
}

/// How far from a wall the i-th particle is put back: 1/128 to 1/8, so that what a blow presses to a wall does not stay
/// in one line with zero thickness.
#[inline(always)]
fn gap<N: NearUnit>(i: usize) -> N {
    N::ratio(1, 128).times((1 + (i & 15)) as i32)
}
