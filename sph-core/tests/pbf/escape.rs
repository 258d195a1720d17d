//! Nothing escapes, whatever the input: every container, shaken with numbers up to the limits of the type.

use crate::measure::{Noise, at, block, extremes, state};
use sph_core::fluid::{
    BorrowedFluid, Container, Disc, Mask, OpenBox, Particle, PositionBasedFluid, Settings, Shape,
};
use sph_core::scalar::compact::Compact;

/// Frames in an ordinary test run; the whole length is that of the ignored tests.
const FRAMES: usize = 1500;
const LONG: usize = 100_000;

/// Two chambers and a door.
const BADGE: [u8; 7] =
    [0b1111_1110, 0b1110_1110, 0b1110_1110, 0b1111_1110, 0b1110_1110, 0b1110_1110, 0b1011_1110];

/// Shakes with numbers of all kinds and looks that all particles stay inside, then that the fluid calms down again.
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

/// The same in three dimensions.
fn survive_in_3d<T: Compact, C: Container<T, 3>>(container: C, frames: usize) {
    let mut fluid = PositionBasedFluid::<T, C, 3, 120, 125>::new(container);
    for k in 0..1000 {
        let place = [k % 10, k / 10 % 10, k / 100].map(|n| T::from_f64(0.25 + 0.5 * f64::from(n)));
        let _ = fluid.add(Particle::new(place, [T::ZERO; 3]));
    }
    assert_eq!(fluid.len(), 120);
    let mut noise = Noise(7);
    for frame in 0..frames {
        let [x, y]: [T; 2] = extremes(&mut noise);
        let [z, _]: [T; 2] = extremes(&mut noise);
        fluid.step([x, y, z]);
        for particle in fluid.particles() {
            let x = particle.position();
            assert!(fluid.container().contains(&x), "frame {frame}: {x:?}");
        }
    }
}

/// A ring: a post in the middle of a disc, by a distance that divides by zero in the very centre.
fn ring<T: Compact>() -> impl Container<T, 2> {
    let number = T::from_f64;
    Shape::new([number(9.0); 2], move |x: &[T; 2]| {
        let [dx, dy] = x.map(|along| along - number(4.5));
        let r = (dx * dx + dy * dy).sqrt();
        let outward = [dx / r, dy / r];
        if r > number(2.75) { (number(4.5) - r, outward.map(|n| -n)) } else { (r - T::ONE, outward) }
    })
}

/// Every container but the ring, which needs squares of 40.
fn all<T: Compact>(frames: usize) {
    survive::<T, _, 49>(OpenBox::new([T::from_f64(6.5); 2]), frames);
    survive::<T, _, 64>(Disc::new(T::from_f64(3.5)), frames);
    survive::<T, _, 100>(Mask::new(&BADGE, 7, T::from_f64(1.25)).unwrap(), frames);
    survive_in_3d::<T, _>(OpenBox::new([T::from_f64(4.3); 3]), frames / 2);
    survive_in_3d::<T, _>(Disc::new(T::from_f64(2.4)), frames / 2);
}

#[test]
fn nothing_escapes_whatever_the_input() {
    all::<f32>(FRAMES);
    survive::<f32, _, 100>(ring(), FRAMES);
}

/// `cargo test --release -p sph-core --all-features --test pbf -- --ignored`
#[test]
#[ignore = "a minute"]
fn nothing_escapes_in_a_hundred_thousand_frames() {
    all::<f32>(LONG);
    survive::<f32, _, 100>(ring(), LONG);
}

/// Particles that `new` refuses, in the solver that does not look at them, beside a block of others.
fn strays<T: Compact>(places: &[T]) {
    let walls = OpenBox::new([T::ratio(11, 2); 2]);
    for (axis, make) in [
        (0, Particle::new as fn(_, _) -> _),
        (1, Particle::new),
        (0, Particle::trusted),
        (1, Particle::trusted),
    ] {
        let mut starts = [0_u16; 36];
        let mut particles: Vec<_> = block([1.0; 2], 4, 4).collect();
        for &place in places {
            let mut position = [T::ONE; 2];
            position[axis] = place;
            particles.push(make(position, [T::ZERO; 2]));
        }
        assert!(BorrowedFluid::new(&walls, Settings::DEFAULT, &mut particles, &mut starts).is_err());
        for _ in 0..100 {
            let fluid = BorrowedFluid::trusted(&walls, Settings::DEFAULT, &mut particles, &mut starts);
            fluid.unwrap().step([T::ratio(1, 100), T::ratio(-1, 100)]);
        }
        assert_eq!(particles.len(), 16 + places.len());
    }
}

#[test]
fn nothing_panics_where_particles_are_outside_that_were_trusted() {
    strays(&[f32::MAX, f32::MIN, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -0.01, 5.6, 65_536.0]);
}

#[cfg(feature = "fixed")]
mod fixed_point {
    use super::*;
    use sph_core::scalar::fixed::{Checked, I8F24, I16F16, Saturating, Wrapping};
    use sph_core::{Arithmetic, Scalar};

    #[test]
    fn nothing_escapes_whatever_the_input() {
        all::<Saturating<I16F16>>(FRAMES);
        all::<Saturating<I8F24>>(FRAMES);
        all::<Checked<I16F16>>(FRAMES);
        all::<Wrapping<I16F16>>(FRAMES);
        survive::<Saturating<I16F16>, _, 100>(ring(), FRAMES);
    }

    #[test]
    fn nothing_panics_where_particles_are_outside_that_were_trusted() {
        type Number = Saturating<I16F16>;
        strays(&[Number::MAX, -Number::MAX, Number::ratio(-1, 100), Number::ratio(28, 5)]);
        strays(&[Wrapping::<I16F16>::ratio(-1, 100), Wrapping::<I16F16>::ratio(28, 5)]);
    }

    #[test]
    #[ignore = "a minute"]
    fn nothing_escapes_in_a_hundred_thousand_frames() {
        all::<Saturating<I16F16>>(LONG);
        all::<Saturating<I8F24>>(LONG);
        survive::<Saturating<I16F16>, _, 100>(ring(), LONG);
    }
}
