//! Containers against descriptions of their own: a mask pixel by pixel, and a container from outside that leaves out what it may.

use sph_core::fluid::{Container, Mask};
use sph_core::scalar::compact::Compact;

/// Nine columns, so that a row takes two bytes, whose last seven bits are of no pixel.
const ROWS: [&str; 4] = ["##..#.#.#", ".#####.##", "#..##..##", "#.#######"];

/// The bits of the rows; those of no pixel are set.
fn bits() -> Vec<u8> {
    let row = |row: &&str| {
        let open = |k: usize| row.as_bytes().get(k).is_none_or(|&pixel| pixel == b'#');
        [0, 8].map(|first| (0..8).fold(0, |byte, k| byte << 1 | u8::from(open(first + k))))
    };
    ROWS.iter().flat_map(row).collect()
}

#[test]
fn a_mask_is_open_where_its_pixels_are_and_nowhere_else() {
    fn check<T: Compact>(pixels: &[f64]) {
        let bits = bits();
        for &pixel in pixels {
            let mask = Mask::<T>::new(&bits, 9, T::from_f64(pixel)).unwrap();
            assert_eq!(mask.size().map(T::to_f64), [9.0 * pixel, 4.0 * pixel]);
            for (i, j) in (-12..=52).flat_map(|i| (-12..=28).map(move |j| (i, j))) {
                // quarters of a pixel: edges, also the outer ones, and what lies between
                let at = [i, j].map(|k| f64::from(k) / 4.0);
                let is_open = |column: f64, row: f64| {
                    let pixel = ROWS.get(row as usize).and_then(|row| row.as_bytes().get(column as usize));
                    pixel == Some(&b'#')
                };
                let expected = at.iter().all(|&x| x >= 0.0) && is_open(at[0].floor(), at[1].floor());
                let x = at.map(|x| T::from_f64(x * pixel));
                assert_eq!(mask.contains(&x), expected, "{} pixels of {pixel}: {at:?}", T::NAME);
            }
        }
    }
    check::<f32>(&[0.5, 0.75, 2.0]);
    check::<f64>(&[0.5, 0.75, 2.0]);
    // one over 3/4 is no number of 16.16, so that an edge of such pixels is off by a rounding
    #[cfg(feature = "fixed")]
    check::<sph_core::scalar::fixed::Saturating<sph_core::scalar::fixed::I16F16>>(&[0.5, 2.0]);
}

#[cfg(feature = "fixed")]
mod fixed_point {
    use super::*;
    use sph_core::Scalar;
    use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid, Wall};
    use sph_core::scalar::fixed::{I16F16, Saturating};

    type Number = Saturating<I16F16>;
    type Near = <Number as Compact>::Near;

    /// A box whose author says only what has to be said.
    struct Plain(OpenBox<Number, 2>);

    impl Container<Number, 2> for Plain {
        fn size(&self) -> [Number; 2] {
            self.0.size()
        }

        fn contains(&self, x: &[Number; 2]) -> bool {
            self.0.contains(x)
        }

        fn wall(&self, x: &[Near; 2]) -> Option<Wall<Near, 2>> {
            self.0.wall(x)
        }

        fn confine(&self, from: &[Near; 2], to: [Near; 2], gap: Near) -> [Near; 2] {
            self.0.confine(from, to, gap)
        }
    }

    /// Where sixty particles are after five seconds of shaking.
    fn shaken<C: Container<Number, 2>>(container: C) -> Vec<[f64; 2]> {
        let number = Number::from_f64;
        let mut fluid = PositionBasedFluid::<Number, C, 2, 64, 100>::new(container);
        for k in 0..60 {
            let at = [1.5 + 0.5 * f64::from(k % 10), 2.0 + 0.5 * f64::from(k / 10)];
            fluid.add(Particle::new(at.map(number), [number(0.0); 2])).unwrap();
        }
        for frame in 0..300 {
            let down = [[0.0, -0.3], [0.3, 0.0], [0.0, 0.3], [-0.3, 0.0]][frame / 40 % 4];
            fluid.step(down.map(number));
        }
        fluid.particles().iter().map(|particle| particle.position().map(Scalar::to_f64)).collect()
    }

    /// In fixed point the way a particle went is the difference of its places without a rounding, so that the bits are the same.
    #[test]
    fn a_container_that_leaves_out_what_only_saves_time_has_the_same_bits() {
        let walls = || OpenBox::new([8.0, 8.0].map(Number::from_f64));
        assert_eq!(shaken(Plain(walls())), shaken(walls()));
    }
}
