//! Densities, interpolation and every gradient on a lattice of 64 samples.

#![no_std]
#![no_main]

use fluisim_firmware as _;
use sph_core::kernel::{CubicSpline, WendlandC2};
use sph_core::{
    BruteForce, Error, Field, KernelInfluence, Parameter, PerSampleInfluence, Sources, Uniform, difference,
    field,
};

const SAMPLES: usize = 64;
const VOLUME: Uniform<f32> = Uniform(0.25);
const CENTRE: usize = 27;

/// A lattice 8 × 8 with spacing 1/2.
fn lattice() -> [[f32; 2]; SAMPLES] {
    core::array::from_fn(|i| [(i % 8) as f32 / 2.0, (i / 8) as f32 / 2.0])
}

/// 3 + 2x − y
fn plane([x, y]: [f32; 2]) -> f32 {
    3.0 + 2.0 * x - y
}

fn kernel() -> KernelInfluence<f32, 2, WendlandC2> {
    KernelInfluence::new(1.25).unwrap()
}

fn near(found: &[f32], expected: &[f32], tolerance: f32) -> bool {
    found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance)
}

#[defmt_test::tests]
mod tests {
    use super::*;
    use defmt::{assert, assert_eq, unwrap};

    #[test]
    fn a_uniform_lattice_has_its_density() {
        let positions = lattice();
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(2.5)).unwrap();
        let mut density = [0.0; SAMPLES];
        sources.density(&kernel(), &mut density).unwrap();
        assert!((density[CENTRE] - 10.0).abs() < 0.2, "{}", density[CENTRE]);
        let (same, gradient) = sources.density_gradient_at(&kernel(), &positions[CENTRE]);
        assert_eq!(same, density[CENTRE]);
        assert!(near(&gradient, &[0.0, 0.0], 1e-4));
        let scatter = PerSampleInfluence::<f32, 2, WendlandC2>::new(&[1.25; SAMPLES]).unwrap();
        assert_eq!(sources.density_at(scatter, &positions[CENTRE]), density[CENTRE]);
    }

    #[test]
    fn shepard_is_exact_for_constants_and_least_squares_for_planes() {
        let positions = lattice();
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), VOLUME).unwrap();
        let constant = Field::new(&sources, Uniform(7.0)).unwrap();
        assert!((unwrap!(constant.shepard_at::<f32>(&kernel(), &[0.1, 0.3])) - 7.0).abs() < 1e-5);
        assert!(constant.shepard_at::<f32>(&kernel(), &[90.0, 0.0]).is_none());
        let values = positions.map(plane);
        let x = [0.3, 1.9];
        let fit = unwrap!(Field::new(&sources, &values).unwrap().corrected_at(&kernel(), &x));
        assert!(near(&[fit.value], &[plane(x)], 1e-4) && near(&fit.gradient, &[2.0, -1.0], 1e-3));
    }

    #[test]
    fn the_analytic_gradient_is_the_numeric_one() {
        let positions = lattice().map(|x| x.map(f64::from));
        let values = lattice().map(|x| f64::from(plane(x) * plane(x)));
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(0.25)).unwrap();
        let field = Field::new(&sources, &values).unwrap();
        let w = KernelInfluence::<f64, 2, CubicSpline>::new(1.25).unwrap();
        let x = [1.3, 1.9];
        let numeric = difference::gradient(|x| field.interpolate_at(&w, x), &x, 1e-5);
        let (value, analytic) = field.interpolate_with_gradient_at(&w, &x);
        assert_eq!(value, field.interpolate_at::<f64>(&w, &x));
        assert!((analytic[0] - numeric[0]).abs() < 1e-5 && (analytic[1] - numeric[1]).abs() < 1e-5);
    }

    #[test]
    fn gradients_at_samples_recover_a_plane() {
        let positions = lattice();
        let values = positions.map(plane);
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), VOLUME).unwrap();
        let field = Field::new(&sources, &values).unwrap();
        let corrected = unwrap!(field.corrected_gradient(&kernel(), 0));
        assert!(near(&corrected, &[2.0, -1.0], 1e-3));
        let difference = unwrap!(field.difference_gradient(&kernel(), CENTRE));
        assert!(near(&difference, &[2.0, -1.0], 0.2));
        let symmetric = unwrap!(field.symmetric_gradient(&kernel(), Uniform(1.0), CENTRE));
        assert!(near(&symmetric, &[2.0, -1.0], 0.2));
        assert!(field.difference_gradient(&kernel(), SAMPLES).is_none());
    }

    #[test]
    fn rotation_has_curl_and_no_divergence() {
        let positions = lattice();
        let velocity = positions.map(|[x, y]| [-y, x]);
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), VOLUME).unwrap();
        let jacobian = unwrap!(Field::new(&sources, &velocity).unwrap().jacobian::<2>(&kernel(), CENTRE));
        assert!(near(&[field::divergence(&jacobian), field::curl_2d(&jacobian)], &[0.0, 2.0], 0.1));
    }

    #[test]
    fn the_laplacian_of_a_square_is_four() {
        let positions = lattice();
        let values = positions.map(|[x, y]| x * x + y * y);
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), VOLUME).unwrap();
        let field = Field::new(&sources, &values).unwrap();
        let laplacian = unwrap!(field.laplacian::<f32>(&kernel(), CENTRE));
        assert!((laplacian - 4.0).abs() < 0.4, "{}", laplacian);
        assert_eq!(unwrap!(field.diffusion::<f32>(&kernel(), Uniform(1.0), CENTRE)), laplacian);
    }

    #[test]
    fn lengths_and_weights_are_checked() {
        let positions = lattice();
        let search = BruteForce::new(&positions).unwrap();
        let (parameter, expected, found) = (Parameter::Mass, SAMPLES, 3);
        let refused = Sources::new(search, &[1.0; 3]).err();
        assert_eq!(refused, Some(Error::LengthMismatch { parameter, expected, found }));
        let refused = Sources::new(search, Uniform(0.0)).err();
        assert_eq!(refused, Some(Error::NotPositive { parameter, index: 0 }));
        let mut volumes = [0.0; 2];
        let parameter = Parameter::Density;
        let refused = field::volumes(Uniform(1.0), &[1.0, -1.0], &mut volumes);
        assert_eq!(refused, Err(Error::NotPositive { parameter, index: 1 }));
    }
}
