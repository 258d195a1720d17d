//! Jacobian, divergence, curl, Laplacian and diffusion of fields whose derivatives are known.

use crate::assert_near;
use crate::cloud::{Grid, Random, jittered};
use sph_core::kernel::{CubicSpline, WendlandC4};
use sph_core::vector::{dot, norm_squared, sub};
use sph_core::{BruteForce, Field, Influence, KernelInfluence, Sources, Uniform, field};

/// Whether a sample is at least `margin` away from the walls of [0, 1]^D.
fn is_inside<const D: usize>(x: &[f64; D], margin: f64) -> bool {
    x.iter().all(|c| (margin..1.0 - margin).contains(c))
}

/// J = M for A = M x in two dimensions: every entry in its place and of its sign, to the lattice's error of 0.5 %.
#[test]
fn jacobian_of_a_linear_field_in_2d() {
    let matrix = [[0.3, -1.0], [2.0, 0.7]];
    let (count, h) = (40, 3.5 / 40.0);
    let mut grid = Grid::new(jittered::<2>(count, 0.0, 1), h, false);
    let velocity: Vec<[f64; 2]> = grid.positions.iter().map(|x| matrix.map(|row| dot(&row, x))).collect();
    let sources = Sources::new(grid.search().unwrap(), Uniform(1.0 / 1600.0)).unwrap();
    let w = KernelInfluence::<f64, 2, WendlandC4>::new(h).unwrap();
    let vectors = Field::new(&sources, velocity.as_slice()).unwrap();
    let mut seen = 0;
    for i in (0..velocity.len()).filter(|&i| is_inside(&sources.positions()[i], h)) {
        let jacobian: [[f64; 2]; 2] = vectors.jacobian(&w, i).unwrap();
        for a in 0..2 {
            for b in 0..2 {
                assert_near(jacobian[a][b], matrix[a][b], 5e-3, &format!("J[{a}][{b}]"));
            }
        }
        assert_near(field::divergence(&jacobian), 1.0, 5e-3, "div A = ∂A_x/∂x + ∂A_y/∂y");
        assert_near(field::curl_2d(&jacobian), 3.0, 1e-2, "curl A = ∂A_y/∂x − ∂A_x/∂y");
        seen += 1;
    }
    assert!(seen > 500);
}

/// curl (ω × x) = 2ω and div = 0 for a rigid rotation; div (x, 2y, −5z) = −2 and curl = 0; in three dimensions.
#[test]
fn curl_and_divergence_in_3d() {
    let (count, h) = (14, 3.5 / 14.0);
    let omega = [0.3, -0.7, 1.1];
    let rotation = |x: &[f64; 3]| {
        [
            omega[1] * x[2] - omega[2] * x[1],
            omega[2] * x[0] - omega[0] * x[2],
            omega[0] * x[1] - omega[1] * x[0],
        ]
    };
    let strain = |x: &[f64; 3]| [x[0], 2.0 * x[1], -5.0 * x[2]];
    let mut grid = Grid::new(jittered::<3>(count, 0.0, 1), h, false);
    let rotating: Vec<[f64; 3]> = grid.positions.iter().map(rotation).collect();
    let straining: Vec<[f64; 3]> = grid.positions.iter().map(strain).collect();
    let sources = Sources::new(grid.search().unwrap(), Uniform((count as f64).powi(-3))).unwrap();
    let w = KernelInfluence::<f64, 3, WendlandC4>::new(h).unwrap();
    let [rotating, straining] = [&rotating, &straining].map(|v| Field::new(&sources, v.as_slice()).unwrap());
    let mut seen = 0;
    for i in (0..count.pow(3)).filter(|&i| is_inside(&sources.positions()[i], h)) {
        let jacobian = rotating.jacobian(&w, i).unwrap();
        let curl = field::curl(&jacobian);
        for axis in 0..3 {
            assert_near(curl[axis], 2.0 * omega[axis], 2e-2, "curl of a rotation");
        }
        assert_near(field::divergence(&jacobian), 0.0, 1e-11, "divergence of a rotation");
        let jacobian = straining.jacobian(&w, i).unwrap();
        assert_near(field::divergence(&jacobian), -2.0, 2e-2, "divergence of a strain");
        assert!(field::curl(&jacobian).iter().all(|c| c.abs() < 1e-11));
        seen += 1;
    }
    assert!(seen > 100);
}

/// ∇²(x² + y²) = 4 and ∇²(x² + y² + z²) = 6 inside, ∇² of a linear field 0.
#[test]
fn laplacian_of_squares() {
    fn check<const D: usize>(count: usize, jitter: f64, tolerance: f64) {
        let h = 4.0 / count as f64;
        let mut grid = Grid::new(jittered::<D>(count, jitter, 1), h, false);
        let squares: Vec<f64> = grid.positions.iter().map(norm_squared).collect();
        let linear: Vec<f64> = grid.positions.iter().map(|x| 5.0 * x[0]).collect();
        let sources =
            Sources::new(grid.search().unwrap(), Uniform((count as f64).powi(-(D as i32)))).unwrap();
        let w = KernelInfluence::<f64, D, WendlandC4>::new(h).unwrap();
        let [squares, linear] = [&squares, &linear].map(|v| Field::new(&sources, v.as_slice()).unwrap());
        let inside: Vec<usize> =
            (0..count.pow(D as u32)).filter(|&i| is_inside(&sources.positions()[i], h)).collect();
        let (mut sum, mut worst) = (0.0, 0.0_f64);
        for &i in &inside {
            let found = squares.laplacian::<f64>(&w, i).unwrap();
            sum += found;
            worst = worst.max((found / (2 * D) as f64 - 1.0).abs());
            if jitter == 0.0 {
                assert_near(linear.laplacian(&w, i).unwrap(), 0.0, 1e-9, "∇² of a plane");
            }
        }
        assert!(worst <= tolerance, "D = {D}, jitter {jitter}: worst {worst:e}");
        assert_near(sum / inside.len() as f64, (2 * D) as f64, 0.02 * D as f64, "mean");
    }
    check::<1>(100, 0.0, 1e-2);
    check::<2>(40, 0.0, 1e-2);
    check::<3>(14, 0.0, 1e-2);
    check::<2>(40, 0.02, 0.5);
}

/// ∇·(μ∇A) = 2y for μ = 1 + y, A = x² + y²: 4μ + 2y ∂μ/∂y = 4 + 6y; and of μ = 3, A = x²: 6.
#[test]
fn diffusion_with_a_coefficient_that_varies() {
    let (count, h) = (60, 4.0 / 60.0);
    let mut grid = Grid::new(jittered::<2>(count, 0.0, 1), h, false);
    let values: Vec<f64> = grid.positions.iter().map(norm_squared).collect();
    let coefficient: Vec<f64> = grid.positions.iter().map(|x| 1.0 + x[1]).collect();
    let sources = Sources::new(grid.search().unwrap(), Uniform(1.0 / 3600.0)).unwrap();
    let w = KernelInfluence::<f64, 2, WendlandC4>::new(h).unwrap();
    let scalars = Field::new(&sources, values.as_slice()).unwrap();
    let mut seen = 0;
    for i in (0..values.len()).filter(|&i| is_inside(&sources.positions()[i], h)) {
        let y = sources.positions()[i][1];
        let found: f64 = scalars.diffusion(&w, coefficient.as_slice(), i).unwrap();
        assert_near(found / (4.0 + 6.0 * y), 1.0, 1e-2, "∇·(μ∇A)");
        let tripled: f64 = scalars.diffusion(&w, Uniform(3.0), i).unwrap();
        assert_near(tripled, 3.0 * scalars.laplacian::<f64>(&w, i).unwrap(), 1e-9, "3 ∇²A");
        seen += 1;
    }
    assert!(seen > 1000);
}

/// Σ V_j (μ_i + μ_j) (A_i − A_j) x_ij·∇W_ij / r² and Σ V_j (A_j − A_i) ⊗ ∇W_ij by explicit sums over all pairs.
#[test]
fn operators_are_their_sums_over_pairs() {
    let positions = jittered::<3>(4, 0.3, 22);
    let mut random = Random(23);
    let velocity: Vec<[f64; 2]> = positions.iter().map(|_| random.point(-1.0, 1.0)).collect();
    let mu: Vec<f64> = positions.iter().map(|_| 0.5 + random.unit()).collect();
    let volumes: Vec<f64> = positions.iter().map(|_| 0.5 + random.unit()).collect();
    let sources = Sources::new(BruteForce::new(&positions).unwrap(), volumes.as_slice()).unwrap();
    let w = KernelInfluence::<f64, 3, CubicSpline>::new(0.6).unwrap();
    let vectors = Field::new(&sources, velocity.as_slice()).unwrap();
    for i in 0..positions.len() {
        let (mut diffusion, mut jacobian) = ([0.0; 2], [[0.0; 3]; 2]);
        for j in (0..positions.len()).filter(|&j| j != i) {
            let offset = sub(&positions[i], &positions[j]);
            let slope = w.gradient_at(&offset);
            for c in 0..2 {
                let change = velocity[j][c] - velocity[i][c];
                diffusion[c] -=
                    volumes[j] * (mu[i] + mu[j]) * change * dot(&offset, &slope) / norm_squared(&offset);
                for axis in 0..3 {
                    jacobian[c][axis] += volumes[j] * change * slope[axis];
                }
            }
        }
        let found: [f64; 2] = vectors.diffusion(&w, mu.as_slice(), i).unwrap();
        let found_jacobian: [[f64; 3]; 2] = vectors.jacobian(&w, i).unwrap();
        for c in 0..2 {
            assert_near(found[c], diffusion[c], 1e-9, "∇·(μ∇A)");
            for axis in 0..3 {
                assert_near(found_jacobian[c][axis], jacobian[c][axis], 1e-10, "J");
            }
        }
    }
}
