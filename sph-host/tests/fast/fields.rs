//! Sums at points, for one support radius and for one each.

use proptest::prelude::*;
use sph_core::kernel::{CubicSpline, Kernel, QuinticSpline, Spiky, WendlandC4};
use sph_core::{Error, Influence, KernelInfluence, Parameter};
use sph_host::fast::{Fields, InstructionSet, RadiusOctaves, Real, SortedCells, Sums};

use crate::cloud::{Cloud, Random, clouds, lattice};

/// Checks Σ c W and Σ c ∇W at points against plain sums in f64 with sph-core's influence.
fn check_sums<T: Real, K: Kernel, const D: usize>(
    cloud: &Cloud<T, D>,
    radius: impl Fn(usize) -> T,
    coefficients: &[&[T]],
    points: &[[T; D]],
    sums: &Sums<T>,
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
