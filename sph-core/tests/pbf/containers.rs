//! Containers that no particle can be kept in are refused, and take none where they were made without a check.

use sph_core::fluid::{Container, Disc, Mask, OpenBox, Particle, PositionBasedFluid, Wall};
use sph_core::scalar::compact::{Compact, NearUnit};
use sph_core::{Error, Parameter};

use crate::measure::at;

fn box_of<T: Compact>(sides: [f64; 2]) -> Result<OpenBox<T, 2>, Error> {
    OpenBox::try_new(sides.map(T::from_f64))
}

fn sizes_below_those_documented_are_refused<T: Compact>() {
    for side in [0.25, 1.0, 100.0] {
        let container = box_of::<T>([side, 2.0]).unwrap();
        assert!(container.contains(&[side / 2.0, 1.0].map(T::from_f64)), "{side}");
        assert!(!container.contains(&[side / 2.0, 2.0 + 1.0 / 64.0].map(T::from_f64)), "beyond the end");
        assert!(!container.contains(&[side / 2.0, -1.0 / 64.0].map(T::from_f64)), "before the beginning");
        assert!(container.contains(&[0.0, 0.0].map(T::from_f64)), "walls belong to the box");
        assert!(container.contains(&[side, 2.0].map(T::from_f64)), "walls belong to the box");
    }
    for side in [0.249, 1.0 / 64.0] {
        for sides in [[side, 2.0], [2.0, side]] {
            assert!(matches!(box_of::<T>(sides), Err(Error::NotRepresentable { .. })), "{side}");
            let unchecked = OpenBox::new(sides.map(T::from_f64));
            assert!(!unchecked.contains(&[side / 2.0; 2].map(T::from_f64)), "{side}");
            let mut fluid = PositionBasedFluid::<T, _, 2, 4, 9>::new(unchecked);
            assert!(fluid.add(at(side / 2.0, side / 2.0)).is_err(), "{side}");
        }
    }
    for side in [0.0, -1.0] {
        assert!(matches!(box_of::<T>([2.0, side]), Err(Error::NotPositive { index: 1, .. })), "{side}");
    }
    assert!(Disc::try_new(T::ONE).is_ok_and(|disc| disc.contains(&[T::ONE; 2])));
    for radius in [0.99, 0.5] {
        assert!(matches!(Disc::try_new(T::from_f64(radius)), Err(Error::NotRepresentable { .. })));
        let centre = [T::from_f64(radius); 2];
        assert!(!Disc::new(T::from_f64(radius)).contains(&centre), "{radius}");
    }
    assert!(matches!(Disc::try_new(T::ZERO), Err(Error::NotPositive { .. })));
}

#[test]
fn sizes_below_those_documented_are_refused_in_floats() {
    sizes_below_those_documented_are_refused::<f32>();
    sizes_below_those_documented_are_refused::<f64>();
    for value in [f32::NAN, f32::INFINITY] {
        assert!(matches!(OpenBox::try_new([1.0, value]), Err(Error::NotFinite { index: 1, .. })));
        assert!(matches!(Disc::try_new(value), Err(Error::NotFinite { .. })));
    }
    assert!(matches!(Disc::try_new(f32::MAX), Err(Error::NotRepresentable { .. })), "2 R is infinite");
}

/// A particle that would leave is put back towards the centre, `gap` inside; one that is inside stays.
fn a_disc_puts_back<T: Compact>() {
    let number = |x: f64| T::from_f64(x).near();
    let disc = Disc::new(T::from_f64(4.0));
    let from = [4.0, 4.0].map(number);
    for (to, expected) in [
        ([9.0, 4.0], [8.0, 4.0]),
        ([4.0, -1.0], [4.0, 0.0]),
        ([8.0, 8.0], [6.740_076, 6.740_076]),
        ([7.5, 4.0], [7.5, 4.0]),
        ([0.0, 4.0], [0.0, 4.0]),
    ] {
        let found = disc.confine(&from, to.map(number), number(0.125));
        for axis in 0..2 {
            let error = T::from_near(found[axis]).to_f64() - expected[axis];
            assert!(error.abs() < 1e-3, "{to:?}: {found:?}");
        }
    }
}

#[test]
fn a_disc_puts_back_what_would_leave() {
    a_disc_puts_back::<f32>();
    a_disc_puts_back::<f64>();
}

/// A disc's wall is a plane at the distance to the rim, towards the centre, and none beyond h.
fn the_wall_of_a_disc_is_a_plane_at_its_rim<T: Compact>() {
    let disc = Disc::new(T::from_f64(4.0));
    let wall = |x: [f64; 2]| disc.wall(&x.map(|along| T::from_f64(along).near()));
    for x in [[4.0, 4.0], [4.5, 3.0], [4.0, 1.0 + 1.0 / 64.0], [2.5, 5.5]] {
        assert_eq!(wall(x), None, "{x:?} is more than h from the rim");
    }
    let diagonal = 4.0 - 3.5 * core::f64::consts::FRAC_1_SQRT_2;
    for (x, d, normal) in [
        ([0.5, 4.0], 0.5, [1.0, 0.0]),
        ([4.0, 7.25], 0.75, [0.0, -1.0]),
        ([8.0, 4.0], 0.0, [-1.0, 0.0]),
        ([diagonal, diagonal], 0.5, [core::f64::consts::FRAC_1_SQRT_2; 2]),
    ] {
        let expected = Wall::plane(d, normal).unwrap();
        let found = wall(x).unwrap();
        assert!((found.share.to_f64() - expected.share).abs() < 1e-3, "{x:?}: {found:?}");
        for axis in 0..2 {
            assert!((found.push[axis].to_f64() - expected.push[axis]).abs() < 2e-3, "{x:?}: {found:?}");
        }
    }
    let [rim, beyond] = [8.0, 8.0 + 1.0 / 64.0].map(T::from_f64);
    assert!(disc.contains(&[rim, T::from_f64(4.0)]), "the rim belongs to the disc");
    assert!(!disc.contains(&[beyond, T::from_f64(4.0)]));
}

#[test]
fn the_wall_of_a_disc_is_a_plane_at_its_rim_in_floats() {
    the_wall_of_a_disc_is_a_plane_at_its_rim::<f32>();
    the_wall_of_a_disc_is_a_plane_at_its_rim::<f64>();
}

#[test]
fn errors_of_a_disc_and_a_mask_say_what_was_needed() {
    let axis = Parameter::Axis;
    assert_eq!(Disc::try_new(f32::NAN), Err(Error::NotFinite { parameter: axis, index: 0 }));
    assert_eq!(Disc::try_new(-1.0_f32), Err(Error::NotPositive { parameter: axis, index: 0 }));
    let mask = |bits: &'static [u8], width, pixel: f32| Mask::new(bits, width, pixel).err();
    let cells = Parameter::Cells;
    assert_eq!(mask(&[0xff; 2], 8, 0.5), None);
    assert_eq!(mask(&[0xff; 2], 8, 0.49), Some(Error::NotRepresentable { parameter: axis }));
    assert_eq!(mask(&[0xff; 2], 8, 0.0), Some(Error::NotPositive { parameter: axis, index: 0 }));
    assert_eq!(mask(&[0xff; 2], 0, 1.0), Some(Error::NotPositive { parameter: cells, index: 0 }));
    assert_eq!(mask(&[], 8, 1.0), Some(Error::NotPositive { parameter: cells, index: 1 }));
    assert_eq!(mask(&[0xff; 255], 8, 1.0), None);
    let tall = Error::CapacityExceeded { parameter: cells, capacity: 255, needed: 256 };
    assert_eq!(mask(&[0xff; 256], 8, 1.0), Some(tall));
}

#[test]
fn an_impulse_is_added_to_every_velocity_and_held_at_one() {
    let mut fluid = PositionBasedFluid::<f64, _, 2, 4, 25>::new(OpenBox::new([4.0, 4.0]));
    for (x, velocity) in [(1.0, [0.25, 0.0]), (3.0, [-0.5, 0.75])] {
        fluid.add(Particle::new([x, 2.0], velocity)).unwrap();
    }
    fluid.impulse(|particle| [particle.position()[0] / 8.0, -0.5]);
    let velocities = |fluid: &PositionBasedFluid<f64, OpenBox<f64, 2>, 2, 4, 25>| {
        [0, 1].map(|index| fluid.particles()[index].velocity())
    };
    assert_eq!(velocities(&fluid), [[0.375, -0.5], [-0.125, 0.25]]);
    fluid.impulse(|_| [f64::NAN, 7.0]);
    assert_eq!(velocities(&fluid), [[0.375, 0.5], [-0.125, 1.0]]);
}

#[cfg(feature = "fixed")]
mod fixed_point {
    use super::*;
    use sph_core::Scalar;
    use sph_core::scalar::fixed::{I8F24, I16F16, Saturating, Wrapping};

    #[test]
    fn sizes_below_those_documented_are_refused() {
        super::sizes_below_those_documented_are_refused::<Saturating<I16F16>>();
        super::sizes_below_those_documented_are_refused::<Wrapping<I8F24>>();
    }

    #[test]
    fn a_disc_puts_back_what_would_leave() {
        super::a_disc_puts_back::<Saturating<I16F16>>();
        super::a_disc_puts_back::<Saturating<I8F24>>();
    }

    #[test]
    fn the_wall_of_a_disc_is_a_plane_at_its_rim() {
        super::the_wall_of_a_disc_is_a_plane_at_its_rim::<Saturating<I16F16>>();
        super::the_wall_of_a_disc_is_a_plane_at_its_rim::<Saturating<I8F24>>();
    }

    #[test]
    fn a_number_near_one_is_held_at_both_ends() {
        let near = |x: f64| Saturating::<I16F16>::from_f64(x).near();
        let unit = 1.0 / 16_384.0;
        for (x, held) in [
            (0.25, 0.25),
            (-0.25, -0.25),
            (0.25 + unit, 0.25),
            (-0.25 - unit, -0.25),
            (0.25 - unit, 0.25 - unit),
            (-0.25 + unit, -0.25 + unit),
            (3.0, 0.25),
            (-3.0, -0.25),
            (0.0, 0.0),
        ] {
            assert_eq!(near(x).clamp_abs(near(0.25)), near(held), "{x}");
        }
    }

    /// A radius of 20,000 is a number of 16.16, 2 R is none.
    #[test]
    fn what_leaves_the_range_of_a_scalar_is_refused() {
        fn refused<T: Compact>() {
            assert!(matches!(Disc::try_new(T::from_f64(20_000.0)), Err(Error::NotRepresentable { .. })));
            let bits = [0xff; 32];
            assert!(Mask::<T>::new(&bits, 255, T::from_f64(128.0)).is_ok());
            let wide = Mask::<T>::new(&bits, 255, T::from_f64(129.0));
            assert!(matches!(wide, Err(Error::NotRepresentable { .. })));
        }
        refused::<Saturating<I16F16>>();
        refused::<Wrapping<I16F16>>();
    }
}
