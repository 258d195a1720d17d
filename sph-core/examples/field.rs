//! A temperature field on a microcontroller's types: storage of fixed size in a `static`, u8 indices, and with the feature
//! `fixed` no floating point.
//!
//! `cargo run -p sph-core --example field`, or with `--features fixed`

use sph_core::kernel::Poly6;
use sph_core::{
    Arithmetic, CellLayout, Error, Field, InlineCellGrid, KernelInfluence, Scalar, Sources, Uniform,
};
use std::sync::Mutex;

#[cfg(feature = "fixed")]
type T = sph_core::scalar::fixed::Saturating<sph_core::scalar::fixed::I16F16>;
#[cfg(not(feature = "fixed"))]
type T = f32;

const SENSORS: usize = 64;

/// All the RAM there is: 64 sensors and a grid of 5 × 5 cells.
struct Station {
    positions: [[T; 2]; SENSORS],
    temperatures: [T; SENSORS],
    grid: InlineCellGrid<u8, 26, SENSORS>,
}

static STATION: Mutex<Station> = Mutex::new(Station {
    positions: [[T::ZERO; 2]; SENSORS],
    temperatures: [T::ZERO; SENSORS],
    grid: InlineCellGrid::new(),
});

impl Station {
    /// Sensors half a support radius apart, and 20 degrees that rise by 2 a support radius along x.
    fn measure(&mut self) {
        for i in 0..SENSORS {
            let [x, y] = [T::ratio((i % 8) as i32, 2), T::ratio((i / 8) as i32, 2)];
            self.positions[i] = [x, y];
            self.temperatures[i] = T::ratio(20, 1) + x.times(2);
        }
    }

    /// The temperature and its gradient at x; `None` where there are too few sensors.
    fn at(&mut self, x: [T; 2]) -> Result<Option<(T, [T; 2])>, Error> {
        // the unit of length is the support radius
        let layout = CellLayout::bounded(&[T::ZERO; 2], &[T::ratio(5, 1); 2], [5, 5])?.open();
        let volumes = Sources::new(self.grid.build(layout, &self.positions)?, Uniform(T::ratio(1, 4)))?;
        let w = KernelInfluence::<T, 2, Poly6>::new(T::ONE)?;
        let fit = Field::new(&volumes, &self.temperatures)?.corrected_at(&w, &x);
        Ok(fit.map(|fit| (fit.value, fit.gradient)))
    }
}

pub(crate) fn main() -> Result<(), Error> {
    let mut station = STATION.lock().expect("no other thread");
    station.measure();
    let (value, gradient) = station.at([T::ratio(13, 10), T::ratio(7, 4)])?.expect("sensors on all sides");
    println!("{} bytes in {}: {value:?} degrees, gradient {gradient:?}", size_of::<Station>(), T::NAME);
    assert!((value.to_f64() - 22.6).abs() < 0.01);
    assert!((gradient[0].to_f64() - 2.0).abs() < 0.02 && gradient[1].to_f64().abs() < 0.02);
    assert!(station.at([T::ratio(-3, 1), T::ZERO])?.is_none());
    Ok(())
}
