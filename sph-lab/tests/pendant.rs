//! A pendant's firmware under a plain test: the code that a microcontroller runs, generic over its number type, watched on the way.
//!
//! `Pendant` is the firmware: some particles in a disc, tilted by an accelerometer, shown on lamps. Nothing in it knows of tests.

use sph_core::fluid::{Disc, Particle, PositionBasedFluid, Raster};
use sph_core::scalar::compact::Compact;
use sph_core::scalar::fixed::{Saturating, types::I5F11};
use sph_lab::{Format, Shadow, Tally, watch};

/// The firmware of the pendant.
struct Pendant<T: Compact> {
    fluid: PositionBasedFluid<T, Disc<T>, 2, 48, 100, u8>,
    lamps: Raster<8, 8>,
}

impl<T: Compact> Pendant<T> {
    /// A disc of radius 4 h, a third of it full.
    fn new() -> Self {
        let mut fluid = PositionBasedFluid::new(Disc::new(T::ratio(4, 1)));
        for k in 0..40 {
            let at = [T::ratio(10 + 2 * (k % 10), 5), T::ratio(8 + 2 * (k / 10), 5)];
            fluid.add(Particle::new(at, [T::ZERO; 2])).expect("room for 48 particles");
        }
        Self { fluid, lamps: Raster::new() }
    }

    /// One frame: what the accelerometer reads along its axes, in 1/1000 g.
    fn frame(&mut self, [x, y]: [i32; 2]) {
        // at rest and 60 frames a second, g is 0.005 h a frame²
        let per_thousand = |reading: i32| T::ratio(reading.clamp(-2000, 2000), 200_000);
        self.fluid.step([per_thousand(x), per_thousand(y)]);
        self.lamps.update(self.fluid.particles(), T::ONE);
    }

    /// What the lamps show.
    fn lit(&self) -> Vec<bool> {
        (0..64).map(|lamp| self.lamps.is_lit(lamp % 8, lamp / 8)).collect()
    }
}

/// The number type of the firmware.
type Real = Saturating<I5F11>;

/// What the accelerometer reads while the pendant is turned about.
fn readings() -> impl Iterator<Item = [i32; 2]> {
    (0..90).map(|frame| {
        let angle = f64::from(frame) / 90.0 * std::f64::consts::TAU;
        [(1000.0 * angle.sin()) as i32, (-1000.0 * angle.cos()) as i32]
    })
}

fn play<T: Compact>() -> Vec<Vec<bool>> {
    let mut pendant = Pendant::<T>::new();
    readings()
        .map(|reading| {
            pendant.frame(reading);
            pendant.lit()
        })
        .collect()
}

#[test]
fn no_number_of_the_pendant_leaves_its_range() {
    let (watched, log) = watch(play::<Tally<Real>>);
    assert_eq!(watched, play::<Real>(), "who watches changes no lamp");
    assert_eq!(log.saturations().consequential(), 0, "{log}");
    // the short numbers of the solver are seen too: offsets of a pair and the weights between them
    let widest = log.widest().expect("some numbers");
    assert!(widest.largest() < 16.0, "{}: {}", widest.place, widest.largest());
    assert!(log.places().iter().any(|record| record.place.file().starts_with("fluid/pbf")), "{log}");
}

#[test]
fn the_lamps_of_another_format_are_nearly_those_of_f64() {
    let exact = play::<f64>();
    let differing = |found: Vec<Vec<bool>>| {
        let lamps = found.iter().flatten().zip(exact.iter().flatten());
        lamps.filter(|(a, b)| a != b).count() as f64 / (64.0 * 90.0)
    };
    assert!(differing(play::<Real>()) < 0.06, "{}", differing(play::<Real>()));
    // a format that is not compiled, for a firmware that might have it
    let coarse = Format::new(5, 5).unwrap().scope(play::<sph_lab::Emulated>);
    assert!(differing(coarse) > 0.0);
}

#[test]
fn the_error_of_a_frame_is_told_by_a_shadow_that_is_anchored_each_frame() {
    let (_, log) = watch(|| {
        let mut pendant = Pendant::<Shadow<Real>>::new();
        pendant.frame([0, -1000]);
        pendant.fluid.particles()[0].position().map(Shadow::anchored)
    });
    let (otherwise, all) = log.comparisons();
    assert!(all > 100 && otherwise * 10 < all, "{otherwise} of {all} comparisons");
    let worst =
        log.places().iter().max_by(|a, b| a.errors.local.total_cmp(&b.errors.local)).expect("some places");
    assert!(worst.errors.local <= 1.0 / 2048.0, "a unit: {} at {}", worst.errors.local, worst.place);
}
