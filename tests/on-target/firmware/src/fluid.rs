//! A dam break of a position-based fluid, counted pass by pass, and what it takes to draw it.

use crate::clock;
use core::hint::black_box;
use sph_core::Scalar;
use sph_core::fluid::pbf::Pass;
use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid, Raster};
use sph_core::scalar::compact::Compact;

/// At most `CAP` particles in a box of 16 × 11 cells.
pub type Fluid<T, const CAP: usize> = PositionBasedFluid<T, OpenBox<T, 2>, 2, CAP, 176>;

const COUNTED_FRAMES: u32 = 300;
const MORE_FRAMES: u32 = 300;

const PASSES: [(Pass, &str); 5] = [
    (Pass::Predict, "predict"),
    (Pass::Sort, "sort"),
    (Pass::Search, "search"),
    (Pass::Density, "density"),
    (Pass::Correct, "correct (two)"),
];

/// Fills the box with a column of fluid, lets it fall for 600 frames and logs what that took; false when a particle was refused or lost.
pub fn run<T: Compact, const CAP: usize>(fluid: &mut Fluid<T, CAP>, columns: usize) -> bool {
    for k in 0..CAP {
        let position = [k % columns, k / columns].map(|n| T::ratio(2 * n as i32 + 1, 4));
        if fluid.add(Particle::new(position, [T::ZERO; 2])).is_err() {
            return false;
        }
    }
    #[cfg(target_arch = "arm")]
    crate::stack::paint();
    clock::start();
    let gravity = [T::ZERO, T::ratio(-5, 1000)];
    let mut taken = [0_u64; PASSES.len()];
    for _ in 0..COUNTED_FRAMES {
        count(fluid, gravity, &mut taken);
    }
    for _ in 0..MORE_FRAMES {
        frame(fluid, gravity);
    }
    report::<T, CAP>(taken);
    draw::<T, 16, 8>(fluid.particles(), T::ratio(97, 100), "raster 16 x 8");
    draw::<T, 62, 30>(fluid.particles(), T::ratio(1, 4), "raster 62 x 30");
    fluid.len() == CAP
}

/// How many particles are drawn.
const DRAWN: usize = 200;

/// Counts the instructions of a raster and logs them a particle, as those of a frame are.
#[inline(never)]
fn draw<T: Compact, const W: usize, const H: usize>(particles: &[Particle<T, 2>], pixel: T, name: &str) {
    let mut raster = Raster::<W, H>::new();
    let drawn = particles.get(..DRAWN).unwrap_or_default();
    let before = clock::now();
    raster.update(black_box(drawn), black_box(pixel));
    let each = clock::between(before, clock::now()) / DRAWN as u32;
    black_box(&raster);
    defmt::println!("{=str},{=usize},{=str},{=u32}", <T as Scalar>::NAME, drawn.len(), name, each);
}

/// A frame as a user's program has it.
#[inline(never)]
fn frame<T: Compact, const CAP: usize>(fluid: &mut Fluid<T, CAP>, gravity: [T; 2]) {
    fluid.step(black_box(gravity));
}

#[inline(never)]
fn count<T: Compact, const CAP: usize>(
    fluid: &mut Fluid<T, CAP>,
    gravity: [T; 2],
    taken: &mut [u64; PASSES.len()],
) {
    let mut before = clock::now();
    if let Ok(mut fluid) = fluid.borrowed() {
        fluid.step_observed(black_box(gravity), |pass| {
            let now = clock::now();
            for (sum, (of, _)) in taken.iter_mut().zip(PASSES) {
                if of == pass {
                    *sum += u64::from(clock::between(before, now));
                }
            }
            before = clock::now();
        });
    }
}

fn report<T: Compact, const CAP: usize>(taken: [u64; PASSES.len()]) {
    let row = |quantity: &str, value: u32| {
        defmt::println!("{=str},{=usize},{=str},{=u32}", <T as Scalar>::NAME, CAP, quantity, value);
    };
    let each = |sum: u64| (sum / u64::from(COUNTED_FRAMES) / CAP as u64) as u32;
    for ((_, name), sum) in PASSES.into_iter().zip(taken) {
        row(name, each(sum));
    }
    row("frame", each(taken.iter().sum()));
    row("RAM", Fluid::<T, CAP>::SIZE as u32);
    #[cfg(target_arch = "arm")]
    row("stack", crate::stack::depth() as u32);
}
