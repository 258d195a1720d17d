//! A fluid that is turned and shaken for 600 frames, then digested: positions, velocities and pressures.

use crate::{Fnv, Item};
use sph_core::Error;
use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid, Settings};
use sph_core::scalar::compact::Compact;

const FRAMES: i32 = 600;
const PARTICLES: usize = 48;

/// Gravity in h/1000 a frame², which turns every 75 frames.
const TURNS: [[i32; 3]; 4] = [[0, -6, 0], [4, -4, -4], [6, 0, 2], [4, 4, -3]];

/// The digests of one scalar in D dimensions: `CELLS` is 6 to the power of D.
///
/// # Errors
/// The fluid is in the range of every scalar that this is meant for; an error says that one is not.
pub(crate) fn digest<T: Compact, const D: usize, const CELLS: usize>(
    emit: &mut impl FnMut(Item),
) -> Result<(), Error> {
    let walls = OpenBox::new([T::ratio(11, 2); D]);
    let (settings, columns) = if D == 2 { (Settings::DEFAULT, 6) } else { (Settings::IN_3D, 4) };
    let mut fluid = PositionBasedFluid::<T, _, D, PARTICLES, CELLS, u8>::with_settings(walls, settings);
    for k in 0..PARTICLES as i32 {
        let place = |axis: usize| k / i32::pow(columns, axis as u32);
        let position: [T; D] = core::array::from_fn(|axis| {
            let column = if axis == D - 1 { place(axis) } else { place(axis) % columns };
            T::ratio(2 * column + 1, 4)
        });
        fluid.add(Particle::new(position, [T::ZERO; D])).map_err(|rejected| rejected.reason)?;
    }
    for frame in 0..FRAMES {
        let mut gravity = TURNS[frame as usize / 75 % TURNS.len()];
        gravity[0] += (frame * 7 % 5 - 2) * 3;
        fluid.step(core::array::from_fn(|axis| T::ratio(gravity[axis], 1000)));
    }
    let mut digests = [Fnv::new(); 3];
    for particle in fluid.particles() {
        particle.position().into_iter().for_each(|x| digests[0].add(x.canonical_bits()));
        particle.velocity().into_iter().for_each(|v| digests[1].add(v.canonical_bits()));
        digests[2].add(particle.pressure().canonical_bits());
    }
    for (quantity, digest) in ["positions", "velocities", "pressures"].into_iter().zip(digests) {
        emit(Item { scalar: T::NAME, dim: D, by: "position-based", quantity, digest: digest.get() });
    }
    Ok(())
}
