//! The sums as jobs: each is compiled once for each instruction set.

use sph_core::Lane;
use sph_core::fluid::incompressible::{Shape, ShapeSums, Surroundings, Wall, WallSums};

use super::contacts::Contacts;
use super::summation::{Carried, Host};
use crate::engine::neighbourhoods::{Neighbourhoods, Span};
use crate::fast::{Isa, Job, Real};

/// V σ h^{-D} and V σ h^{-D−2}.
#[derive(Clone, Copy)]
pub(super) struct Scales<T> {
    pub(super) influence: T,
    pub(super) gradient: T,
}

/// s x
#[inline(always)]
fn scaled<I: Isa<T>, T: Real, const D: usize>(x: &[I::Reg; D], s: I::Reg) -> [I::Reg; D] {
    let mut scaled = *x;
    for axis in 0..D {
        scaled[axis] = scaled[axis] * s;
    }
    scaled
}

/// Takes the neighbours of some walls down, and works out what walls know.
pub(super) struct SumWalls<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) scales: Scales<T>,
    pub(super) near: &'a Neighbourhoods<T, D>,
    pub(super) contacts: &'a mut Contacts<T, D>,
    pub(super) out: &'a mut [Wall<T>],
}

impl<T: Real, const D: usize> Job<T> for SumWalls<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { scheme, scales, near, contacts, out } = self;
        contacts.add(isa, near, scales.influence, scales.gradient);
        let [influence_scale, gradient_scale] = [scales.influence, scales.gradient].map(I::Reg::splat);
        for (out, spans) in out.iter_mut().zip(&near.spans) {
            let profiles = near.blocks(spans[0], &near.profiles);
            let slopes = near.blocks(spans[0], &near.slopes);
            let mut parts = I::parts(WallSums::<T, I::Reg>::EMPTY);
            for part in 0..I::PARTS {
                let mut sums = WallSums::<T, I::Reg>::EMPTY;
                for block in 0..spans[0].blocks_of_part::<T, I>(part) {
                    let (_, _, profile) = profiles.part::<I>(block, part);
                    let (_, offset, slope) = slopes.part::<I>(block, part);
                    let gradient = scaled::<I, T, D>(&offset, slope * gradient_scale);
                    let at = Surroundings { offset, influence: profile * influence_scale, gradient };
                    scheme.add_to_wall(&mut sums, &at);
                }
                parts.as_mut()[part] = sums;
            }
            let sums = I::join_parts(
                parts,
                #[inline(always)]
                |sums, other| sums.join(other),
            );
            *out = scheme.total_wall(sums);
        }
    }
}

/// Takes the neighbours of some fluid particles down, and works out their shapes.
pub(super) struct SumShapes<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) scales: Scales<T>,
    /// Velocities of the fluid, stiffnesses and heads of walls.
    pub(super) carried: &'a Carried<T>,
    pub(super) near: &'a Neighbourhoods<T, D>,
    pub(super) contacts: &'a mut Contacts<T, D>,
    pub(super) velocities: &'a [[T; D]],
    pub(super) out: &'a mut [Shape<T, D>],
}

impl<T: Real, const D: usize> SumShapes<'_, T, D> {
    #[inline(always)]
    fn add<I: Isa<T>, const FLUID: bool>(
        &self,
        isa: I,
        own: &[I::Reg; D],
        span: Span,
        part: usize,
        sums: &mut ShapeSums<T, I::Reg, D>,
    ) {
        let near = self.near;
        let (profiles, slopes) = (near.blocks(span, &near.profiles), near.blocks(span, &near.slopes));
        let [influence_scale, gradient_scale] =
            [self.scales.influence, self.scales.gradient].map(I::Reg::splat);
        // a copy, which nothing else can write to: its numbers are loaded before the loop
        let scheme = *self.scheme;
        for block in 0..span.blocks_of_part::<T, I>(part) {
            let (_, _, profile) = profiles.part::<I>(block, part);
            let (places, offset, slope) = slopes.part::<I>(block, part);
            let gradient = scaled::<I, T, D>(&offset, slope * gradient_scale);
            let at = Surroundings { offset, influence: profile * influence_scale, gradient };
            let (velocity, number) = self.carried.at::<I, D>(isa, places);
            if FLUID {
                scheme.add_fluid(sums, own, &velocity, &at);
            } else {
                scheme.add_wall(sums, [number, velocity[0]], &at);
            }
        }
    }
}

impl<T: Real, const D: usize> Job<T> for SumShapes<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        for (k, spans) in self.near.spans.iter().enumerate() {
            let own = I::splat_vector(&self.velocities[k]);
            let mut parts = I::parts(ShapeSums::<T, I::Reg, D>::EMPTY);
            for part in 0..I::PARTS {
                // on their own while they grow, so that they stay in registers
                let mut sums = ShapeSums::<T, I::Reg, D>::EMPTY;
                self.add::<I, true>(isa, &own, spans[0], part, &mut sums);
                self.add::<I, false>(isa, &own, spans[1], part, &mut sums);
                parts.as_mut()[part] = sums;
            }
            let sums = I::join_parts(
                parts,
                #[inline(always)]
                |sums, other| sums.join(other),
            );
            self.out[k] = self.scheme.total_shape(sums);
        }
        self.contacts.add(isa, self.near, self.scales.influence, self.scales.gradient);
    }
}

/// Of some walls q_w, or what flows into them: with a sign and the wall's weight, what the fluid sees.
pub(super) struct SumOfWalls<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) carried: &'a Carried<T>,
    pub(super) contacts: &'a Contacts<T, D>,
    pub(super) walls: &'a [Wall<T>],
    /// Whether it is q_w.
    pub(super) of_values: bool,
    pub(super) out: &'a mut [T],
}

impl<T: Real, const D: usize> Job<T> for SumOfWalls<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { scheme, carried, contacts, walls, of_values, out } = self;
        for ((out, wall), spans) in out.iter_mut().zip(walls).zip(&contacts.spans) {
            let blocks = contacts.blocks(spans[0]);
            let mut parts = I::parts(I::Reg::EMPTY);
            for part in 0..I::PARTS {
                let mut sum = I::Reg::EMPTY;
                for block in 0..spans[0].blocks_of_part::<T, I>(part) {
                    let (velocity, value) = carried.at::<I, D>(isa, blocks.places::<I>(block, part));
                    if of_values {
                        (blocks.influence::<I>(block, part) * value).add_to(&mut sum);
                    } else {
                        let gradient = blocks.gradient::<I>(block, part);
                        scheme.add_flow::<I::Reg>(&mut sum, &velocity, &gradient);
                    }
                }
                parts.as_mut()[part] = sum;
            }
            let sum = I::total_of_parts(parts);
            *out = if of_values { sum * wall.weight } else { -(sum * wall.weight) };
        }
    }
}

/// P of some fluid particles.
pub(super) struct SumPushes<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) carried: &'a Carried<T>,
    pub(super) contacts: &'a Contacts<T, D>,
    pub(super) shapes: &'a [Shape<T, D>],
    pub(super) values: &'a [T],
    pub(super) out: &'a mut [[T; D]],
}

impl<T: Real, const D: usize> Job<T> for SumPushes<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { scheme, carried, contacts, shapes, values, out } = self;
        for (k, spans) in contacts.spans.iter().enumerate() {
            let mut parts = I::parts([I::Reg::EMPTY; D]);
            for part in 0..I::PARTS {
                let mut sums = [I::Reg::EMPTY; D];
                for &span in spans {
                    let blocks = contacts.blocks(span);
                    for block in 0..span.blocks_of_part::<T, I>(part) {
                        let gradient = blocks.gradient::<I>(block, part);
                        let (_, value) = carried.at::<I, D>(isa, blocks.places::<I>(block, part));
                        scheme.add_push::<I::Reg>(&mut sums, value, &gradient);
                    }
                }
                parts.as_mut()[part] = sums;
            }
            let sums = I::join_parts(
                parts,
                #[inline(always)]
                |sums, other| {
                    for axis in 0..D {
                        sums[axis] += other[axis];
                    }
                },
            );
            out[k] = scheme.total_push::<I::Reg>(values[k], &shapes[k], &sums);
        }
    }
}

/// C of some fluid particles.
pub(super) struct SumRates<'a, T, const D: usize> {
    pub(super) scheme: &'a Host<T, D>,
    pub(super) carried: &'a Carried<T>,
    pub(super) contacts: &'a Contacts<T, D>,
    pub(super) shapes: &'a [Shape<T, D>],
    pub(super) velocities: &'a [[T; D]],
    pub(super) out: &'a mut [T],
}

impl<T: Real, const D: usize> Job<T> for SumRates<'_, T, D> {
    type Output = ();

    #[inline(always)]
    fn run<I: Isa<T>>(self, isa: I) {
        let Self { scheme, carried, contacts, shapes, velocities, out } = self;
        for (k, spans) in contacts.spans.iter().enumerate() {
            let mut parts = I::parts([I::Reg::EMPTY; 2]);
            for part in 0..I::PARTS {
                let [mut flow, mut from_walls] = [I::Reg::EMPTY; 2];
                let blocks = contacts.blocks(spans[0]);
                for block in 0..spans[0].blocks_of_part::<T, I>(part) {
                    let gradient = blocks.gradient::<I>(block, part);
                    let (velocity, _) = carried.at::<I, D>(isa, blocks.places::<I>(block, part));
                    scheme.add_flow::<I::Reg>(&mut flow, &velocity, &gradient);
                }
                let blocks = contacts.blocks(spans[1]);
                for block in 0..spans[1].blocks_of_part::<T, I>(part) {
                    let (_, value) = carried.at::<I, D>(isa, blocks.places::<I>(block, part));
                    (blocks.influence::<I>(block, part) * value).add_to(&mut from_walls);
                }
                parts.as_mut()[part] = [flow, from_walls];
            }
            let [flow, from_walls] = I::join_parts(
                parts,
                #[inline(always)]
                |sums, other| {
                    sums[0] += other[0];
                    sums[1] += other[1];
                },
            );
            out[k] = scheme.total_rate::<I::Reg>(&velocities[k], &shapes[k], flow, from_walls);
        }
    }
}
