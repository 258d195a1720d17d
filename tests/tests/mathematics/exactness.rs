//! What must hold to rounding on any set of samples: Def. 3.1, Thm 3.3 and the corrected forms.

use crate::cloud::{Grid, Random, jittered};
use crate::{assert_near, each_kernel, name};
use sph_core::kernel::{CubicSpline, Kernel, Poly6, WendlandC2};
use sph_core::vector::{norm_squared, sub};
use sph_core::{
    BruteForce, Field, Influence, KernelInfluence, PerSampleInfluence, Sources, Uniform, difference, field,
};

/// Samples per axis, and the support radius for h/Δx = 2.6.
fn resolution<const D: usize>() -> (usize, f64) {
    let count = [0, 60, 20, 9][D];
    (count, 2.6 / count as f64)
}

/// A(x) = 3 − 2 x₀ + 0.5 x₁ + 1.5 x₂ and its slope.
fn plane<const D: usize>(x: &[f64; D]) -> f64 {
    3.0 + x.iter().zip(SLOPE).map(|(x, slope)| x * slope).sum::<f64>()
}

const SLOPE: [f64; 3] = [-2.0, 0.5, 1.5];

/// A smooth field that is no polynomial.
fn wave<const D: usize>(x: &[f64; D]) -> f64 {
    x.iter().enumerate().map(|(axis, x)| (3.0 * x + axis as f64).sin()).product()
}

/// Moving least squares and corrected gradients are exact for linear A to 1e-10, up to and beyond the outermost samples;
/// Shepard's form is exact for constants.
#[test]
fn corrected_forms_are_exact_for_linear_fields() {
    fn check<K: Kernel, const D: usize>() {
        let (count, h) = resolution::<D>();
        let mut grid = Grid::new(jittered::<D>(count, 0.3, 7), h, false);
        let values: Vec<f64> = grid.positions.iter().map(plane).collect();
        let volumes: Vec<f64> = {
            let mut random = Random(11);
            values.iter().map(|_| (0.5 + random.unit()) / (count as f64).powi(D as i32)).collect()
        };
        let sources = Sources::new(grid.search().unwrap(), volumes.as_slice()).unwrap();
        let w = KernelInfluence::<f64, D, K>::new(h).unwrap();
        let planar = Field::new(&sources, values.as_slice()).unwrap();
        let constant = Field::new(&sources, Uniform(0.7)).unwrap();
        let mut random = Random(5);
        for _ in 0..200 {
            let x = random.point(0.0, 1.0);
            let fit = planar.corrected_at(&w, &x).expect("enough neighbours");
            assert_near(fit.value, plane(&x), 1e-10, name::<K>());
            for axis in 0..D {
                assert_near(fit.gradient[axis], SLOPE[axis], 1e-10, name::<K>());
            }
            assert_near(constant.shepard_at::<f64>(&w, &x).unwrap(), 0.7, 1e-14, name::<K>());
            let (value, slope) = constant.shepard_gradient_at(&w, &x).unwrap();
            assert_near(value, 0.7, 1e-14, name::<K>());
            assert!(slope.iter().all(|s| s.abs() < 1e-11), "{}: {slope:?}", name::<K>());
        }
        for i in 0..values.len() {
            let slope = planar.corrected_gradient(&w, i).expect("enough neighbours");
            for axis in 0..D {
                assert_near(slope[axis], SLOPE[axis], 1e-10, name::<K>());
            }
        }
    }
    each_kernel!(K => { check::<K, 1>(); check::<K, 2>(); check::<K, 3>(); });
}

/// Thm 3.3 = Thm 4.1 applied to A(x) of Def. 3.1, within 1e-7 at points at random; Shepard's gradient likewise.
#[test]
fn analytic_gradients_of_interpolants_equal_central_differences() {
    fn check<K: Kernel, const D: usize>() {
        let (count, h) = resolution::<D>();
        let mut grid = Grid::new(jittered::<D>(count, 0.3, 8), h, false);
        let values: Vec<f64> = grid.positions.iter().map(wave).collect();
        let volume = (count as f64).powi(-(D as i32));
        let sources = Sources::new(grid.search().unwrap(), Uniform(volume)).unwrap();
        let w = KernelInfluence::<f64, D, K>::new(h).unwrap();
        let field = Field::new(&sources, values.as_slice()).unwrap();
        let mut random = Random(6);
        for _ in 0..50 {
            let x = random.point(0.0, 1.0);
            let analytic = field.gradient_at(&w, &x);
            let numeric = difference::gradient(|x| field.interpolate_at(&w, x), &x, 2e-7);
            let (value, together) = field.interpolate_with_gradient_at(&w, &x);
            assert_near(value, field.interpolate_at(&w, &x), 1e-14, name::<K>());
            let (_, shepard) = field.shepard_gradient_at(&w, &x).unwrap();
            let shepard_numeric =
                difference::gradient(|x| field.shepard_at(&w, x).unwrap_or(f64::NAN), &x, 2e-7);
            let (_, density) = sources.density_gradient_at(&w, &x);
            let density_numeric = difference::gradient(|x| sources.density_at(&w, x), &x, 2e-7);
            for axis in 0..D {
                assert_near(analytic[axis], numeric[axis], 1e-7, name::<K>());
                assert_near(together[axis], analytic[axis], 1e-12, name::<K>());
                assert_near(shepard[axis], shepard_numeric[axis], 1e-7, name::<K>());
                assert_near(density[axis], density_numeric[axis], 1e-7, name::<K>());
            }
        }
    }
    each_kernel!(K => { check::<K, 1>(); check::<K, 2>(); check::<K, 3>(); });
}

/// Difference form: zero for constants. Symmetric form: Σ_i V_i ∇A_i = 0, the pair forces being opposite.
#[test]
fn difference_form_ends_constants_and_symmetric_form_conserves() {
    let (count, h) = resolution::<2>();
    let mut grid = Grid::new(jittered::<2>(count, 0.3, 9), h, false);
    let pressure: Vec<f64> = grid.positions.iter().map(|x| 2.0 + wave(x)).collect();
    let mass = Uniform((count as f64).powi(-2) * 1.3);
    let w = KernelInfluence::<f64, 2, CubicSpline>::new(h).unwrap();
    let search = grid.search().unwrap();
    let mut density = vec![0.0; pressure.len()];
    Sources::new(&search, mass).unwrap().density(&w, &mut density).unwrap();
    let mut volumes = vec![0.0; pressure.len()];
    field::volumes(mass, &density, &mut volumes).unwrap();
    let sources = Sources::new(&search, volumes.as_slice()).unwrap();
    let field = Field::new(&sources, pressure.as_slice()).unwrap();
    let constant = Field::new(&sources, Uniform(2.7)).unwrap();
    let (mut total, mut largest, mut plain) = ([0.0; 2], 0.0_f64, [0.0; 2]);
    for i in 0..pressure.len() {
        assert_eq!(constant.difference_gradient(&w, i), Some([0.0; 2]));
        let slope = field.symmetric_gradient(&w, density.as_slice(), i).unwrap();
        let other = field.difference_gradient(&w, i).unwrap();
        for axis in 0..2 {
            total[axis] += volumes[i] * slope[axis];
            largest = largest.max((volumes[i] * slope[axis]).abs());
            plain[axis] += volumes[i] * other[axis];
        }
    }
    assert!(total.iter().all(|t| t.abs() < 1e-13 * largest * pressure.len() as f64), "{total:?}");
    assert!(
        plain.iter().any(|t| t.abs() > 1e-3 * largest),
        "the difference form does not conserve: {plain:?}"
    );
}

/// ρ_i Σ m_j (A_i/ρ_i² + A_j/ρ_j²) ∇W_ij by an explicit sum over all pairs.
#[test]
fn symmetric_form_is_its_sum_over_pairs() {
    let positions = jittered::<3>(4, 0.3, 21);
    let mut random = Random(3);
    let values: Vec<f64> = positions.iter().map(|_| random.unit()).collect();
    let density: Vec<f64> = positions.iter().map(|_| 0.5 + random.unit()).collect();
    let masses: Vec<f64> = positions.iter().map(|_| 0.5 + random.unit()).collect();
    let volumes: Vec<f64> = masses.iter().zip(&density).map(|(m, rho)| m / rho).collect();
    let sources = Sources::new(BruteForce::new(&positions).unwrap(), volumes.as_slice()).unwrap();
    let w = KernelInfluence::<f64, 3, CubicSpline>::new(0.6).unwrap();
    let field = Field::new(&sources, values.as_slice()).unwrap();
    for i in 0..positions.len() {
        let mut sum = [0.0; 3];
        for j in 0..positions.len() {
            let slope = w.gradient_at(&sub(&positions[i], &positions[j]));
            let pair = values[i] / density[i].powi(2) + values[j] / density[j].powi(2);
            for axis in 0..3 {
                sum[axis] += density[i] * masses[j] * pair * slope[axis];
            }
        }
        let found = field.symmetric_gradient(&w, density.as_slice(), i).unwrap();
        for axis in 0..3 {
            assert_near(found[axis], sum[axis], 1e-11, "∇A_i");
        }
    }
}

/// Def. 3.1 of vectors: each component as if it were a scalar, to the bit; Shepard's form too.
#[test]
fn vectors_interpolate_as_their_components_do() {
    let positions = jittered::<2>(8, 0.3, 4);
    let velocity: Vec<[f64; 2]> = positions.iter().map(|x| [wave(x), plane(x)]).collect();
    let sources = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(1.0 / 64.0)).unwrap();
    let w = KernelInfluence::<f64, 2, WendlandC2>::new(0.4).unwrap();
    let vectors = Field::new(&sources, velocity.as_slice()).unwrap();
    for axis in 0..2 {
        let component: Vec<f64> = velocity.iter().map(|v| v[axis]).collect();
        let scalars = Field::new(&sources, component.as_slice()).unwrap();
        for x in [[0.3, 0.4], [0.0, 1.0], [0.77, 0.5]] {
            let [a, b]: [[f64; 2]; 2] = [vectors.interpolate_at(&w, &x), vectors.shepard_at(&w, &x).unwrap()];
            let [c, d]: [f64; 2] = [scalars.interpolate_at(&w, &x), scalars.shepard_at(&w, &x).unwrap()];
            assert_eq!([a[axis], b[axis]], [c, d]);
        }
    }
}

/// Scatter: Σ m_j W(x − x_j, h_j) with a support of its own for each sample, by an explicit sum.
#[test]
fn supports_per_sample_equal_the_explicit_sum() {
    let positions = jittered::<3>(5, 0.3, 12);
    let mut random = Random(13);
    let radii: Vec<f64> = positions.iter().map(|_| 0.2 + 0.5 * random.unit()).collect();
    let masses: Vec<f64> = positions.iter().map(|_| 0.5 + random.unit()).collect();
    let values: Vec<f64> = positions.iter().map(wave).collect();
    let sources = Sources::new(BruteForce::new(&positions).unwrap(), masses.as_slice()).unwrap();
    let field = Field::new(&sources, values.as_slice()).unwrap();
    let w = PerSampleInfluence::<f64, 3, Poly6>::new(&radii).unwrap();
    for _ in 0..50 {
        let x = random.point(0.0, 1.0);
        let (mut density, mut value, mut slope) = (0.0, 0.0, [0.0; 3]);
        for j in 0..positions.len() {
            let own = KernelInfluence::<f64, 3, Poly6>::new(radii[j]).unwrap();
            let offset = sub(&x, &positions[j]);
            density += masses[j] * own.influence(norm_squared(&offset));
            value += masses[j] * values[j] * own.influence(norm_squared(&offset));
            let gradient = own.gradient_at(&offset);
            for axis in 0..3 {
                slope[axis] += masses[j] * values[j] * gradient[axis];
            }
        }
        assert_near(sources.density_at(w, &x) / density, 1.0, 1e-13, "ρ");
        assert_near(field.interpolate_at(w, &x), value, 1e-13 * density, "A");
        let found = field.gradient_at(w, &x);
        for axis in 0..3 {
            assert_near(found[axis], slope[axis], 1e-11 * density, "∇A");
        }
        let planar: Vec<f64> = positions.iter().map(plane).collect();
        let fit = Field::new(&sources, planar.as_slice()).unwrap().corrected_at(w, &x).unwrap();
        assert_near(fit.value, plane(&x), 1e-10, "a plane with supports of many widths");
    }
}

/// Erratum: Def. 3.1 with ρ of Thm 3.2 is the same under the printed V and the correct one; ρ itself is not.
#[test]
fn printed_volume_cancels_in_interpolation_and_not_in_density() {
    let positions = jittered::<2>(10, 0.3, 14);
    let values: Vec<f64> = positions.iter().map(wave).collect();
    let correct = KernelInfluence::<f64, 2, Poly6>::new(0.3).unwrap();
    let printed = KernelInfluence::<f64, 2, Poly6>::with_printed_volume(0.3).unwrap();
    let search = BruteForce::new(&positions).unwrap();
    let at = |w: &KernelInfluence<f64, 2, Poly6>, x: &[f64; 2]| {
        let mass = Uniform(0.01);
        let (mut density, mut volumes) = (vec![0.0; values.len()], vec![0.0; values.len()]);
        Sources::new(search, mass).unwrap().density(w, &mut density).unwrap();
        field::volumes(mass, &density, &mut volumes).unwrap();
        let sources = Sources::new(search, volumes.as_slice()).unwrap();
        let value: f64 = Field::new(&sources, values.as_slice()).unwrap().interpolate_at(w, x);
        (value, density[37])
    };
    for x in [[0.5, 0.5], [0.1, 0.93]] {
        let ((a, rho), (b, printed_rho)) = (at(&correct, &x), at(&printed, &x));
        assert_near(a, b, 1e-14, "A");
        // V_shell / V_printed = (π h⁸/4) / (16 π h⁹/315) = 315 / (64 h)
        assert_near(printed_rho / rho / (315.0 / (64.0 * 0.3)), 1.0, 1e-13, "ρ");
    }
}
