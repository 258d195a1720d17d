//! Thm 3.2: ρ(x) = Σ m_j Ω(x − x_j), self included.

use crate::cloud::{Grid, Random, jittered};
use crate::{assert_near, each_kernel, name};
use sph_core::kernel::{CubicSpline, Kernel, WendlandC2};
use sph_core::{BruteForce, KernelInfluence, Sources, Uniform};

/// Error of ρ on a uniform periodic lattice at a sample and half-way between samples, for h/Δx = `ratio`.
fn lattice_errors<K: Kernel, const D: usize>(ratio: f64) -> [f64; 2] {
    let count = 12;
    let h = ratio / count as f64;
    let mut grid = Grid::new(jittered::<D>(count, 0.0, 1), h, true);
    let rest = 1000.0;
    let mass = rest / (count as f64).powi(D as i32);
    let sources = Sources::new(grid.search().unwrap(), Uniform(mass)).unwrap();
    let w = KernelInfluence::<f64, D, K>::new(h).unwrap();
    let sample = sources.positions()[count / 2];
    let between = sample.map(|c| c + 0.5 / count as f64);
    [sample, between].map(|x| sources.density_at(&w, &x) / rest - 1.0)
}

/// The lattice's error for h/Δx = 2, 3.5 and 5 in D = 1, 2, 3: at most 20 %, 0.3 % and 0.1 %, but for spiky's cusp.
#[test]
fn uniform_lattices_give_their_density() {
    fn check<K: Kernel, const D: usize>() {
        let tolerances = if name::<K>() == "Spiky" { [0.3, 0.1, 0.05] } else { [0.2, 3e-3, 1e-3] };
        for (ratio, tolerance) in [2.0, 3.5, 5.0].into_iter().zip(tolerances) {
            for error in lattice_errors::<K, D>(ratio) {
                assert_near(error, 0.0, tolerance, &format!("{}, D = {D}, h/Δx = {ratio}", name::<K>()));
            }
        }
    }
    each_kernel!(K => { check::<K, 1>(); check::<K, 2>(); check::<K, 3>(); });
}

/// M₄ at h = 2 Δx is a B-spline of the lattice: a partition of unity, exact in one dimension.
#[test]
fn the_cubic_spline_is_a_partition_of_unity_in_1d() {
    for error in lattice_errors::<CubicSpline, 1>(2.0) {
        assert_near(error, 0.0, 1e-14, "ρ/ρ₀ − 1");
    }
}

/// Self included: a sample alone has ρ = m Ω(0), and ρ_i − m_i Ω(0) is the sum over the others.
#[test]
fn the_sample_itself_counts_once() {
    let w = KernelInfluence::<f64, 3, WendlandC2>::new(0.4).unwrap();
    let own = 2.0 * 21.0 / (2.0 * core::f64::consts::PI) / 0.4_f64.powi(3);
    let alone = [[0.3, 0.1, 0.9]];
    let sources = Sources::new(BruteForce::new(&alone).unwrap(), Uniform(2.0)).unwrap();
    assert_near(sources.density_at(&w, &alone[0]) / own, 1.0, 1e-15, "alone");
    let positions = jittered::<3>(5, 0.3, 2);
    let others = &positions[1..];
    let all = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(2.0)).unwrap();
    let rest = Sources::new(BruteForce::new(others).unwrap(), Uniform(2.0)).unwrap();
    let difference = all.density_at(&w, &positions[0]) - rest.density_at(&w, &positions[0]);
    assert_near(difference / own, 1.0, 1e-14, "ρ with self less ρ without");
}

/// ∫ ρ d^Dx is the mass, whatever the samples: by a fine sum over a periodic square.
#[test]
fn density_integrates_to_the_mass() {
    let mut random = Random(17);
    let positions: Vec<[f64; 2]> = (0..40).map(|_| random.point(0.0, 1.0)).collect();
    let masses: Vec<f64> = (0..40).map(|_| 0.1 + random.unit()).collect();
    let mut grid = Grid::new(positions, 0.2, true);
    let sources = Sources::new(grid.search().unwrap(), masses.as_slice()).unwrap();
    let w = KernelInfluence::<f64, 2, WendlandC2>::new(0.2).unwrap();
    let side = 200;
    let mut integral = 0.0;
    for x in jittered::<2>(side, 0.0, 1) {
        integral += sources.density_at(&w, &x) / (side * side) as f64;
    }
    assert_near(integral / masses.iter().sum::<f64>(), 1.0, 1e-6, "∫ ρ / Σ m");
}
