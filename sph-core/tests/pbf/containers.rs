//! Containers that no particle can be kept in are refused, and take none where they were made without a check.

use sph_core::Error;
use sph_core::fluid::{Container, Disc, Mask, OpenBox, PositionBasedFluid};
use sph_core::scalar::compact::Compact;

use crate::measure::at;

fn box_of<T: Compact>(sides: [f64; 2]) -> Result<OpenBox<T, 2>, Error> {
    OpenBox::try_new(sides.map(T::from_f64))
}

fn sizes_below_those_documented_are_refused<T: Compact>() {
    for side in [0.25, 1.0, 100.0] {
        let container = box_of::<T>([side, 2.0]).unwrap();
        assert!(container.contains(&[side / 2.0, 1.0].map(T::from_f64)), "{side}");
        assert!(!container.contains(&[side / 2.0, 2.0 + 1.0 / 64.0].map(T::from_f64)), "beyond the end");
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

#[cfg(feature = "fixed")]
mod fixed_point {
    use super::*;
    use sph_core::scalar::fixed::{I8F24, I16F16, Saturating, Wrapping};

    #[test]
    fn sizes_below_those_documented_are_refused() {
        super::sizes_below_those_documented_are_refused::<Saturating<I16F16>>();
        super::sizes_below_those_documented_are_refused::<Wrapping<I8F24>>();
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
