//! What `tests/on-target/c/flash.c` does in C: a fluid made when the program runs, in memory of zeros, of numbers that the compiler does not
//! know; a particle and a frame.

use core::hint::black_box;
use core::mem::MaybeUninit;
use sph_core::fluid::{BorrowedFluid, Container, OpenBox, Particle, Settings};
use sph_core::scalar::compact::Compact;

const CAPACITY: usize = 64;

/// The room for a fluid, as the C library lays it out: places that are not particles before one is added.
pub struct Pendant<T: Compact> {
    particles: [MaybeUninit<Particle<T, 2>>; CAPACITY],
    starts: [u16; CAPACITY],
    len: usize,
}

impl<T: Compact> Pendant<T> {
    /// Room of zeros.
    #[expect(clippy::new_without_default, reason = "for a static alone")]
    pub const fn new() -> Self {
        Self { particles: [const { MaybeUninit::zeroed() }; CAPACITY], starts: [0; CAPACITY], len: 0 }
    }

    /// The particle at `place` and the frame; whether there were any.
    pub fn run(&mut self, side: T, place: T, velocity: T, acceleration: [T; 2]) -> bool {
        let container = OpenBox::new(black_box([side; 2]));
        let settings = black_box(Settings::DEFAULT);
        let particle = Particle::new(black_box([place; 2]), black_box([velocity; 2]));
        if !container.contains(&particle.position()) {
            return false;
        }
        let Some(room) = self.particles.get_mut(self.len) else { return false };
        room.write(particle);
        self.len += 1;
        // SAFETY: the first `len` were written, here.
        let particles =
            unsafe { core::slice::from_raw_parts_mut(self.particles.as_mut_ptr().cast(), self.len) };
        let Ok(mut fluid) = BorrowedFluid::trusted(&container, settings, particles, &mut self.starts) else {
            return false;
        };
        fluid.step(black_box(acceleration));
        true
    }
}
