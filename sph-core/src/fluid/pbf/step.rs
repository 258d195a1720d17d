//! One frame: predict, sort by cell, then a density sweep and a correcting sweep for each iteration.

use super::particle::Packed;
use super::tuning::Tuning;
use super::{BorrowedFluid, FASTEST, Particle, STEEPEST, Settings, clamp_to_near, ratio};
use crate::Arithmetic;
use crate::fluid::Container;
use crate::kernel::Poly6;
use crate::neighbours::{CellOrder, Index};
use crate::scalar::compact::{Compact, NearUnit, Pack};
use crate::vector::{scale, sub};

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
        predict(self.container, self.particles, &mut self.order, acceleration);
    }

    pub(super) fn sort(&mut self) {
        self.order.sort(self.particles, |p| p.neighbour_mask as usize);
    }

    pub(super) fn search(&mut self) {
        search(self.container, self.settings, self.particles, &self.order);
    }

    pub(super) fn density(&mut self) {
        density(self.container, self.settings, self.particles, &self.order);
    }

    pub(super) fn correct(&mut self) {
        correct(self.container, self.particles, &self.order);
    }
}

// Functions of references, which the compiler knows to be apart: it keeps what it has read of the container.

fn predict<T: Compact, C: Container<T, D>, I: Index, const D: usize>(
    container: &C,
    particles: &mut [Particle<T, D>],
    order: &mut CellOrder<'_, I, D>,
    acceleration: [T; D],
) {
    let acceleration = Packed::<T, D>::pack(acceleration.map(|a| clamp_to_near(a, STEEPEST)));
    let fastest = ratio(FASTEST);
    order.clear();
    for (i, p) in particles.iter_mut().enumerate() {
        let way = p.velocity.plus(acceleration).clamped(fastest);
        p.advance(way, Pack::ZERO, (container, gap(i)));
        p.neighbour_mask = order.count(p.place.map(NearUnit::floor)) as u32;
    }
}

/// Density, XSPH viscosity, and which pairs are in reach.
fn search<T: Compact, C: Container<T, D>, I: Index, const D: usize>(
    container: &C,
    settings: Settings,
    particles: &mut [Particle<T, D>],
    order: &CellOrder<'_, I, D>,
) {
    let tuning = const { Tuning::of::<D>() };
    let viscosity = T::Near::ratio(1, 256).times(settings.viscosity.min(tuning.most_viscosity).into());
    order.sweep(
        particles,
        (T::Near::ZERO, Packed::<T, D>::ZERO),
        closeness,
        |this, (weight, drag), other, (_, t)| {
            let w = Poly6::of_complement(t);
            *weight += w;
            other.pressure += w;
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

fn density<T: Compact, C: Container<T, D>, I: Index, const D: usize>(
    container: &C,
    settings: Settings,
    particles: &mut [Particle<T, D>],
    order: &CellOrder<'_, I, D>,
) {
    order.revisit(
        particles,
        T::Near::ZERO,
        |p| p.neighbour_mask,
        closeness,
        |_, sum, other, (_, t)| {
            let w = Poly6::of_complement(t);
            *sum += w;
            other.pressure += w;
        },
        |p, sum, _| finish_density(container, settings.cohesion, p, sum, Pack::ZERO),
    );
}

fn correct<T: Compact, C: Container<T, D>, I: Index, const D: usize>(
    container: &C,
    particles: &mut [Particle<T, D>],
    order: &CellOrder<'_, I, D>,
) {
    let tuning = const { Tuning::of::<D>() };
    let limit = ratio(tuning.longest_correction);
    let core = ratio(tuning.core);
    order.revisit(
        particles,
        Packed::<T, D>::ZERO,
        |p| p.neighbour_mask,
        closeness,
        |this, sum, other, (offset, t)| {
            let pressure = this.pressure + other.pressure;
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
        |p, sum, behind| {
            let way = sum.plus(p.push).clamped(limit);
            p.advance(way, p.velocity, (container, gap(behind)));
            p.push = Pack::ZERO;
        },
    );
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
    let per_rest_sum = ratio::<T::Near>(tuning.per_rest_sum);
    let excess = (p.pressure + weight) * per_rest_sum + (share - (T::Near::ONE - per_rest_sum));
    let raw = excess * ratio(tuning.stiffness);
    let kept = T::Near::ratio(1, 256).times(cohesion.min(tuning.most_cohesion).into());
    let highest = ratio(tuning.highest_pressure);
    let pressure = if raw > highest {
        highest
    } else if raw > T::Near::ZERO {
        raw
    } else {
        raw * kept
    };
    p.pressure = pressure;
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
