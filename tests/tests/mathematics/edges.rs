//! Edges: nobody in reach, exactly at h, one particle, bad numbers, too few directions, four dimensions.

use crate::assert_near;
use crate::cloud::jittered;
use sph_core::kernel::{CubicSpline, Poly6, WendlandC2};
use sph_core::{
    BruteForce, Error, Field, KernelInfluence, Neighbours, Parameter, PerSampleInfluence, Sources, Uniform,
    field,
};

type Cubic<const D: usize> = KernelInfluence<f64, D, CubicSpline>;

/// No sample in reach: sums are zero, quotients and fits None; no samples at all likewise.
#[test]
fn empty_neighbourhoods() {
    let w = Cubic::<2>::new(1.0).unwrap();
    let far = [[9.0, 9.0]];
    for positions in [far.as_slice(), &[]] {
        let sources = Sources::new(BruteForce::new(positions).unwrap(), Uniform(1.0)).unwrap();
        let values = vec![5.0; positions.len()];
        let field = Field::new(&sources, values.as_slice()).unwrap();
        let x = [0.0, 0.0];
        assert_eq!(sources.density_at(&w, &x), 0.0);
        assert_eq!(sources.density_gradient_at(&w, &x), (0.0, [0.0; 2]));
        assert_eq!(field.interpolate_at::<f64>(&w, &x), 0.0);
        assert_eq!(field.gradient_at(&w, &x), [0.0; 2]);
        assert_eq!(field.shepard_at::<f64>(&w, &x), None);
        assert_eq!(field.shepard_gradient_at(&w, &x), None);
        assert_eq!(field.corrected_at(&w, &x), None);
        assert_eq!(field.difference_gradient(&w, positions.len()), None);
        assert_eq!(field.corrected_gradient(&w, positions.len()), None);
        assert_eq!(field.laplacian::<f64>(&w, positions.len()), None);
    }
    let none = PerSampleInfluence::<f64, 2, CubicSpline>::new(&[]).unwrap();
    let sources = Sources::new(BruteForce::new(&[]).unwrap(), Uniform(1.0)).unwrap();
    assert_eq!(sources.density_at(none, &[0.0, 0.0]), 0.0);
    assert!(sources.linear_basis_at(none, &[0.0, 0.0]).is_none());
}

/// A sample exactly at h adds nothing to any sum, and one just inside adds a little: ω is continuous there.
#[test]
fn samples_exactly_at_the_support_radius() {
    for h in [0.37, 1.0, 2.9] {
        let w = KernelInfluence::<f64, 1, Poly6>::new(h).unwrap();
        for (place, expected) in [(h, 0), (-h, 0), (h.next_down(), 1), (h.next_up(), 0)] {
            let positions = [[place]];
            let search = BruteForce::new(&positions).unwrap();
            assert_eq!(search.count(&[0.0], h), expected);
            let sources = Sources::new(search, Uniform(1.0)).unwrap();
            assert!(sources.density_at(&w, &[0.0]) < 1e-40);
            assert_eq!(sources.density_at(&w, &[0.0]) > 0.0, expected == 1 && w_is_positive(h));
        }
    }
}

/// Whether (1 − s)³ is above zero for the s = r² / h² of the largest r < h, which may round to 1.
fn w_is_positive(h: f64) -> bool {
    let inverse = 1.0 / h;
    h.next_down() * h.next_down() * (inverse * inverse) < 1.0
}

/// One particle: ρ = m σ / h^D; no gradient, no Laplacian; no linear fit.
#[test]
fn one_particle() {
    let positions = [[0.5, 0.5, 0.5]];
    let sources = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(3.0)).unwrap();
    let field = Field::new(&sources, Uniform(2.0)).unwrap();
    let w = Cubic::<3>::new(0.5).unwrap();
    let at = &positions[0];
    assert_near(sources.density_at(&w, at) / (3.0 * 64.0 / core::f64::consts::PI), 1.0, 1e-14, "ρ");
    assert_eq!(field.gradient_at(&w, at), [0.0; 3]);
    assert_eq!(field.difference_gradient(&w, 0), Some([0.0; 3]));
    assert_eq!(field.symmetric_gradient(&w, Uniform(1.0), 0), Some([0.0; 3]));
    assert_eq!(field.laplacian::<f64>(&w, 0), Some(0.0));
    assert_eq!(field.shepard_at::<f64>(&w, at), Some(2.0));
    assert_eq!(field.corrected_gradient(&w, 0), None);
    assert_eq!(field.corrected_at(&w, at), None);
}

/// What is not a mass, a position, a density or a radius is an error with its index.
#[test]
fn bad_numbers_are_errors_with_their_index() {
    let positions = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    let search = BruteForce::new(&positions).unwrap();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = Sources::new(search, &[1.0, 2.0, bad]).err();
        assert_eq!(refused, Some(Error::NotFinite { parameter: Parameter::Mass, index: 2 }));
        let refused = BruteForce::new(&[[0.0, 0.0], [0.0, bad]]).err();
        assert_eq!(refused, Some(Error::NotFinite { parameter: Parameter::Position, index: 1 }));
        let refused = PerSampleInfluence::<f64, 2, CubicSpline>::new(&[1.0, bad]).err();
        assert_eq!(refused, Some(Error::NotFinite { parameter: Parameter::SupportRadius, index: 1 }));
        let refused = field::volumes(Uniform(1.0), &[1.0, bad], &mut [0.0; 2]).err();
        assert_eq!(refused, Some(Error::NotFinite { parameter: Parameter::Density, index: 1 }));
        assert!(Sources::new(search, Uniform(bad)).is_err());
        assert!(Cubic::<2>::new(bad).is_err());
    }
    for bad in [0.0, -0.0, -1.0] {
        let refused = Sources::new(search, &[1.0, bad, 1.0]).err();
        assert_eq!(refused, Some(Error::NotPositive { parameter: Parameter::Mass, index: 1 }));
        let refused = field::volumes(Uniform(1.0), &[bad], &mut [0.0]).err();
        assert_eq!(refused, Some(Error::NotPositive { parameter: Parameter::Density, index: 0 }));
    }
    let refused = Sources::new(search, &[1.0, 2.0]).err();
    assert_eq!(refused, Some(Error::LengthMismatch { parameter: Parameter::Mass, expected: 3, found: 2 }));
    let sources = Sources::new(search, Uniform(1.0)).unwrap();
    assert!(Field::new(&sources, &[1.0, 2.0]).is_err());
    assert!(sources.density(&Cubic::<2>::new(1.0).unwrap(), &mut [0.0; 2]).is_err());
}

/// Σ V ∇W ⊗ x and the moments are singular for neighbours on a line, in whatever direction, and for too few: None, no noise.
#[test]
fn too_few_directions_have_no_linear_fit() {
    let w = Cubic::<2>::new(1.0).unwrap();
    for direction in [[1.0, 0.0], [0.6, 0.8], [0.3, 0.1], [-0.123, 0.987]] {
        let positions: Vec<[f64; 2]> =
            (0..7).map(|k| direction.map(|c: f64| 0.7 + c * 0.21 * k as f64)).collect();
        let values: Vec<f64> = positions.iter().map(|x| 1.0 + x[0] - 3.0 * x[1]).collect();
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(0.1)).unwrap();
        let field = Field::new(&sources, values.as_slice()).unwrap();
        for (i, x) in positions.iter().enumerate() {
            assert!(sources.linear_basis_at(&w, x).is_none(), "{direction:?}");
            assert_eq!(field.corrected_at(&w, x), None, "{direction:?}");
            assert_eq!(field.corrected_gradient(&w, i), None, "{direction:?}");
        }
    }
    let two = [[0.0, 0.0], [0.31, 0.17]];
    let sources = Sources::new(BruteForce::new(&two).unwrap(), Uniform(0.1)).unwrap();
    assert!(sources.linear_basis_at(&w, &[0.1, 0.1]).is_none());
    assert_eq!(Field::new(&sources, &[1.0, 2.0]).unwrap().corrected_gradient(&w, 0), None);
}

/// Samples in a plane of three dimensions have no linear fit either; one sample above it gives one.
#[test]
fn a_plane_of_samples_in_3d_has_no_linear_fit_until_one_leaves_it() {
    let w = Cubic::<3>::new(0.6).unwrap();
    let mut positions: Vec<[f64; 3]> =
        jittered::<2>(6, 0.2, 3).into_iter().map(|[x, y]| [x, y, 0.3 * x - 0.45 * y]).collect();
    let centre = positions[14];
    let basis = |positions: &[[f64; 3]]| {
        let sources = Sources::new(BruteForce::new(positions).unwrap(), Uniform(0.1)).unwrap();
        let field = Field::new(&sources, Uniform(1.0)).unwrap();
        (sources.linear_basis_at(&w, &centre).is_some(), field.corrected_gradient(&w, 14).is_some())
    };
    assert_eq!(basis(&positions), (false, false));
    positions.push([centre[0], centre[1], centre[2] + 0.2]);
    assert_eq!(basis(&positions), (true, true));
}

/// D = 4: a lattice gives its density, and linear fields are exact.
#[test]
fn four_dimensions() {
    let count = 6;
    let h = 3.0 / count as f64;
    let positions = jittered::<4>(count, 0.1, 31);
    let plane = |x: &[f64; 4]| 1.0 + x[0] - 2.0 * x[1] + 3.0 * x[2] - 4.0 * x[3];
    let values: Vec<f64> = positions.iter().map(plane).collect();
    let sources =
        Sources::new(BruteForce::new(&positions).unwrap(), Uniform((count as f64).powi(-4))).unwrap();
    let field = Field::new(&sources, values.as_slice()).unwrap();
    let w = KernelInfluence::<f64, 4, WendlandC2>::new(h).unwrap();
    let x = [0.5, 0.45, 0.55, 0.5];
    assert_near(sources.density_at(&w, &x), 1.0, 0.05, "ρ");
    let fit = field.corrected_at(&w, &x).unwrap();
    assert_near(fit.value, plane(&x), 1e-11, "A");
    for (axis, slope) in [1.0, -2.0, 3.0, -4.0].into_iter().enumerate() {
        assert_near(fit.gradient[axis], slope, 1e-10, "∇A by moving least squares");
        assert_near(field.corrected_gradient(&w, 0).unwrap()[axis], slope, 1e-10, "∇A, corrected");
    }
}
