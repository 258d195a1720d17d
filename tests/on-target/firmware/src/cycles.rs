//! Marks what the plugin of `tests/on-target/cycles` is to count, and a pendant that is counted.

use core::arch::asm;
use core::hint::black_box;
use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid, Raster};
use sph_core::scalar::compact::Compact;

/// Does the work in a region, between the two instructions that the plugin looks for; neither does anything.
#[inline(always)]
pub fn region(work: impl FnOnce()) {
    // SAFETY: a register is moved to itself.
    unsafe { asm!("mov r9, r9", options(nostack, preserves_flags)) };
    work();
    // SAFETY: as above.
    unsafe { asm!("mov r10, r10", options(nostack, preserves_flags)) };
}

/// A square pendant of `SIDE` × `SIDE` cells that `CAP` particles fill half, counted frame by frame, then drawn once on 16 × 16 pixels.
///
/// Gravity points down for half of the `frames` and then to the side, as when a pendant is turned. Before each group of regions it logs
/// the scalar, the particles, what is done and how many regions follow. False when a particle was refused or lost.
#[inline(never)]
pub fn pendant<T: Compact, const CAP: usize, const SIDE: usize, const CELLS: usize>(
    scalar: &str,
    frames: u32,
) -> bool {
    let side = T::ratio(10 * SIDE as i32 - 1, 10);
    let mut fluid = PositionBasedFluid::<T, OpenBox<T, 2>, 2, CAP, CELLS>::new(OpenBox::new([side; 2]));
    for k in 0..CAP {
        let position = [k % (2 * SIDE), k / (2 * SIDE)].map(|n| T::ratio(2 * n as i32 + 1, 4));
        if fluid.add(Particle::new(position, [T::ZERO; 2])).is_err() {
            return false;
        }
    }
    defmt::println!("{=str},{=usize},frame,{=u32}", scalar, CAP, frames);
    let g = T::ratio(-5, 1000);
    for frame in 0..frames {
        let gravity = if frame < frames / 2 { [T::ZERO, g] } else { [g, T::ZERO] };
        region(|| fluid.step(black_box(gravity)));
    }
    defmt::println!("{=str},{=usize},raster 16 x 16,1", scalar, CAP);
    let mut raster = Raster::<16, 16>::new();
    let pixel = T::ratio(SIDE as i32, 16);
    region(|| raster.update(black_box(fluid.particles()), black_box(pixel)));
    black_box(&raster);
    fluid.len() == CAP
}

/// Pendants of 50, 100 and 200 particles, for so many frames.
pub fn pendants<T: Compact>(scalar: &str, frames: u32) -> bool {
    pendant::<T, 50, 5, 25>(scalar, frames)
        && pendant::<T, 100, 7, 49>(scalar, frames)
        && pendant::<T, 200, 10, 100>(scalar, frames)
}
