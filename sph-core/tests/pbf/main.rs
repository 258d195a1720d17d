//! The physics of the position-based fluid: it collapses and rests, keeps its volume and its momentum, and survives anything.

mod bounds;
mod containers;
mod escape;
mod measure;
mod shapes;

use measure::{at, block, dam_break, drift};
use sph_core::fluid::{
    BorrowedFluid, Container, Mask, OpenBox, Particle, PositionBasedFluid, Settings, Wall,
};
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
fn a_trusted_particle_is_the_same_as_one_that_was_looked_at() {
    for (position, velocity) in
        [([0.5_f32, 7.25], [0.5, -0.25]), ([0.0, 65_536.0], [3.0, -3.0]), ([-1.0, 1.0], [f32::NAN, 0.0])]
    {
        let [new, trusted] = [Particle::new(position, velocity), Particle::trusted(position, velocity)];
        assert_eq!(new.position(), position);
        assert_eq!(trusted.position(), position);
        let held = velocity.map(|v| if v.is_nan() { 0.0 } else { v.clamp(-1.0, 1.0) });
        assert_eq!([new.velocity(), trusted.velocity()], [held, held]);
    }
}

/// 4 × 4 × 4 of fluid; the mean is taken over 200 frames, a single one's speed varying by a fifth.
#[test]
fn three_dimensions_come_to_rest() {
    let walls = OpenBox::new([4.0, 4.0, 6.0]);
    let mut fluid = PositionBasedFluid::<f32, _, 3, 512, 175>::with_settings(walls, Settings::IN_3D);
    for k in 0..512 {
        let place = |n: usize| 0.25 + 0.5 * n as f32;
        fluid.add(Particle::new([place(k % 4), place(k / 4 % 8), place(k / 32 % 12)], [0.0; 3])).ok();
    }
    let particles = fluid.len() as f64;
    for _ in 0..1000 {
        fluid.step([0.0, 0.0, -0.004]);
    }
    let depth = particles / 8.0 / 16.0;
    let centre = fluid.particles().iter().map(|p| f64::from(p.position()[2])).sum::<f64>() / particles;
    assert!((2.0 * centre / depth - 1.0).abs() < 0.03, "height {}", 2.0 * centre / depth);
    let mut square = 0.0;
    for _ in 0..200 {
        fluid.step([0.0, 0.0, -0.004]);
        let velocities = fluid.particles().iter().flat_map(Particle::velocity);
        square += velocities.map(|v| f64::from(v * v)).sum::<f64>() / particles / 200.0;
    }
    let speed = square.sqrt() / (0.004 * depth).sqrt();
    assert!(speed < 0.01, "speed {speed}");
}

/// The same memory, owned and borrowed, gives the same bits; so does a run that is taken up again.
#[test]
fn owned_and_borrowed_are_the_same() {
    let walls = OpenBox::new([6.5_f32, 6.5]);
    let mut owned = PositionBasedFluid::<f32, _, 2, 64, 49>::new(walls);
    let mut particles: Vec<_> = block([0.5, 0.5], 8, 8).collect();
    for &particle in &particles {
        owned.add(particle).unwrap();
    }
    let mut starts = [7_u32; 49];
    for _ in 0..50 {
        let resumed =
            |p: &Particle<f32, 2>| Particle::new(p.position(), p.velocity()).with_pressure(p.pressure());
        particles = particles.iter().map(resumed).collect();
        let mut borrowed =
            BorrowedFluid::new(&walls, Settings::DEFAULT, &mut particles, &mut starts).unwrap();
        borrowed.step([0.003, -0.005]);
        owned.step([0.003, -0.005]);
    }
    let bits = |particles: &[Particle<f32, 2>]| -> Vec<u32> {
        particles.iter().flat_map(|p| [p.position(), p.velocity()]).flatten().map(f32::to_bits).collect()
    };
    assert_eq!(bits(owned.particles()), bits(&particles));
    particles.push(at(7.0, 1.0));
    assert!(BorrowedFluid::new(&walls, Settings::DEFAULT, &mut particles, &mut starts).is_err());
    assert!(BorrowedFluid::new(&walls, Settings::DEFAULT, &mut particles[..9], &mut starts[1..]).is_err());
}

/// Two particles at each of twenty places, in the corner too, are pushed apart.
#[test]
fn coincident_particles_part() {
    let mut fluid = PositionBasedFluid::<f32, _, 2, 40, 49>::new(OpenBox::new([6.5; 2]));
    for k in 0..40 {
        let place = |n: i32| 0.8 * f64::from(n);
        fluid.add(at(place(k / 2 % 5), place(k / 10))).unwrap();
    }
    for _ in 0..800 {
        fluid.step([0.0, -0.005]);
    }
    let spacings = measure::state(fluid.particles()).spacings();
    assert!(spacings[0] > 0.5, "{:?}", &spacings[..4]);
}

/// Far from walls and without gravity too, where nothing but the pair itself tells them apart.
#[test]
fn a_coincident_pair_parts_by_itself() {
    let mut fluid = PositionBasedFluid::<f32, _, 2, 2, 49>::new(OpenBox::new([6.5; 2]));
    for _ in 0..2 {
        fluid.add(at(3.0, 3.0)).unwrap();
    }
    for _ in 0..100 {
        fluid.step([0.0; 2]);
    }
    let spacings = measure::state(fluid.particles()).spacings();
    assert!(spacings[0] > 0.35, "{spacings:?}");
}

/// The pressure in the middle of five particles after a frame of one pass that began with some pressure.
fn pressure_after<T: Compact>(before: f64) -> f64 {
    let settings = Settings { iterations: 1, ..Settings::DEFAULT };
    let mut fluid =
        PositionBasedFluid::<T, _, 2, 5, 64>::with_settings(OpenBox::new([T::from_f64(6.5); 2]), settings);
    for [x, y] in [[0.0, 0.0], [-0.35, 0.0], [0.35, 0.0], [0.0, -0.35], [0.0, 0.35]] {
        fluid.add(at::<T>(3.25 + x, 3.25 + y).with_pressure(T::from_f64(before))).unwrap();
    }
    fluid.step([T::ZERO; 2]);
    fluid.particles().iter().map(|p| p.pressure().to_f64()).fold(f64::MIN, f64::max)
}

/// p = κ ((p of the pass before + Σ t³) / 3.05 − 1), κ = 1.
fn keeps_a_share_of_the_pressure<T: Compact>(tolerance: f64) {
    let excess = (1.0 + 4.0 * (1.0 - 0.35_f64.powi(2)).powi(3)) / 3.05 - 1.0;
    for before in [0.0, 0.1, 0.25, 0.4] {
        let (found, expected) = (pressure_after::<T>(before), excess + before / 3.05);
        assert!((found - expected).abs() < tolerance, "{}: {found} for {expected}", T::NAME);
    }
}

#[test]
fn a_pass_begins_with_a_share_of_the_pressure() {
    keeps_a_share_of_the_pressure::<f32>(1e-5);
    keeps_a_share_of_the_pressure::<f64>(1e-12);
}

/// Particles that are thrown at the floor, too far apart to touch each other, come to lie in 16 heights.
fn lie_at_sixteen_heights<T: Compact>(tolerance: f64) {
    let mut fluid =
        PositionBasedFluid::<T, _, 2, 32, 150>::new(OpenBox::new([T::from_f64(49.5), T::from_f64(2.0)]));
    for k in 0..32 {
        let place = [0.75 + 1.5 * f64::from(k), 0.5].map(T::from_f64);
        fluid.add(Particle::new(place, [T::ZERO, T::from_f64(-0.9)])).unwrap();
    }
    fluid.step([T::ZERO; 2]);
    let mut heights: Vec<f64> = fluid.particles().iter().map(|p| p.position()[1].to_f64()).collect();
    heights.sort_by(f64::total_cmp);
    for (place, height) in heights.iter().enumerate() {
        let expected = (1 + place / 2) as f64 / 128.0;
        assert!((height - expected).abs() < tolerance, "{}: {height} for {expected}", T::NAME);
    }
}

#[test]
fn a_blow_does_not_press_the_fluid_to_a_line() {
    lie_at_sixteen_heights::<f32>(1e-6);
    lie_at_sixteen_heights::<f64>(1e-12);
}

#[cfg(feature = "fixed")]
mod fixed_point {
    use super::*;
    use sph_core::Scalar;
    use sph_core::scalar::fixed::{Checked, I8F24, I16F16, I16F48, I32F32, Saturating, Wrapping};

    #[test]
    fn a_dam_break_comes_to_rest() {
        comes_to_rest::<Saturating<I16F16>>();
        comes_to_rest::<Wrapping<I8F24>>();
        comes_to_rest::<Checked<I16F48>>();
    }

    #[test]
    fn pressure_is_kept_and_a_blow_spread_as_in_floats() {
        keeps_a_share_of_the_pressure::<Saturating<I16F16>>(2e-3);
        keeps_a_share_of_the_pressure::<Wrapping<I8F24>>(2e-3);
        lie_at_sixteen_heights::<Saturating<I16F16>>(2e-4);
        lie_at_sixteen_heights::<Wrapping<I8F24>>(2e-4);
    }

    /// What 2^−14 in 32 bits cannot tell is refused, not taken for another place.
    #[test]
    fn positions_out_of_range_are_refused() {
        type Number = Saturating<I32F32>;
        let mut fluid =
            PositionBasedFluid::<Number, _, 2, 4, 9>::new(OpenBox::new([2.0, 2.0].map(Number::from_f64)));
        for x in [262_145.0, -262_143.0, 65_537.5, 1e9, f64::INFINITY] {
            assert!(fluid.add(at(x, 1.0)).is_err(), "{x}");
        }
        fluid.add(at(1.0, 1.0)).unwrap();
        let mut wide = PositionBasedFluid::<Saturating<I8F24>, _, 2, 4, 200>::new(OpenBox::new(
            [127.5, 0.5].map(Saturating::<I8F24>::from_f64),
        ));
        assert!(wide.add(at(1.0, 0.25)).is_err(), "the scalar ends too soon behind the wall");
    }

    /// Every push is applied with both signs, so not one unit is lost.
    #[test]
    fn momentum_is_conserved_exactly() {
        for seed in 1..=4 {
            assert_eq!(drift::<Saturating<I16F16>>(10_000, seed), [0.0; 2]);
            assert_eq!(drift::<Wrapping<I8F24>>(10_000, seed), [0.0; 2]);
        }
    }
}
