//! A fluid that is turned and shaken for 600 frames, then digested: positions, velocities and pressures.

use crate::{Fnv, Item};
use sph_core::Error;
use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid};
use sph_core::scalar::compact::Compact;

const FRAMES: i32 = 600;
const COLUMNS: i32 = 6;
const PARTICLES: usize = 48;

/// Gravity in h/1000 a frame², which turns every 75 frames.
const TURNS: [[i32; 2]; 4] = [[0, -6], [4, -4], [6, 0], [4, 4]];

/// The digests of one scalar.
///
/// # Errors
/// The fluid is in the range of every scalar that this is meant for; an error says that one is not.
pub(crate) fn digest<T: Compact>(emit: &mut impl FnMut(Item)) -> Result<(), Error> {
    let walls = OpenBox::new([T::ratio(11, 2); 2]);
    let mut fluid = PositionBasedFluid::<T, _, 2, PARTICLES, 36, u8>::new(walls);
    for k in 0..PARTICLES as i32 {
        let position = [k % COLUMNS, k / COLUMNS].map(|n| T::ratio(2 * n + 1, 4));
        fluid.add(Particle::new(position, [T::ZERO; 2])).map_err(|rejected| rejected.reason)?;
    }
    for frame in 0..FRAMES {
        let [x, y] = TURNS[frame as usize / 75 % TURNS.len()];
        let shake = (frame * 7 % 5 - 2) * 3;
        fluid.step([T::ratio(x + shake, 1000), T::ratio(y, 1000)]);
    }
    let mut digests = [Fnv::new(); 3];
    for particle in fluid.particles() {
        particle.position().into_iter().for_each(|x| digests[0].add(x.canonical_bits()));
        particle.velocity().into_iter().for_each(|v| digests[1].add(v.canonical_bits()));
        digests[2].add(particle.pressure().canonical_bits());
    }
    for (quantity, digest) in ["positions", "velocities", "pressures"].into_iter().zip(digests) {
        emit(Item { scalar: T::NAME, dim: 2, by: "position-based", quantity, digest: digest.get() });
    }
    Ok(())
}
