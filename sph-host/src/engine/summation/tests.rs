use sph_core::CellLayout;
use sph_core::fluid::EquationOfState;
use sph_core::fluid::wcsph::{CellStorage, Liquid, OneByOne, Particles};

use super::*;
use crate::engine::{cells, centre, jittered};
use crate::kernel_choice::KernelName;

const SUPPORT: f64 = 0.25;

/// Fluid over a wall, with every term switched on; along x as wide as the period, where there is one.
fn scheme<T: Real>(is_periodic: bool, kernel: KernelName) -> Host<T, 2> {
    let number = T::from_f64;
    let mut layout =
        CellLayout::bounded(&[number(0.0), number(-1.0)], &[number(4.0), number(3.0)], [16, 16]).unwrap();
    if is_periodic {
        layout = layout.periodic(0, number(0.0), number(4.0)).unwrap();
    }
    Scheme {
        liquid: Liquid {
            equation_of_state: EquationOfState::tait(T::ONE, number(10.0)).unwrap(),
            gravity: [number(0.3), number(-1.0)],
            artificial_viscosity: number(0.1),
            kinematic_viscosity: number(0.02),
            density_diffusion: number(0.1),
            shift_speed: number(0.5),
        },
        influence: AnyInfluence::new(kernel, number(SUPPORT)).unwrap(),
        layout,
        mass: number(0.01),
    }
}

/// Positions after some steps, the last forces, and the last rates: of the fluid, in one list of numbers.
fn steps<T: Real, S: Summation<T, 2, AnyInfluence<T, 2>>>(
    scheme: &Host<T, 2>,
    sums: &mut S,
    count: usize,
) -> Vec<T> {
    let (mut positions, fluid) = particles::<T>();
    let moving = |k: usize| jittered(k, [0.8, 0.1], 0.2).map(T::from_f64);
    let mut velocities: Vec<[T; 2]> = (0..fluid).map(moving).collect();
    let mut densities: Vec<T> = (0..fluid).map(|k| T::from_f64(jittered(k, [1.01], 0.01)[0])).collect();
    let (mut forces, mut rates) = (vec![Forces::NONE; fluid], vec![T::ZERO; fluid]);
    let mut seen = vec![Seen::NONE; positions.len()];
    let mut particles = Particles {
        positions: &mut positions,
        velocities: &mut velocities,
        densities: &mut densities,
        forces: &mut forces,
        rates: &mut rates,
        seen: &mut seen,
        sums,
    };
    scheme.prepare(&mut particles).unwrap();
    for _ in 0..count {
        scheme.step(&mut particles, T::from_f64(0.004)).unwrap();
    }
    let of_forces = forces.iter().flat_map(|f| [f.acceleration, f.shift, f.density_gradient]).flatten();
    positions[..fluid].iter().flatten().copied().chain(of_forces).chain(rates).collect()
}

/// A fluid 4 by 1.2 on a bed of walls, and how many of them are fluid.
fn particles<T: Real>() -> (Vec<[T; 2]>, usize) {
    let fluid = cells([0, 0], [40, 12]);
    let walls = cells([0, -3], [40, 0]);
    let place = |(k, cell): (usize, &[i64; 2])| {
        jittered(k, centre(cell, 0.1), if cell[1] < 0 { 0.0 } else { 0.01 }).map(T::from_f64)
    };
    (fluid.iter().chain(&walls).enumerate().map(place).collect(), fluid.len())
}

fn on_vectors<T: Real>(
    scheme: &Host<T, 2>,
    kernel: KernelName,
    level: InstructionSet,
) -> SimdSummation<T, 2> {
    let (positions, fluid) = particles::<T>();
    let support = T::from_f64(SUPPORT);
    let rows = VerletLists::new(*scheme.layout.domain(), support, fluid, &positions[fluid..]).unwrap();
    SimdSummation::new(rows, SimdKernel::new::<2>(kernel, support)).at_level(level)
}

/// The greatest difference over the greatest number.
fn difference<T: Real>(found: &[T], expected: &[T]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |most, x| most.max(x.abs()));
    let differences = &mut found.iter().zip(expected).map(|(a, b)| a.to_f64() - b.to_f64());
    greatest(differences) / greatest(&mut expected.iter().map(|x| x.to_f64()))
}

#[test]
fn sums_on_vectors_are_those_of_the_core() {
    fn check<T: Real>(is_periodic: bool, kernel: KernelName, tolerance: f64) {
        let scheme = scheme::<T>(is_periodic, kernel);
        let count = particles::<T>().0.len();
        let (mut starts, mut entries) = (vec![0_u32; scheme.layout.cells() + 1], vec![0; count]);
        let search = CellStorage { starts: &mut starts, entries: &mut entries };
        // far enough for rows to be listed several times, and for particles to leave one end of the period for the other
        let expected = steps(&scheme, &mut OneByOne(search), 30);
        for level in InstructionSet::available() {
            let found = steps(&scheme, &mut on_vectors(&scheme, kernel, level), 30);
            let off = difference(&found, &expected);
            assert!(off < tolerance, "{} {kernel:?} {is_periodic} {level:?}: {off}", T::NAME);
        }
    }
    for is_periodic in [false, true] {
        check::<f64>(is_periodic, KernelName::WendlandC2, 1e-12);
        check::<f32>(is_periodic, KernelName::WendlandC2, 1e-4);
        check::<f64>(is_periodic, KernelName::Spiky, 1e-12);
    }
}

#[test]
fn instructions_and_threads_change_no_bit() {
    fn check<T: Real>() {
        let scheme = scheme::<T>(true, KernelName::WendlandC2);
        let run = |level, threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| steps(&scheme, &mut on_vectors(&scheme, KernelName::WendlandC2, level), 12))
        };
        let expected = run(InstructionSet::Baseline, 1);
        for level in InstructionSet::available() {
            assert!(run(level, 3) == expected, "{} {level:?}", T::NAME);
        }
    }
    check::<f32>();
    check::<f64>();
}

#[test]
fn a_particle_that_is_nowhere_is_an_error() {
    let scheme = scheme::<f64>(false, KernelName::WendlandC2);
    let mut sums = on_vectors(&scheme, KernelName::WendlandC2, InstructionSet::best());
    let (mut positions, fluid) = particles::<f64>();
    positions[5][0] = f64::NAN;
    let seen = vec![Seen::NONE; positions.len()];
    let error = sums.rates(&scheme, &positions, &seen, &mut vec![0.0; fluid]).unwrap_err();
    assert!(matches!(error, Error::NotFinite { index: 5, .. }), "{error}");
}
