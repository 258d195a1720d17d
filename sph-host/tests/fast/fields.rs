//! Sums at points, for one support radius and for one each.

use proptest::prelude::*;
use sph_core::kernel::{CubicSpline, Kernel, QuinticSpline, Spiky, WendlandC4};
use sph_core::{
    BruteForce, Error, Field, Influence, InfluenceOf, KernelInfluence, Parameter, PerSampleInfluence, Sources,
};
use sph_host::estimate_choice::Estimate;
use sph_host::fast::{Estimates, Fields, InstructionSet, RadiusOctaves, Real, Samples, SortedCells};

use crate::cloud::{Cloud, Random, clouds, lattice};

/// Checks Σ c W and Σ c ∇W at points against plain sums in f64 with sph-core's influence.
fn check_sums<T: Real, K: Kernel, const D: usize>(
    cloud: &Cloud<T, D>,
    radius: impl Fn(usize) -> T,
    coefficients: &[&[T]],
    points: &[[T; D]],
    sums: &Estimates<T>,
    tolerance: f64,
) {
    let influences: Vec<_> = (0..cloud.positions.len())
        .map(|j| KernelInfluence::<f64, D, K>::new(radius(j).to_f64()).unwrap())
        .collect();
    let mut values = sums.values.chunks_exact(1 + D);
    for (point, &reached) in points.iter().zip(&sums.reached) {
        let mut expected = 0;
        for c in coefficients {
            let (mut sum, mut most) = ([0.0; 4], [0.0; 4]);
            // what one term can be wrong by where the kernel has almost ended
            let mut floor = 0.0_f64;
            for (j, x) in cloud.positions.iter().enumerate() {
                let d: [f64; D] = std::array::from_fn(|axis| (point[axis] - x[axis]).to_f64());
                let (w, gradient) = influences[j].value_and_gradient(&d, d.iter().map(|d| d * d).sum());
                if d.iter().map(|d| d * d).sum::<f64>() < influences[j].support_radius().powi(2) {
                    floor = floor.max(1e-2 * influences[j].normalisation() * c[j].to_f64().abs());
                }
                let terms = [w].into_iter().chain(gradient).map(|term| term * c[j].to_f64());
                for (k, term) in terms.enumerate() {
                    sum[k] += term;
                    most[k] += term.abs();
                }
            }
            for (k, &found) in values.next().unwrap().iter().enumerate() {
                // a gradient's terms cancel: its error is measured by their magnitudes
                let floor = if k > 0 { 30.0 * floor / cloud.radius.to_f64() } else { floor };
                let scale = most[k] + floor;
                assert!(
                    (found.to_f64() - sum[k]).abs() <= tolerance * scale,
                    "{k}: {found:?} {} {scale}",
                    sum[k]
                );
            }
        }
        for (j, x) in cloud.positions.iter().enumerate() {
            let square = (0..D).fold(T::ZERO, |sum, axis| {
                let d = point[axis] - x[axis];
                if axis == 0 { d * d } else { sum + d * d }
            });
            expected += u32::from(square < radius(j) * radius(j));
        }
        assert_eq!(reached, expected);
    }
}

/// Points among the particles, on them, and beyond the box.
fn points<T: Real, const D: usize>(cloud: &Cloud<T, D>) -> Vec<[T; D]> {
    let mut random = Random(3);
    let near = cloud.positions.iter().take(40).map(|x| {
        let shift: [f64; D] = std::array::from_fn(|_| 3.0 * random.next() - 1.5);
        std::array::from_fn(|axis| x[axis] + cloud.radius * T::from_f64(shift[axis]))
    });
    near.chain(cloud.positions.iter().rev().take(5).copied())
        .chain([[T::ZERO; D], [T::from_f64(1e9); D]])
        .collect()
}

fn check<T: Real, K: Kernel, const D: usize>(cloud: &Cloud<T, D>, tolerance: f64) {
    let mut random = Random(9);
    let mut column = |scale: f64| -> Vec<T> {
        cloud.positions.iter().map(|_| T::from_f64(scale * random.next() - 0.5)).collect()
    };
    let (a, b, spread) = (column(2.0), column(0.1), column(1.0));
    let coefficients = [&a[..], &b[..]];
    let points = points(cloud);
    let at = |fields: Fields<'_, T, D>| fields.at::<K>(&points, true).unwrap();

    let cells = SortedCells::sort(&cloud.positions, cloud.radius).unwrap();
    let sums = at(cells.fields(&coefficients).unwrap());
    check_sums::<T, K, D>(cloud, |_| cloud.radius, &coefficients, &points, &sums, tolerance);

    // radii over a factor of 30
    let radii: Vec<T> =
        spread.iter().map(|s| cloud.radius * T::from_f64(30_f64.powf(s.to_f64() - 0.5))).collect();
    let levels = RadiusOctaves::sort(&cloud.positions, &radii).unwrap();
    let own = at(levels.fields(&coefficients).unwrap());
    check_sums::<T, K, D>(cloud, |j| radii[j], &coefficients, &points, &own, tolerance);

    for level in InstructionSet::available() {
        assert!(at(cells.clone().at_level(level).fields(&coefficients).unwrap()) == sums, "{level:?}");
        assert!(at(levels.clone().at_level(level).fields(&coefficients).unwrap()) == own, "{level:?}");
    }
    let without = cells.fields(&coefficients).unwrap().at::<K>(&points, false).unwrap();
    assert!(without.values.iter().zip(sums.values.iter().step_by(1 + D)).all(|(a, b)| a == b));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_set(
        line in clouds::<f64, 1>(), plane in clouds::<f32, 2>(), space in clouds::<f32, 3>(), wide in clouds::<f64, 3>()
    ) {
        check::<_, WendlandC4, 1>(&line, 1e-12);
        check::<_, CubicSpline, 2>(&plane, 1e-5);
        check::<_, Spiky, 3>(&space, 1e-5);
        check::<_, QuinticSpline, 3>(&wide, 1e-12);
    }
}

#[test]
fn no_bit_depends_on_threads() {
    let cloud = lattice::<f32, 3>(30, 0.1, 0.0);
    let masses = vec![1e-3; cloud.positions.len()];
    let radii: Vec<f32> = (0..masses.len()).map(|j| 0.1 + 0.3 * (j % 17) as f32 / 17.0).collect();
    let in_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let cells = SortedCells::sort(&cloud.positions, cloud.radius).unwrap();
            let levels = RadiusOctaves::sort(&cloud.positions, &radii).unwrap();
            [cells.fields(&[&masses]), levels.fields(&[&masses])]
                .map(|fields| fields.unwrap().at::<CubicSpline>(&cloud.positions, true).unwrap())
        })
    };
    let one = in_threads(1);
    assert!(in_threads(2) == one && in_threads(5) == one);
}

#[test]
fn nothing_in_reach_no_points_and_no_fields() {
    let cells = SortedCells::sort(&[[0.0_f64], [1.0]], 0.5).unwrap();
    let fields = cells.fields(&[&[1.0, 1.0]]).unwrap();
    let far = fields.at::<CubicSpline>(&[[9.0]], true).unwrap();
    assert_eq!((far.values, far.reached), (vec![0.0, 0.0], vec![0]));
    assert!(fields.at::<CubicSpline>(&[], true).unwrap().values.is_empty());
    assert_eq!(cells.fields(&[]).unwrap().at::<CubicSpline>(&[[0.1]], true).unwrap().reached, [1]);
    let none = SortedCells::<f64, 1>::sort(&[], 0.5).unwrap();
    assert_eq!(none.fields(&[&[]]).unwrap().at::<CubicSpline>(&[[0.1]], false).unwrap().values, [0.0]);

    let parameter = Parameter::Position;
    let nan = fields.at::<CubicSpline>(&[[f64::NAN]], false).unwrap_err();
    assert_eq!(nan, Error::NotFinite { parameter, index: 0 });
    assert!(cells.fields(&[&[1.0]]).is_err());
    let radii = RadiusOctaves::sort(&[[0.0], [1.0]], &[1.0, -1.0]).map(|_| ()).unwrap_err();
    assert_eq!(radii, Error::NotPositive { parameter: Parameter::SupportRadius, index: 1 });
}

/// By sph-core's sums: value and slope of a field, if the samples in reach carry the estimate.
fn exact<T: Real, const D: usize>(
    estimate: Estimate,
    w: impl InfluenceOf<T, D>,
    cloud: &Cloud<T, D>,
    volumes: &[T],
    values: &[T],
    x: &[T; D],
) -> Option<(T, [T; D])> {
    let sources = Sources::new(BruteForce::new(&cloud.positions).unwrap(), volumes).unwrap();
    let field = Field::new(&sources, values).unwrap();
    match estimate {
        Estimate::Plain => Some(field.interpolate_with_gradient_at(w, x)),
        Estimate::Shepard => field.shepard_gradient_at(w, x),
        Estimate::Corrected => field.corrected_at(w, x).map(|fit| (fit.value, fit.gradient)),
    }
}

/// The estimates of A = 2 + x·(1, −2, 3) and of another field are those of sph-core, with one h and with one each, and the
/// corrected one is exact for A; they are carried at the same points, and all levels and numbers of threads give the same bits.
fn check_estimates<T: Real, K: Kernel, const D: usize>(cloud: &Cloud<T, D>, tolerance: f64) {
    let mut random = Random(17);
    let mut column = |least: f64| -> Vec<T> {
        cloud.positions.iter().map(|_| T::from_f64(least + random.next())).collect()
    };
    let (volumes, other, spread) = (column(0.5), column(-0.5), column(0.0));
    let h = cloud.radius.to_f64();
    let slopes = [1.0, -2.0, 3.0];
    let plane = |x: &[T; D]| 2.0 + (0..D).map(|axis| slopes[axis] * x[axis].to_f64() / h).sum::<f64>();
    let values: Vec<T> = cloud.positions.iter().map(|x| T::from_f64(plane(x))).collect();
    let points = points(cloud);
    let samples = Samples { coefficients: &[&other], volumes: &volumes, values: &[&values, &other] };
    let radii: Vec<T> = spread.iter().map(|s| cloud.radius * T::from_f64(0.8 + 2.4 * s.to_f64())).collect();
    let uniform = KernelInfluence::<T, D, K>::new(cloud.radius).unwrap();
    let each = PerSampleInfluence::<T, D, K>::new(&radii).unwrap();

    for &estimate in Estimate::ALL {
        for is_own in [false, true] {
            let at = |level: InstructionSet, gradient: bool| {
                if is_own {
                    let cells = RadiusOctaves::sort(&cloud.positions, &radii).unwrap().at_level(level);
                    cells.samples(&samples).unwrap().estimate::<K>(estimate, &points, gradient).unwrap()
                } else {
                    let cells = SortedCells::sort(&cloud.positions, cloud.radius).unwrap().at_level(level);
                    cells.samples(&samples).unwrap().estimate::<K>(estimate, &points, gradient).unwrap()
                }
            };
            let found = at(InstructionSet::best(), true);
            let mut carried = 0;
            let most = found.reached.iter().max().unwrap();
            let rows = found.values.chunks_exact(3 * (1 + D)).zip(&found.carried).zip(&found.reached);
            // with few particles in reach, rounding grows by the condition number: at most 1e8 in f64 and 1e4 in f32
            let epsilon = T::EPSILON.to_f64();
            let worst = epsilon * if epsilon < 1e-12 { 1e8 } else { 1e4 };
            for (x, ((row, &is_carried), reached)) in points.iter().zip(rows) {
                let is_sparse = estimate == Estimate::Corrected && 2 * reached <= *most;
                let tolerance = if is_sparse { worst } else { tolerance };
                for (values, row) in [&values, &other].iter().zip(row[1 + D..].chunks_exact(1 + D)) {
                    let expected = if is_own {
                        exact(estimate, each, cloud, &volumes, values, x)
                    } else {
                        exact(estimate, &uniform, cloud, &volumes, values, x)
                    };
                    assert_eq!(expected.is_some(), is_carried, "{estimate:?} {x:?}");
                    let Some((value, gradient)) = expected else {
                        assert!(row.iter().all(|value| value.to_f64().is_nan()));
                        continue;
                    };
                    carried += 1;
                    let near = |a: T, b: f64, unit: f64| (a.to_f64() - b).abs() <= tolerance * unit;
                    let size = 1.0 + value.to_f64().abs();
                    assert!(
                        near(row[0], value.to_f64(), 20.0 * size),
                        "{estimate:?} {x:?}: {row:?} {value:?}"
                    );
                    for axis in 0..D {
                        let expected = gradient[axis].to_f64();
                        let unit = 200.0 * (size / h + expected.abs());
                        assert!(
                            near(row[1 + axis], expected, unit),
                            "{estimate:?} {x:?}: {row:?} {gradient:?}"
                        );
                    }
                }
                if estimate == Estimate::Corrected && is_carried {
                    let row = &row[1 + D..];
                    let size = 20.0 * (1.0 + plane(x).abs());
                    assert!((row[0].to_f64() - plane(x)).abs() <= 5.0 * tolerance * size, "{x:?} {row:?}");
                    for axis in 0..D {
                        let error = row[1 + axis].to_f64() * h - slopes[axis];
                        assert!(error.abs() <= 100.0 * tolerance * size, "{x:?} {row:?}");
                    }
                }
            }
            assert!(carried > points.len(), "{estimate:?}: {carried}");
            for level in InstructionSet::available() {
                let same = at(level, true);
                let bits = |found: &Estimates<T>| -> Vec<u64> {
                    found.values.iter().map(|value| value.canonical_bits()).collect()
                };
                assert!(bits(&same) == bits(&found) && same.carried == found.carried, "{level:?}");
            }
            let without = at(InstructionSet::best(), false);
            let values = found.values.iter().step_by(1 + D);
            assert!(without.values.iter().zip(values).all(|(a, b)| a.canonical_bits() == b.canonical_bits()));
        }
    }
}

#[test]
fn estimates_are_those_of_the_exact_path_and_corrected_ones_are_exact_for_linear_fields() {
    check_estimates::<f64, CubicSpline, 1>(&lattice(60, 0.37, -3.0), 1e-13);
    check_estimates::<f64, WendlandC4, 2>(&lattice(20, 2.7, 5.0), 1e-13);
    check_estimates::<f64, CubicSpline, 3>(&lattice(9, 0.11, 0.0), 1e-13);
    check_estimates::<f32, QuinticSpline, 1>(&lattice(60, 0.37, -3.0), 1e-6);
    check_estimates::<f32, CubicSpline, 2>(&lattice(20, 2.7, 0.0), 1e-6);
    check_estimates::<f32, CubicSpline, 3>(&lattice(9, 0.11, 0.0), 1e-6);
}

/// In a plane or on a line the corrected estimate is not carried, nor where there is no particle; the others are.
#[test]
fn points_that_do_not_carry_the_corrected_estimate_are_told_apart() {
    let flat: Vec<[f32; 3]> = (0..100).map(|i| [(i % 10) as f32, (i / 10) as f32, 1.0]).collect();
    let cells = SortedCells::sort(&flat, 2.6).unwrap();
    let ones = [1.0; 100];
    let samples = Samples { coefficients: &[], volumes: &ones, values: &[&ones] };
    let fields = cells.samples(&samples).unwrap();
    let points = [[4.5, 4.5, 1.0], [4.5, 4.5, 2.0], [50.0, 0.0, 0.0]];
    let found = fields.estimate::<CubicSpline>(Estimate::Corrected, &points, true).unwrap();
    assert_eq!(found.carried, [false, false, false]);
    assert_eq!(found.reached.iter().map(|&count| count > 0).collect::<Vec<_>>(), [true, true, false]);
    assert!(found.values.iter().all(|value| value.is_nan()));
    let found = fields.estimate::<CubicSpline>(Estimate::Shepard, &points, false).unwrap();
    assert_eq!(found.carried, [true, true, false]);
    assert!((found.values[0] - 1.0).abs() < 1e-6 && found.values[2].is_nan());
    let wrong = Samples { coefficients: &[], volumes: &[1.0], values: &[&ones] };
    assert!(cells.samples(&wrong).is_err());
}
