use sph_core::fluid::incompressible::{OneByOne, Summation, Wall};
use sph_core::fluid::wcsph::CellStorage;

use super::*;
use crate::engine::setup::column;
use crate::engine::{cells, centre};

type Simulated<T> = Incompressible<T, 2>;

/// A column of water in its tank, with the code of an instruction set and so many threads.
fn fallen<T: Real>(level: InstructionSet, threads: usize) -> Snapshot<2> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut fluid = new::<T>().at_level(level);
        fluid.advance(0.1).unwrap();
        fluid.snapshot()
    })
}

fn new<T: Real>() -> Simulated<T> {
    let (setup, size) = column();
    Simulated::new(&setup, size.map(|length| (0.0, length)), KernelName::WendlandC2).unwrap()
}

#[test]
fn instructions_and_threads_change_no_bit() {
    fn check<T: Real>() {
        let expected = fallen::<T>(InstructionSet::Baseline, 1);
        for (level, threads) in InstructionSet::available().into_iter().zip([2, 3, 1]) {
            let found = fallen::<T>(level, threads);
            assert_eq!(found.positions, expected.positions, "{} {level:?}", T::NAME);
            assert_eq!(found.pressures, expected.pressures, "{} {level:?}", T::NAME);
        }
    }
    check::<f32>();
    check::<f64>();
}

/// Water on a bed that goes on for ever.
fn endless() -> Simulated<f64> {
    let (mut setup, _) = column();
    let dx = setup.spacing;
    setup.positions = cells([0, 0], [32, 8]).iter().map(|cell| centre(cell, dx)).collect();
    setup.velocities = setup.positions.iter().map(|x| [0.8 + 3.0 * x[1], 0.0]).collect();
    setup.pressures = vec![0.0; setup.positions.len()];
    setup.walls = cells([0, -3], [32, 0]).iter().map(|cell| centre(cell, dx)).collect();
    (setup.lower[0], setup.upper[0], setup.periodic[0]) = (0.0, 32.0 * dx, true);
    let all = (f64::NEG_INFINITY, f64::INFINITY);
    Simulated::new(&setup, [all; 2], KernelName::WendlandC2).unwrap()
}

#[test]
fn sums_on_vectors_are_those_of_the_core() {
    for mut fluid in [new::<f64>(), endless()] {
        fluid.advance(0.05).unwrap();
        check_sums(&mut fluid);
    }
}

fn check_sums(fluid: &mut Simulated<f64>) {
    let (walls, all) = (fluid.positions.len() - fluid.ids.len(), fluid.positions.len());
    let scheme = fluid.scheme;
    let mut core = OneByOne {
        search: CellStorage {
            starts: &mut vec![0_u32; scheme.layout.cells() + 1],
            entries: &mut vec![0; all],
        },
        walls: &mut vec![Wall::DRY; walls],
        wall_values: &mut vec![0.0; walls],
    };
    let (x, v) = (fluid.positions.clone(), fluid.velocities.clone());
    let mut shapes = fluid.shapes.clone();
    core.shapes(&scheme, &x, &v, &mut shapes).unwrap();
    let near = |found: f64, expected: f64, size: f64| {
        assert!((found - expected).abs() < 1e-11 * size, "{found} {expected}");
    };
    for (found, expected) in fluid.shapes.iter().zip(&shapes) {
        near(found.density, expected.density, 1.0);
        near(found.diagonal, expected.diagonal, 1e4);
        for axis in 0..2 {
            near(found.gradient[axis], expected.gradient[axis], 100.0);
            near(found.force[axis], expected.force[axis], 1000.0);
        }
    }
    let count = shapes.len();
    let values: Vec<f64> = (0..count).map(|k| ((k * 37) % 19) as f64).collect();
    let [mut found, mut expected] = [0; 2].map(|_| vec![[0.0; 2]; count]);
    fluid.sums.pushes(&scheme, &x, &shapes, &values, &mut found).unwrap();
    core.pushes(&scheme, &x, &shapes, &values, &mut expected).unwrap();
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        near(*found, *expected, 1e4);
    }
    let flow = expected;
    let [mut found, mut expected] = [0; 2].map(|_| vec![0.0; count]);
    fluid.sums.rates(&scheme, &x, &shapes, &flow, &mut found).unwrap();
    core.rates(&scheme, &x, &shapes, &flow, &mut expected).unwrap();
    for (found, expected) in found.iter().zip(&expected) {
        near(*found, *expected, 1e6);
    }
}

#[test]
fn a_snapshot_is_the_whole_state() {
    fn check<T: Real>() {
        let (mut fluid, mut again) = (new::<T>(), new::<T>());
        fluid.advance(0.06).unwrap();
        let snapshot = fluid.snapshot();
        fluid.prepare().unwrap();
        again.restore(&snapshot, fluid.tally());
        again.prepare().unwrap();
        fluid.advance(0.1).unwrap();
        again.advance(0.1).unwrap();
        let [one, other] = [&fluid, &again].map(|fluid| fluid.snapshot());
        assert_eq!(one.positions, other.positions, "{}", T::NAME);
        assert_eq!(one.pressures, other.pressures, "{}", T::NAME);
        assert_ne!(one.positions, snapshot.positions);
        assert!(fluid.tally() == again.tally() && fluid.tally().steps > 20);
    }
    check::<f32>();
    check::<f64>();
}

#[test]
fn particles_too_close_together_are_moved_apart_before_the_first_step() {
    let (mut setup, size) = column();
    for (k, x) in setup.positions.iter_mut().enumerate() {
        *x = crate::engine::jittered(k, *x, 0.2 * setup.spacing);
    }
    let inside = size.map(|length| (0.0, length));
    let fluid = Simulated::<f64>::new(&setup, inside, KernelName::WendlandC2).unwrap();
    let excess = fluid.shapes.iter().map(|shape| (shape.density - 1.0).max(0.0)).sum::<f64>();
    assert!(excess / (fluid.shapes.len() as f64) < 1e-3, "{excess}");
    let snapshot = fluid.snapshot();
    assert_eq!((snapshot.velocities, snapshot.pressures), (setup.velocities, setup.pressures));
    let most = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    let moved = snapshot.positions.iter().zip(&setup.positions).map(most).fold(0.0, f64::max);
    assert!((1e-3..0.5).contains(&(moved / setup.spacing)), "{moved}");
}

#[test]
fn a_particle_that_is_nowhere_is_an_error() {
    let mut fluid = new::<f32>();
    fluid.positions[5][0] = f32::NAN;
    assert!(matches!(fluid.prepare(), Err(Error::NotFinite { .. })));
}
