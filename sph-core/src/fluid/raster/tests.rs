use super::*;

/// Fluid that fills the box from 0 to 4 × 3 at the spacing of rest.
fn filled(shift: f32) -> [Particle<f32, 2>; 48] {
    core::array::from_fn(|k| {
        Particle::new([0.25 + 0.5 * (k % 8) as f32 + shift, 0.25 + 0.5 * (k / 8) as f32], [0.0; 2])
    })
}

/// One particle gives a pixel a quarter of [`Raster::FULL`], 40: more than the largest number of these types.
#[cfg(feature = "fixed")]
#[test]
fn a_type_that_ends_below_a_share_of_light_gives_it_all_the_same() {
    use crate::scalar::fixed::{Saturating, types};
    fn densities<T: Compact>() -> [[u8; 4]; 3] {
        let mut raster = Raster::<4, 3>::new();
        let at = |k: i32| [T::ratio(3 * k % 31, 8), T::ratio(7 * k % 23, 8)];
        let particles: [Particle<T, 2>; 20] =
            core::array::from_fn(|k| Particle::new(at(k as i32), [T::ZERO; 2]));
        raster.update(&particles, T::ONE);
        raster.density
    }
    let exact = densities::<f64>();
    assert!(exact.iter().flatten().any(|density| *density > 40));
    for found in [densities::<Saturating<types::I5F11>>(), densities::<Saturating<types::I4F12>>()] {
        for (found, exact) in found.iter().flatten().zip(exact.iter().flatten()) {
            assert!(found.abs_diff(*exact) <= 2, "{found} for {exact}");
        }
    }
}

#[test]
fn the_inside_is_full_and_the_outside_dark() {
    for pixel in [0.5_f32, 1.0] {
        let mut raster = Raster::<12, 12>::new();
        raster.update(&filled(0.0), pixel);
        let middle = (1.5 / pixel) as usize;
        let density = i32::from(raster.density(middle, middle));
        assert!((density - 160).abs() <= 10, "{density} at {pixel}");
        let beyond = (5.0 / pixel) as usize;
        assert_eq!((raster.density(beyond, 0), raster.is_lit(beyond, 0)), (0, false));
        assert!(raster.is_lit(middle, middle));
    }
}

#[test]
fn a_lamp_at_the_surface_does_not_flicker() {
    let mut raster = Raster::<8, 4>::new();
    let mut changes = 0;
    let mut was = false;
    for frame in 0..100 {
        // the surface trembles by a fifth of a pixel around the middle of the fifth column
        let shift = if frame % 2 == 0 { 0.4 } else { 0.6 };
        raster.update(&filled(shift), 1.0);
        changes += usize::from(raster.is_lit(4, 1) != was);
        was = raster.is_lit(4, 1);
    }
    assert!(changes <= 1, "{changes}");
}

#[test]
fn a_lamp_stays_as_it_is_between_the_thresholds() {
    let mut raster = Raster::<8, 4>::new();
    let (mut dark_between, mut lit_between, mut was) = (0, 0, false);
    // the surface goes right through the fifth column and back
    for step in (0..=100).chain((0..100).rev()) {
        raster.update(&filled(step as f32 / 100.0), 1.0);
        let (density, is_lit) = (raster.density(4, 1), raster.is_lit(4, 1));
        match density {
            0..64 => assert!(!is_lit),
            96.. => assert!(is_lit),
            _ => {
                assert_eq!(is_lit, was, "{density}");
                dark_between += usize::from(!is_lit);
                lit_between += usize::from(is_lit);
            }
        }
        was = is_lit;
    }
    assert!(dark_between > 0 && lit_between > 0);
}

/// The formula, in f64, and how many particles add to it.
fn formula(particles: &[[f64; 2]], pixel: f64, [column, row]: [usize; 2]) -> (f64, usize) {
    let width = pixel.max(1.0);
    let tent = |x: f64, k: usize| (1.0 - (x - (k as f64 + 0.5) * pixel).abs() / width).max(0.0);
    let shares = particles.iter().map(|[x, y]| 40.0 / (width * width) * tent(*x, column) * tent(*y, row));
    shares.filter(|share| *share > 0.0).fold((0.0, 0), |(sum, count), share| (sum + share, count + 1))
}

/// Particles spread over more than the grid, at places that every type here holds.
fn spread<T: Compact>() -> ([Particle<T, 2>; 60], [[f64; 2]; 60]) {
    let at = |k: usize| [(37 * k % 500) as i32 - 60, (83 * k % 499) as i32 - 60];
    (
        core::array::from_fn(|k| Particle::new(at(k).map(|n| T::ratio(n, 64)), [T::ZERO; 2])),
        core::array::from_fn(|k| at(k).map(|n| f64::from(n) / 64.0)),
    )
}

fn follows_the_formula<T: Compact>(step: f64) {
    let (particles, places) = spread::<T>();
    for (numerator, denominator) in [(1, 4), (31, 32), (1, 1), (3, 2), (3, 1)] {
        let pixel = f64::from(numerator) / f64::from(denominator);
        let mut raster = Raster::<13, 11>::new();
        raster.update(&particles, T::ratio(numerator, denominator));
        let (mut all, mut expected) = (0.0, 0.0);
        for row in 0..11 {
            for column in 0..13 {
                let (exact, count) = formula(&places, pixel, [column, row]);
                let found = f64::from(raster.density(column, row));
                // a half by rounding to a byte; each tent is rounded down by at most 1/256, a length by a step of the type
                let bound = (0.5 + 40.0 * (2.0 / 256.0 + 8.0 * step)) * count as f64;
                assert!(
                    (found - exact.min(255.0)).abs() <= bound,
                    "{found} for {exact} at {column}, {row}, pixel {pixel}"
                );
                (all, expected) = (all + found, expected + exact);
            }
        }
        // the wider a pixel, the smaller the shares beside the step of a byte
        let bias = 0.004 + 0.03 * (pixel - 1.0).max(0.0);
        assert!(
            (all / expected - 1.0).abs() < bias,
            "{}: {} of {expected} at pixel {pixel}",
            T::NAME,
            all / expected
        );
    }
}

#[test]
fn densities_follow_the_formula() {
    follows_the_formula::<f32>(0.0);
    follows_the_formula::<f64>(0.0);
}

#[cfg(feature = "fixed")]
#[test]
fn densities_follow_the_formula_in_fixed_point() {
    use crate::scalar::fixed::{Saturating, Wrapping, types};
    follows_the_formula::<Wrapping<types::I16F16>>(f64::powi(2.0, -16));
    follows_the_formula::<Saturating<types::I16F16>>(f64::powi(2.0, -16));
    follows_the_formula::<Saturating<types::I5F11>>(f64::powi(2.0, -11));
    follows_the_formula::<Saturating<types::I8F24>>(f64::powi(2.0, -24));
}

#[test]
fn what_lies_outside_or_is_no_number_adds_nothing() {
    let far =
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 6.0, 40_000.0, -40_000.0, f32::MAX, f32::MIN];
    let mut raster = Raster::<5, 4>::new();
    for x in far {
        raster.update(&[Particle::new([x, 1.5], [0.0; 2]), Particle::new([1.5, x], [0.0; 2])], 1.0);
        assert_eq!(raster.densities(), &[[0; 5]; 4], "{x}");
    }
}

#[test]
fn memory_of_any_size_is_drawn_in() {
    let particles = filled(0.0);
    draw_density(&particles, 1.0, 0, &mut [1; 3]);
    draw_density::<f32>(&particles, 1.0, 5, &mut []);
    let mut density = [7; 5 * 3 + 2];
    draw_density(&particles, 1.0, 5, &mut density);
    let mut raster = Raster::<5, 3>::new();
    raster.update(&particles, 1.0);
    assert_eq!((&density[..15], &density[15..]), (raster.densities().as_flattened(), &[0, 0][..]));
    // pixels too fine for any of them to be beyond the first particles
    for pixel in [f32::MIN_POSITIVE, 1e-6] {
        draw_density(&particles, pixel, 5, &mut density);
        assert!(density[..15].iter().all(|&density| density > 0 && density == density_at_corner(&particles)));
    }
}

/// Of a pixel as small as can be, at the corner of the box.
fn density_at_corner(particles: &[Particle<f32, 2>]) -> u8 {
    let mut raster = Raster::<1, 1>::new();
    raster.update(particles, 1e-5);
    raster.density(0, 0)
}

#[test]
fn senseless_pixels_show_nothing() {
    let mut raster = Raster::<3, 3>::new();
    for pixel in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        raster.update(&filled(0.0), pixel);
        assert_eq!(raster.lamps(), &[[false; 3]; 3]);
    }
    assert_eq!((raster.density(3, 0), raster.is_lit(0, 3)), (0, false));
}

#[cfg(feature = "embedded-graphics")]
#[test]
fn is_drawn_with_the_last_row_at_the_top() {
    use core::convert::Infallible;
    use embedded_graphics_core::{Pixel, pixelcolor::BinaryColor, prelude::*};

    struct Display([[bool; 6]; 6]);
    impl OriginDimensions for Display {
        fn size(&self) -> Size {
            Size::new(6, 6)
        }
    }
    impl DrawTarget for Display {
        type Color = BinaryColor;
        type Error = Infallible;
        fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
            &mut self,
            pixels: I,
        ) -> Result<(), Infallible> {
            for Pixel(at, colour) in pixels {
                self.0[at.y as usize][at.x as usize] = colour.is_on();
            }
            Ok(())
        }
    }

    let mut raster = Raster::<4, 3>::new();
    raster.update(&filled(0.0)[..8], 1.0); // one row of particles at the bottom, fluid half a pixel deep
    let mut display = Display([[false; 6]; 6]);
    let lit = |density, _| BinaryColor::from(density > 40);
    raster.draw(&mut display, Point::new(1, 2), lit).unwrap();
    let rows = display.0.map(|row| row.iter().filter(|&&on| on).count());
    assert_eq!(rows, [0, 0, 0, 0, 4, 0]);
}
