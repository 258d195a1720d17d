//! Particles as sums read them: all that is known of one side by side, its place apart from it.

use std::hint::black_box;

use sph_core::fluid::wcsph::Seen;

use crate::fast::{BLOCK, Isa, Lanes, Real};

/// Sixteen numbers of as many particles.
pub(super) type Wide<T> = Lanes<T>;

/// Four numbers: a vector of up to three components, and a number.
type Four<T> = [T; 4];

/// All particles. A record is x p, v ρ, ∇ρ V, δv p/ρ²; the first of these four, which a search looks at, is kept for itself.
#[derive(Clone, Debug, Default)]
pub(super) struct ParticleRecords<T> {
    pub(super) places: Vec<Four<T>>,
    pub(super) states: Vec<[Four<T>; 3]>,
}

#[inline(always)]
fn four<T: Real, const D: usize>(vector: &[T; D], number: T) -> Four<T> {
    const { assert!(D <= 3, "a vector has room for three components") };
    let mut four = [T::ZERO, T::ZERO, T::ZERO, number];
    four[..D].copy_from_slice(vector);
    four
}

/// The record of a particle.
#[inline(always)]
pub(super) fn record<T: Real, const D: usize>(x: &[T; D], seen: &Seen<T, D>) -> (Four<T>, [Four<T>; 3]) {
    let state = [
        four(&seen.velocity, seen.density),
        four(&seen.density_gradient, seen.volume),
        four(&seen.shift_velocity, seen.pressure_term),
    ];
    (four(x, seen.pressure), state)
}

impl<T: Real> ParticleRecords<T> {
    /// Resizes to `count` records; new ones are padding: beyond every support, so never a neighbour.
    pub(super) fn resize<const D: usize>(&mut self, count: usize) {
        let (place, state) = record(&[T::from_f64(1e9); D], &Seen::NONE);
        self.places.resize(count, place);
        self.states.resize(count, state);
    }

    /// Records a particle.
    pub(super) fn set<const D: usize>(&mut self, k: usize, x: &[T; D], seen: &Seen<T, D>) {
        (self.places[k], self.states[k]) = record(x, seen);
    }

    /// Records particle `of` again, elsewhere.
    pub(super) fn set_image<const D: usize>(&mut self, k: usize, of: usize, shift: &[T; D]) {
        self.states[k] = self.states[of];
        self.places[k] = self.places[of];
        self.places[k].iter_mut().zip(shift).for_each(|(x, &shift)| *x += shift);
    }

    /// The position of particle k, sixteen times.
    #[inline(always)]
    pub(super) fn position<const D: usize>(&self, k: usize) -> [Wide<T>; D] {
        vector(&sixteen_times(self.places[k]))
    }

    /// Particle k as it is seen, sixteen times.
    #[inline(always)]
    pub(super) fn seen<const D: usize>(&self, k: usize) -> Seen<Wide<T>, D> {
        let [v, gradient, drift] = self.states[k];
        seen([self.places[k], v, gradient, drift].map(
            #[inline(always)]
            |four| sixteen_times(four),
        ))
    }

    /// The positions of sixteen particles.
    #[inline(always)]
    pub(super) fn positions<I: Isa<T>, const D: usize>(&self, isa: I, block: &[u32; BLOCK]) -> [Wide<T>; D] {
        vector(&black_box(isa.turn(&at(&self.places, block))))
    }

    /// Sixteen particles as they are seen, of which these fours will be looked at: x p, v ρ, ∇ρ V, δv p/ρ².
    ///
    /// What is read is hidden from the compiler: it would take the vectors apart to put others together.
    #[inline(always)]
    pub(super) fn seen_at<I: Isa<T>, const D: usize>(
        &self,
        isa: I,
        block: &[u32; BLOCK],
        wanted: [bool; 4],
    ) -> Seen<Wide<T>, D> {
        let unread = [[T::ZERO; BLOCK]; 4];
        let mut fours = [unread; 4];
        if wanted[0] {
            fours[0] = black_box(isa.turn(&at(&self.places, block)));
        }
        let states = at(&self.states, block);
        for number in 0..3 {
            if wanted[1 + number] {
                let mut of_states = [&states[0][number]; BLOCK];
                for k in 1..BLOCK {
                    of_states[k] = &states[k][number];
                }
                fours[1 + number] = black_box(isa.turn(&of_states));
            }
        }
        seen(fours)
    }
}

/// The sixteen of these that a block names.
#[inline(always)]
fn at<'a, U>(all: &'a [U], block: &[u32; BLOCK]) -> [&'a U; BLOCK] {
    let mut found = [&all[block[0] as usize]; BLOCK];
    for k in 1..BLOCK {
        found[k] = &all[block[k] as usize];
    }
    found
}

/// Hidden from the compiler as well, for the same reason.
#[inline(always)]
fn sixteen_times<T: Real>([a, b, c, d]: Four<T>) -> [[T; BLOCK]; 4] {
    black_box([[a; BLOCK], [b; BLOCK], [c; BLOCK], [d; BLOCK]])
}

#[inline(always)]
fn seen<T: Real, const D: usize>([x, v, gradient, drift]: [[[T; BLOCK]; 4]; 4]) -> Seen<Wide<T>, D> {
    Seen {
        velocity: vector(&v),
        density: Lanes(v[3]),
        pressure: Lanes(x[3]),
        volume: Lanes(gradient[3]),
        pressure_term: Lanes(drift[3]),
        density_gradient: vector(&gradient),
        shift_velocity: vector(&drift),
    }
}

#[inline(always)]
fn vector<T: Real, const D: usize>(four: &[[T; BLOCK]; 4]) -> [Wide<T>; D] {
    let mut vector = [Lanes(four[0]); D];
    for axis in 1..D {
        vector[axis] = Lanes(four[axis]);
    }
    vector
}
