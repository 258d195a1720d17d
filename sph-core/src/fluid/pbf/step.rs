//! One frame: predict, sort by cell, then a density sweep and a correcting sweep for each iteration.

use super::{BorrowedFluid, FASTEST, Particle, STEEPEST, near_held, ratio};
use crate::Arithmetic;
use crate::fluid::Container;
use crate::kernel::Poly6;
use crate::neighbours::Index;
use crate::scalar::compact::{Compact, Near};
use crate::vector::{norm_squared, scale};

/// What the first sweep gathers for a particle.
struct Search<N, const D: usize> {
    weight: N,
    drag: [N; D],
}

/// t = 1 − q² of a pair, and its offset x_ij / h.
#[inline(always)]
fn closeness<T: Compact, const D: usize>(
    this: &Particle<T, D>,
    other: &Particle<T, D>,
) -> ([T::Near; D], T::Near) {
    let offset = core::array::from_fn(|axis| this.position[axis].offset(other.position[axis]));
    let t = T::Near::ONE - norm_squared(&offset);
    (offset, t)
}

impl<T: Compact, C: Container<T, D>, I: Index, const D: usize> BorrowedFluid<'_, T, C, D, I> {
    pub(super) fn predict(&mut self, acceleration: [T; D]) {
        let acceleration = acceleration.map(|a| near_held(a, STEEPEST));
        let fastest = ratio(FASTEST);
        for (i, p) in self.particles.iter_mut().enumerate() {
            let to = core::array::from_fn(|axis| {
                let velocity = T::Near::load(p.velocity[axis]) + acceleration[axis];
                p.position[axis] + T::from_near(velocity.held(fastest))
            });
            let to = self.container.confine(&p.position, to, gap(i));
            p.velocity = core::array::from_fn(|axis| to[axis].offset(p.position[axis]).store());
            p.position = to;
            p.reach = self.order.cell_of(to.map(T::floor_to_i32)) as i32;
        }
    }

    pub(super) fn sort(&mut self) {
        self.order.sort(self.particles, |p| p.reach as usize);
    }

    /// Density, XSPH viscosity, and which pairs are in reach.
    pub(super) fn search(&mut self) {
        let (container, settings) = (self.container, self.settings);
        let viscosity = T::Near::ratio(1, 256).times(settings.viscosity.min(128).into());
        self.order.sweep(
            self.particles,
            |p| Search { weight: T::Near::load_weight(p.load), drag: p.push.map(T::Near::load) },
            |this, sums, other| {
                let (_, t) = closeness(this, other);
                if t > T::Near::ZERO {
                    let w = Poly6::of_complement(t);
                    sums.weight += w;
                    other.load = (T::Near::load_weight(other.load) + w).store_weight();
                    let difference: [_; D] = core::array::from_fn(|axis| {
                        T::Near::load(other.velocity[axis]) - T::Near::load(this.velocity[axis])
                    });
                    let drag = scale(&difference, w * viscosity);
                    for axis in 0..D {
                        sums.drag[axis] += drag[axis];
                        other.push[axis] = (T::Near::load(other.push[axis]) - drag[axis]).store_low();
                    }
                }
                t > T::Near::ZERO
            },
            |p, sums, reach| {
                p.reach = reach;
                finish_density(container, settings.cohesion, p, sums.weight, sums.drag);
            },
        );
    }

    pub(super) fn density(&mut self) {
        let (container, settings) = (self.container, self.settings);
        self.order.revisit(
            self.particles,
            |p| (T::Near::load_weight(p.load), p.reach),
            |this, sum, other| {
                let (_, t) = closeness(this, other);
                if t > T::Near::ZERO {
                    let w = Poly6::of_complement(t);
                    *sum += w;
                    other.load = (T::Near::load_weight(other.load) + w).store_weight();
                }
            },
            |p, sum| finish_density(container, settings.cohesion, p, sum, [T::Near::ZERO; D]),
        );
    }

    pub(super) fn correct(&mut self) {
        let container = self.container;
        let limit = T::Near::ratio(1, 4);
        let core = T::Near::ratio(21, 25);
        let mut i = 0_usize;
        self.order.revisit(
            self.particles,
            |p| (p.push.map(T::Near::load), p.reach),
            |this, sum, other| {
                let (mut offset, t) = closeness(this, other);
                if t > T::Near::ZERO {
                    let pressure = T::Near::load(this.pressure) + T::Near::load(other.pressure);
                    let mut strength = pressure * Poly6::of_complement(t);
                    if t > core {
                        strength += t - core;
                        if t == T::Near::ONE {
                            offset = [T::Near::ratio(1, 8); D];
                        }
                    }
                    let push = scale(&offset, strength);
                    for axis in 0..D {
                        sum[axis] += push[axis];
                        other.push[axis] = (T::Near::load(other.push[axis]) - push[axis]).store_low();
                    }
                }
            },
            |p, sum| {
                let to = core::array::from_fn(|axis| p.position[axis] + T::from_near(sum[axis].held(limit)));
                let to = container.confine(&p.position, to, gap(i));
                i = i.wrapping_add(1);
                for axis in 0..D {
                    let moved = to[axis].offset(p.position[axis]);
                    p.velocity[axis] = (T::Near::load(p.velocity[axis]) + moved).store();
                }
                p.position = to;
                p.push = [T::Near::STORED_ZERO; D];
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
    push: [T::Near; D],
) {
    let wall = container.wall(&p.position);
    let (rest, gain) = if D == 2 { ((100, 305), (1, 1)) } else { ((100, 496), (17, 20)) };
    let excess = (T::Near::ONE + weight) * ratio(rest) + wall.share - T::Near::ONE;
    let raw = excess * ratio(gain) + T::Near::load(p.pressure) * ratio((3, 10));
    let kept = T::Near::ratio(1, 256).times(cohesion.min(64).into());
    let pressure = if raw > T::Near::ZERO { raw } else { raw * kept };
    let pressure = pressure.held(ratio((1, 2)));
    p.pressure = pressure.store_low();
    p.load = T::Near::STORED_ZERO;
    let on_wall = pressure * ratio((8, 5));
    p.push = core::array::from_fn(|axis| (push[axis] + wall.push[axis].evenly(on_wall)).store_low());
}

/// How far from a wall the i-th particle is put back: 1/128 to 1/8, so that what a blow presses to a wall does not stay
/// in one line with zero thickness.
#[inline(always)]
fn gap<T: Compact>(i: usize) -> T {
    T::ratio(1, 128).times((1 + (i.wrapping_mul(7) & 15)) as i32)
}
