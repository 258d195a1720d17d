//! Particles as sums read them: all that is known of one side by side, its place apart from it.

use sph_core::Arithmetic;
use sph_core::fluid::wcsph::Seen;

use crate::fast::{BLOCK, Isa, Real, Register};

/// Four numbers: a vector of up to three components, and a number.
type Four<T> = [T; 4];

/// All particles. A record is x p, v ρ, ∇ρ V, δv p/ρ²; the first of these four, which a search looks at, is kept for itself.
#[derive(Clone, Debug, Default)]
pub(super) struct ParticleRecords<T> {
    pub(super) places: Vec<Four<T>>,
    pub(super) states: Vec<[Four<T>; 3]>,
}

#[inline(always)]
#[expect(clippy::manual_memcpy, reason = "a call would copy three numbers")]
fn four<T: Real, const D: usize>(vector: &[T; D], number: T) -> Four<T> {
    const { assert!(D <= 3, "a vector has room for three components") };
    let mut four = [T::ZERO, T::ZERO, T::ZERO, number];
    for axis in 0..D {
        four[axis] = vector[axis];
    }
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

    /// The position of particle k in every column.
    #[inline(always)]
    pub(super) fn position<R: Register<T>, const D: usize>(&self, k: usize) -> [R; D] {
        vector(&splat(self.places[k]))
    }

    /// Particle k as it is seen, in every column.
    #[inline(always)]
    pub(super) fn seen<R: Register<T>, const D: usize>(&self, k: usize) -> Seen<R, D> {
        let [v, gradient, shift] = self.states[k];
        seen([splat(self.places[k]), splat(v), splat(gradient), splat(shift)])
    }

    /// The positions of a register of particles.
    #[inline(always)]
    pub(super) fn positions<I: Isa<T>, const D: usize>(&self, isa: I, records: &[u32]) -> [I::Reg; D] {
        let records = &records[..I::Reg::WIDTH];
        vector(&isa.transpose(
            #[inline(always)]
            |k| &self.places[records[k] as usize],
        ))
    }

    /// A register of particles as they are seen, of which these fours will be read: x p, v ρ, ∇ρ V, δv p/ρ². The others are zero.
    #[inline(always)]
    pub(super) fn seen_at<I: Isa<T>, const D: usize>(
        &self,
        isa: I,
        records: &[u32],
        wanted: [bool; 4],
    ) -> Seen<I::Reg, D> {
        let records = &records[..I::Reg::WIDTH];
        // looked up once for all fours
        let none = [[T::ZERO; 4]; 3];
        let mut states = [&none; BLOCK];
        for k in 0..I::Reg::WIDTH {
            states[k] = &self.states[records[k] as usize];
        }
        let mut fours = [[I::Reg::ZERO; 4]; 4];
        if wanted[0] {
            fours[0] = isa.transpose(
                #[inline(always)]
                |k| &self.places[records[k] as usize],
            );
        }
        for number in 0..3 {
            if wanted[1 + number] {
                fours[1 + number] = isa.transpose(
                    #[inline(always)]
                    |k| &states[k][number],
                );
            }
        }
        seen(fours)
    }
}

#[inline(always)]
fn splat<T: Real, R: Register<T>>([a, b, c, d]: Four<T>) -> [R; 4] {
    [R::splat(a), R::splat(b), R::splat(c), R::splat(d)]
}

#[inline(always)]
fn seen<R: Copy, const D: usize>([x, v, gradient, shift]: [[R; 4]; 4]) -> Seen<R, D> {
    Seen {
        velocity: vector(&v),
        density: v[3],
        pressure: x[3],
        volume: gradient[3],
        pressure_term: shift[3],
        density_gradient: vector(&gradient),
        shift_velocity: vector(&shift),
    }
}

#[inline(always)]
#[expect(clippy::manual_memcpy, reason = "a loop keeps registers in registers")]
fn vector<R: Copy, const D: usize>(four: &[R; 4]) -> [R; D] {
    let mut vector = [four[0]; D];
    for axis in 1..D {
        vector[axis] = four[axis];
    }
    vector
}
