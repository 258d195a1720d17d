//! Densities at the particles.

use proptest::prelude::*;
use sph_core::kernel::{CubicSpline, Kernel, Poly6, Spiky, WendlandC2, WendlandC6};
use sph_core::{BruteForce, Error, KernelInfluence, Parameter, Sources, Uniform};
use sph_host::fast::{InstructionSet, Real, SortedCells};

use crate::cloud::{Cloud, Random, agree, clouds, lattice};

/// Densities by sph-core's sums in f64 over the same positions.
fn exact<T: Real, K: Kernel, const D: usize>(cloud: &Cloud<T, D>, masses: &[T]) -> Vec<f64> {
    let positions: Vec<[f64; D]> = cloud.positions.iter().map(|x| x.map(|c| c.to_f64())).collect();
    let masses: Vec<f64> = masses.iter().map(|m| m.to_f64()).collect();
    let sources = Sources::new(BruteForce::new(&positions).unwrap(), &masses[..]).unwrap();
    let w = KernelInfluence::<f64, D, K>::new(cloud.radius.to_f64()).unwrap();
    let mut density = vec![0.0; positions.len()];
    sources.density(&w, &mut density).unwrap();
    density
}

/// The fast densities agree with the exact ones, for equal masses and others, and all levels give the same bits.
fn check<T: Real, K: Kernel, const D: usize>(cloud: &Cloud<T, D>, tolerance: f64) {
    let mut random = Random(5);
    let own: Vec<T> = cloud.positions.iter().map(|_| T::from_f64(0.5 + random.next())).collect();
    let equal = vec![T::from_f64(0.3); own.len()];
    let cells = SortedCells::sort(&cloud.positions, cloud.radius).unwrap();
    let fast =
        (cells.density::<K>(Uniform(T::from_f64(0.3))).unwrap(), cells.density::<K>(&own[..]).unwrap());
    for (found, masses) in [(&fast.0, &equal), (&fast.1, &own)] {
        for (i, (&found, expected)) in found.iter().zip(exact::<T, K, D>(cloud, masses)).enumerate() {
            assert!(agree(found, expected, tolerance), "{i}: {found:?} {expected} {:?}", cloud.positions[i]);
        }
    }
    for level in InstructionSet::available() {
        let cells = cells.clone().at_level(level);
        assert!(cells.density::<K>(Uniform(T::from_f64(0.3))).unwrap() == fast.0, "{level:?}");
        assert!(cells.density::<K>(&own[..]).unwrap() == fast.1, "{level:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_set_in_f32(
        line in clouds::<f32, 1>(), plane in clouds::<f32, 2>(), space in clouds::<f32, 3>()
    ) {
        check::<_, CubicSpline, 1>(&line, 2e-6);
        check::<_, WendlandC2, 2>(&plane, 2e-6);
        check::<_, CubicSpline, 3>(&space, 2e-6);
    }

    #[test]
    fn any_set_in_f64(
        line in clouds::<f64, 1>(), plane in clouds::<f64, 2>(), space in clouds::<f64, 3>()
    ) {
        check::<_, WendlandC6, 1>(&line, 1e-13);
        check::<_, Spiky, 2>(&plane, 1e-13);
        check::<_, Poly6, 3>(&space, 1e-13);
    }
}

/// The bound that the documentation states: f32 within 1e-6 of sph-core's own f32 sums.
#[test]
fn a_lattice_in_f32_is_within_a_millionth_of_the_exact_path() {
    let cloud = lattice::<f32, 3>(22, 0.013, -0.1);
    let sources = Sources::new(BruteForce::new(&cloud.positions).unwrap(), Uniform(2.2e-3)).unwrap();
    let w = KernelInfluence::<f32, 3, CubicSpline>::new(cloud.radius).unwrap();
    let mut exact = vec![0.0; cloud.positions.len()];
    sources.density(&w, &mut exact).unwrap();
    let cells = SortedCells::sort(&cloud.positions, cloud.radius).unwrap();
    let fast = cells.density::<CubicSpline>(Uniform(2.2e-3)).unwrap();
    let worst = fast.iter().zip(&exact).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f32::max);
    assert!((1e-8..1e-6).contains(&worst), "{worst}");
}

#[test]
fn no_bit_depends_on_threads_and_the_order_of_the_input_changes_rounding_alone() {
    let cloud = lattice::<f32, 3>(45, 1.0, 1e4);
    let densities = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            SortedCells::sort(&cloud.positions, cloud.radius)
                .unwrap()
                .density::<CubicSpline>(Uniform(1.0))
                .unwrap()
        })
    };
    let one = densities(1);
    assert!(densities(2) == one && densities(5) == one);

    let backwards: Vec<[f32; 3]> = cloud.positions.iter().rev().copied().collect();
    let cells = SortedCells::sort(&backwards, cloud.radius).unwrap();
    let density = cells.density::<CubicSpline>(Uniform(1.0)).unwrap();
    assert!(density.iter().rev().zip(&one).all(|(&a, &b)| agree(a, b.into(), 1e-6)));
}

/// The sums at points of the same places look at each pair twice and go by no window.
#[test]
fn sets_of_any_shape_reach_across_the_pieces_they_are_summed_in() {
    fn check<const D: usize>(counts: [usize; D]) {
        let mut random = Random(2);
        let positions: Vec<[f32; D]> = (0..counts.iter().product())
            .map(|i| {
                let mut rest = i;
                counts.map(|count| {
                    let k = rest % count;
                    rest /= count;
                    k as f32 + 0.4 * random.next() as f32
                })
            })
            .collect();
        let masses: Vec<f32> = positions.iter().map(|_| 0.5 + random.next() as f32).collect();
        let cells = SortedCells::sort(&positions, 2.6).unwrap();
        let density = cells.density::<CubicSpline>(&masses[..]).unwrap();
        let sums = cells.fields(&[&masses]).unwrap().at::<CubicSpline>(&positions, false).unwrap();
        for (i, (&density, &sum)) in density.iter().zip(&sums.values).enumerate() {
            assert!(agree(density, sum.into(), 1e-6), "{counts:?} {i}: {density} {sum}");
        }
    }
    check([20_000]);
    check([6000, 4]);
    check([4, 6000]);
    check([130, 130]);
    // rows longer than a piece, rows shorter than the support, layers of one row, one layer
    check([3000, 5, 5]);
    check([2, 90, 90]);
    check([90, 2, 90]);
    check([90, 90, 2]);
    check([2, 2, 4000]);
    check([26, 27, 28]);
}

#[test]
fn none_one_and_far_apart() {
    let none = SortedCells::<f32, 3>::sort(&[], 1.0).unwrap();
    assert!(none.is_empty() && none.density::<CubicSpline>(Uniform(1.0)).unwrap().is_empty());
    let one = SortedCells::sort(&[[7.0_f64, -3.0]], 0.5).unwrap();
    let w = KernelInfluence::<f64, 2, CubicSpline>::new(0.5).unwrap();
    assert_eq!(one.density::<CubicSpline>(Uniform(2.0)).unwrap(), [2.0 * w.normalisation()]);
    let apart = SortedCells::sort(&[[-1e15_f64], [0.0], [0.1], [1e15]], 0.5).unwrap();
    let density = apart.density::<CubicSpline>(Uniform(1.0)).unwrap();
    assert!(density[0] == density[3] && density[1] == density[2] && density[1] > density[0]);
    let corners = SortedCells::sort(&[[-1e30_f32; 3], [1e30; 3]], 1e-3).unwrap();
    assert_eq!(corners.density::<CubicSpline>(Uniform(1.0)).unwrap().len(), 2);
}

#[test]
fn refuses_what_is_no_set() {
    let sort = |x: f32, h| SortedCells::sort(&[[0.0, 1.0], [x, 2.0]], h).map(|_| ()).unwrap_err();
    assert_eq!(sort(f32::NAN, 1.0), Error::NotFinite { parameter: Parameter::Position, index: 1 });
    assert_eq!(sort(0.0, 0.0), Error::NotPositive { parameter: Parameter::SupportRadius, index: 0 });
    assert_eq!(sort(0.0, f32::NAN), Error::NotFinite { parameter: Parameter::SupportRadius, index: 0 });
    assert_eq!(sort(0.0, 1e30), Error::NotRepresentable { parameter: Parameter::SupportRadius });
    let wide = SortedCells::sort(&[[-f64::MAX], [f64::MAX]], 1.0).map(|_| ()).unwrap_err();
    assert_eq!(wide, Error::NotRepresentable { parameter: Parameter::Position });
    let cells = SortedCells::sort(&[[0.0_f32], [1.0]], 1.0).unwrap();
    let (parameter, expected, found) = (Parameter::Mass, 2, 1);
    let short = cells.density::<CubicSpline>(&[1.0][..]).unwrap_err();
    assert_eq!(short, Error::LengthMismatch { parameter, expected, found });
}
