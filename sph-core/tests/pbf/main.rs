//! The physics of the position-based fluid: it collapses and rests, keeps its volume and its momentum, and survives anything.

mod measure;

use measure::{Noise, at, block, dam_break, drift, extremes, state};
use sph_core::fluid::{Container, Disc, Mask, OpenBox, Particle, PositionBasedFluid, Settings, Shape, Wall};
use sph_core::scalar::compact::Compact;

/// The dam break is at rest, 6 deep, level, without pairs.
fn comes_to_rest<T: Compact>() {
    let rest = dam_break::<T>(2500);
    assert!(rest.front > 14.0, "{rest:?}");
    assert!(rest.density_error < 0.03, "{rest:?}");
    assert!(rest.first_percentile_of_spacing > 0.6, "{rest:?}");
    assert!((rest.height - 1.0).abs() < 0.03, "{rest:?}");
    assert!(rest.speed < 0.01, "{rest:?}");
    assert!(rest.fastest < 0.05, "{rest:?}");
    assert!(rest.slope.abs() < 0.2, "{rest:?}");
}

#[test]
fn a_dam_break_comes_to_rest_in_floats() {
    comes_to_rest::<f32>();
    comes_to_rest::<f64>();
}

#[test]
fn momentum_is_conserved_to_rounding_in_floats() {
    for change in drift::<f32>(1000, 7) {
        assert!(change.abs() < 1e-5, "{change}"); // positions near 30 are rounded to 2e-6
    }
    for change in drift::<f64>(1000, 7) {
        assert!(change.abs() < 3e-14, "{change}");
    }
}

/// Shakes with whatever `shake` gives and looks that all particles stay inside, then that the fluid calms down again.
fn survive<T: Compact, C: Container<T, 2>, const CELLS: usize>(container: C, frames: usize) {
    let mut fluid = PositionBasedFluid::<T, C, 2, 120, CELLS, u8>::new(container);
    for k in 0..2000 {
        let _ = fluid.add(at(0.3 + 0.53 * (k % 40) as f64, 0.3 + 0.53 * (k / 40) as f64));
    }
    let particles = fluid.len();
    assert!(particles > 60, "{particles}");
    let mut noise = Noise(99);
    for frame in 0..frames {
        fluid.step(extremes(&mut noise));
        for particle in fluid.particles() {
            let x = particle.position();
            assert!(fluid.container().contains(&x), "frame {frame}: {x:?}");
            assert!(particle.velocity().iter().all(|v| v.is_finite()), "frame {frame}: {particle:?}");
        }
    }
    for _ in 0..1500 {
        fluid.step([T::ZERO, T::ratio(-1, 250)]);
    }
    assert_eq!(fluid.len(), particles);
    let calm = state(fluid.particles());
    assert!(calm.rms_speed() < 0.01, "{}", calm.rms_speed());
    assert!(calm.spacings()[1] > 0.6, "pairs at {:?}", &calm.spacings()[..4]);
}

/// A hash (FNV-1a) of all positions after 600 frames of a box that is turned and shaken.
fn digest<T: Compact>() -> u64 {
    let mut fluid =
        PositionBasedFluid::<T, _, 2, 200, 121, u8>::new(OpenBox::new([10.0, 10.0].map(T::from_f64)));
    for particle in block([0.5, 0.5], 14, 14) {
        fluid.add(particle).unwrap();
    }
    for frame in 0..600 {
        let turn = frame / 75;
        fluid.step([T::ratio([0, 4, 6, 4][turn % 4], 1000), T::ratio([-6, -4, 0, 4][turn % 4], 1000)]);
    }
    let bits = fluid.particles().iter().flat_map(|p| p.position()).map(T::canonical_bits);
    bits.fold(0xcbf2_9ce4_8422_2325, |hash, bits| (hash ^ bits).wrapping_mul(0x100_0000_01b3))
}

/// The same in debug and release builds, and on every target.
#[test]
fn the_bits_are_the_same_everywhere() {
    assert_eq!(digest::<f32>(), 11_382_232_343_109_194_988);
}

/// Two chambers and a door.
const BADGE: [u8; 7] =
    [0b1111_1110, 0b1110_1110, 0b1110_1110, 0b1111_1110, 0b1110_1110, 0b1110_1110, 0b1011_1110];

#[test]
fn nothing_escapes_whatever_the_input() {
    survive::<f32, _, 49>(OpenBox::new([6.5, 6.5]), 3000);
    survive::<f32, _, 64>(Disc::new(3.5), 3000);
    survive::<f32, _, 100>(Mask::new(&BADGE, 7, 1.25).unwrap(), 3000);
    // a ring: a post in the middle of a disc, by a distance that is NaN in the very centre
    let ring = Shape::new([9.0_f32, 9.0], |x: &[f32; 2]| {
        let [dx, dy] = [x[0] - 4.5, x[1] - 4.5];
        let r = dx.hypot(dy);
        let outward = [dx / r, dy / r];
        if r > 2.75 { (4.5 - r, outward.map(|n| -n)) } else { (r - 1.0, outward) }
    });
    survive::<f32, _, 100>(ring, 3000);
}

#[test]
fn a_mask_of_straight_walls_is_the_box() {
    const BITS: [u8; 20] = [0xff; 20];
    let parts = |wall: Wall<f64, 2>| (wall.share, wall.push);
    let (mask, walls) = (Mask::new(&BITS, 16, 0.5).unwrap(), OpenBox::new([8.0, 5.0]));
    for x in [[0.2, 0.3], [4.0, 0.1], [7.7, 4.9], [4.0, 2.5], [0.9, 4.2], [0.5, 1.0]] {
        let (a, b): (Option<Wall<f64, 2>>, Option<Wall<f64, 2>>) = (mask.wall(&x), walls.wall(&x));
        let (a, b) = (a.map_or((0.0, [0.0; 2]), parts), b.map_or((0.0, [0.0; 2]), parts));
        assert!((a.0 - b.0).abs() < 1e-12, "{a:?} {b:?}");
        assert!((0..2).all(|axis| (a.1[axis] - b.1[axis]).abs() < 1e-12), "{a:?} {b:?}");
    }
    assert_eq!(mask.size(), [8.0, 5.0]);
}

/// How far a drop reaches that is given a velocity away from its centre.
fn spread(cohesion: u8) -> f32 {
    let settings = Settings { cohesion, ..Settings::DEFAULT };
    let walls = OpenBox::new([40.0_f32; 2]);
    let mut fluid = PositionBasedFluid::<f32, _, 2, 144, 1681>::with_settings(walls, settings);
    for particle in block([17.0, 17.0], 12, 12) {
        fluid.add(particle).unwrap();
    }
    fluid.impulse(|p| p.position().map(|x| 0.01 * (x - 20.0)));
    for _ in 0..400 {
        fluid.step([0.0; 2]);
    }
    let reach = |p: &Particle<f32, 2>| (p.position()[0] - 20.0).hypot(p.position()[1] - 20.0);
    fluid.particles().iter().map(reach).fold(0.0, f32::max)
}

#[test]
fn a_drop_with_cohesion_stays_together() {
    let (together, apart) = (spread(48), spread(0));
    assert!(together < 7.0 && apart > 10.0, "{together} {apart}");
}

#[test]
fn particles_come_and_go() {
    let mut fluid = PositionBasedFluid::<f64, _, 2, 4, 9>::new(OpenBox::new([2.0, 2.0]));
    for k in 0..4 {
        fluid.add(at(0.2 + 0.5 * f64::from(k), 1.0)).unwrap();
    }
    let refused = fluid.add(at(1.0, 0.25)).unwrap_err();
    assert_eq!(refused.particle.position(), [1.0, 0.25]);
    assert_eq!(refused.to_string(), "particle not taken: particles: capacity 4, needed 5");
    assert!(fluid.remove(4).is_none());
    assert_eq!(fluid.remove(1).unwrap().position(), [0.7, 1.0]);
    fluid.retain(|p| p.position()[0] < 1.5);
    assert_eq!(fluid.len(), 2);
    for (x, y) in [(2.1, 1.0), (1.0, -0.1), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
        assert!(fluid.add(at(x, y)).is_err());
    }
    fluid.step([0.0, 0.0]);
    assert_eq!(fluid.len(), 2);
    let mut cramped = PositionBasedFluid::<f32, _, 2, 4, 8>::new(OpenBox::new([2.0, 2.0]));
    assert!(cramped.add(at(1.0, 1.0)).unwrap_err().to_string().contains("cells: capacity 8, needed 9"));
}

#[test]
fn three_dimensions_come_to_rest() {
    let settings = Settings { viscosity: 70, ..Settings::DEFAULT };
    let walls = OpenBox::new([4.0, 4.0, 6.0]);
    let mut fluid = PositionBasedFluid::<f32, _, 3, 512, 175>::with_settings(walls, settings);
    for k in 0..512 {
        let place = |n: usize| 0.25 + 0.5 * n as f32;
        fluid.add(Particle::new([place(k % 4), place(k / 4 % 8), place(k / 32 % 12)], [0.0; 3])).ok();
    }
    let particles = fluid.len() as f64;
    for _ in 0..1500 {
        fluid.step([0.0, 0.0, -0.004]);
    }
    let depth = particles / 8.0 / 16.0;
    let centre = fluid.particles().iter().map(|p| f64::from(p.position()[2])).sum::<f64>() / particles;
    assert!((2.0 * centre / depth - 1.0).abs() < 0.05, "height {}", 2.0 * centre / depth);
    let square = |p: &Particle<f32, 3>| p.velocity().iter().map(|v| f64::from(v * v)).sum::<f64>();
    let speed = (fluid.particles().iter().map(square).sum::<f64>() / particles).sqrt();
    assert!(speed < 0.02 * (0.004 * depth).sqrt(), "speed {speed}");
}

#[cfg(feature = "fixed")]
mod fixed_point {
    use super::*;
    use sph_core::scalar::fixed::{Checked, I8F24, I16F16, I16F48, Saturating, Wrapping};

    #[test]
    fn a_dam_break_comes_to_rest() {
        comes_to_rest::<Saturating<I16F16>>();
        comes_to_rest::<Wrapping<I8F24>>();
        comes_to_rest::<Checked<I16F48>>();
    }

    #[test]
    fn nothing_escapes_whatever_the_input() {
        fn all<T: Compact>() {
            survive::<T, _, 49>(OpenBox::new([6.5, 6.5].map(T::from_f64)), 3000);
            survive::<T, _, 64>(Disc::new(T::from_f64(3.5)), 3000);
            survive::<T, _, 100>(Mask::new(&BADGE, 7, T::from_f64(1.25)).unwrap(), 3000);
        }
        all::<Saturating<I16F16>>();
        all::<Saturating<I8F24>>();
        all::<Checked<I16F16>>();
        all::<Wrapping<I16F16>>();
    }

    /// Every push is applied with both signs, so not one unit is lost.
    #[test]
    fn momentum_is_conserved_exactly() {
        for seed in 1..=4 {
            assert_eq!(drift::<Saturating<I16F16>>(10_000, seed), [0.0; 2]);
            assert_eq!(drift::<Wrapping<I8F24>>(10_000, seed), [0.0; 2]);
        }
    }

    #[test]
    fn the_bits_are_the_same_everywhere() {
        assert_eq!(digest::<Saturating<I16F16>>(), 10_989_626_639_518_696_453);
        assert_eq!(digest::<Saturating<I8F24>>(), 600_764_018_129_170_373);
    }
}
