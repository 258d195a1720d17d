use super::*;
use crate::field::{self, Field};
use crate::kernel::WendlandC2;
use crate::vector::dot;
use crate::{BruteForce, KernelInfluence, Sources, Uniform};

const N: usize = 49;

type W<T> = KernelInfluence<T, 2, WendlandC2>;

/// A 7 × 7 lattice of spacing 0.1, moved about.
fn cloud<T: Scalar>() -> [[T; 2]; N] {
    core::array::from_fn(|i| {
        let (x, y) = ((i % 7) as f64, (i / 7) as f64);
        let wobble = |k: f64| 0.02 * libm::sin(k * (i as f64 + 1.0));
        [T::from_f64(0.1 * x + wobble(12.9)), T::from_f64(0.1 * y + wobble(78.2))]
    })
}

fn velocities<T: Scalar>() -> [[T; 2]; N] {
    core::array::from_fn(|i| [0.7, 1.9].map(|k| T::from_f64(libm::sin(k * i as f64))))
}

fn scheme<T: Scalar>() -> Scheme<T, 2, W<T>> {
    let number = T::from_f64;
    Scheme {
        liquid: Liquid {
            equation_of_state: EquationOfState::tait(T::ONE, number(10.0)).unwrap(),
            gravity: [T::ZERO; 2],
            artificial_viscosity: T::ZERO,
            kinematic_viscosity: T::ZERO,
            density_diffusion: T::ZERO,
            shift_speed: T::ZERO,
        },
        influence: KernelInfluence::new(number(0.27)).unwrap(),
        layout: CellLayout::bounded(&[T::ZERO; 2], &[number(0.6); 2], [3, 3]).unwrap(),
        mass: number(0.01),
    }
}

/// All particles as seen, of mass 0.01.
fn seen(velocities: &[[f64; 2]; N], densities: &[f64; N], pressures: &[f64; N]) -> [Seen<f64, 2>; N] {
    core::array::from_fn(|i| Seen::new(0.01, velocities[i], densities[i], pressures[i]))
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} {expected}");
}

#[test]
fn the_fused_sums_are_those_of_the_fields() {
    let (positions, velocities, densities) = (cloud::<f64>(), velocities::<f64>(), [1.01; N]);
    let mut scheme = scheme::<f64>();
    let pressures: [f64; N] = core::array::from_fn(|i| libm::cos(i as f64));
    let state = ParticleStates { fluid: N, seen: &seen(&velocities, &densities, &pressures) };
    let search = BruteForce::new(&positions).unwrap();
    let volumes = Sources::new(&search, Uniform(0.01 / 1.01)).unwrap();
    let w = &scheme.influence.clone();
    let (pressure, velocity) =
        (Field::new(&volumes, &pressures).unwrap(), Field::new(&volumes, &velocities).unwrap());
    for i in [0, 8, 24, 48] {
        let force = scheme.forces(&search, &state, i).unwrap();
        let gradient = pressure.symmetric_gradient(w, &densities, i).unwrap();
        near(force.acceleration[0], -gradient[0] / 1.01);
        near(force.acceleration[1], -gradient[1] / 1.01);

        let rate = scheme.density_rate(&search, &state, i).unwrap();
        near(rate, -1.01 * field::divergence(&velocity.jacobian::<2>(w, i).unwrap()));

        scheme.liquid.kinematic_viscosity = 0.3;
        let viscous = scheme.forces(&search, &state, i).unwrap();
        let laplacian: [f64; 2] = velocity.laplacian(w, i).unwrap();
        near(viscous.acceleration[0] - force.acceleration[0], 0.3 * laplacian[0]);
        scheme.liquid.kinematic_viscosity = 0.0;
    }
    assert_eq!(scheme.forces(&search, &state, N), None);
}

/// Σ v and Σ x × v, with the sum of the terms' sizes.
fn momenta<T: Scalar>(positions: &[[T; 2]], velocities: &[[T; 2]]) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for (x, v) in positions.iter().zip(velocities) {
        let ([x, y], [u, v]) = (x.map(T::to_f64), v.map(T::to_f64));
        sums[0] += u;
        sums[1] += v;
        sums[2] += x * v - y * u;
        sums[3] += u.abs() + v.abs();
    }
    sums
}

fn run_free_cloud<T: Scalar>(scheme: &Scheme<T, 2, W<T>>, steps: usize) -> ([f64; 4], [f64; 4]) {
    let (mut positions, mut velocities) = (cloud::<T>(), velocities::<T>());
    let before = momenta(&positions, &velocities);
    let mut particles = Particles {
        positions: &mut positions,
        velocities: &mut velocities,
        densities: &mut [T::from_f64(1.002); N],
        forces: &mut [Forces::NONE; N],
        rates: &mut [T::ZERO; N],
        seen: &mut [Seen::NONE; N],
        sums: &mut OneByOne(CellStorage { starts: &mut [0_u8; 10], entries: &mut [0_u8; N] }),
    };
    scheme.prepare(&mut particles).unwrap();
    for _ in 0..steps {
        let dt = scheme.stable_step(&particles, &Limits::default());
        scheme.step(&mut particles, dt).unwrap();
    }
    (before, momenta(&positions, &velocities))
}

#[test]
fn momentum_is_kept_to_rounding() {
    fn check<T: Scalar>(tolerance: f64) {
        let mut scheme = scheme::<T>();
        scheme.liquid.artificial_viscosity = T::from_f64(0.2);
        scheme.liquid.density_diffusion = T::from_f64(0.1);
        let (before, after) = run_free_cloud(&scheme, 100);
        assert!((after[3] / before[3] - 1.0).abs() > 1e-3, "something happened");
        for k in 0..3 {
            assert!((after[k] - before[k]).abs() < tolerance * before[3], "{k}: {before:?} {after:?}");
        }
    }
    check::<f64>(1e-14);
    check::<f32>(1e-5);
}

#[test]
fn the_gradient_of_density_is_that_of_the_field() {
    let positions = cloud::<f64>();
    let densities: [f64; N] = core::array::from_fn(|i| 1.0 + 0.1 * libm::sin(i as f64));
    let mut scheme = scheme::<f64>();
    scheme.liquid.density_diffusion = 0.1;
    let search = BruteForce::new(&positions).unwrap();
    let volumes = densities.map(|density| 0.01 / density);
    let sources = Sources::new(&search, volumes.as_slice()).unwrap();
    let field = Field::new(&sources, &densities).unwrap();
    let gradient = |densities: &[f64; N], i| {
        let seen = seen(&[[0.0; 2]; N], densities, &[0.0; N]);
        scheme.forces(&search, &ParticleStates { fluid: N, seen: &seen }, i).unwrap().density_gradient
    };
    for i in 0..N {
        let (found, expected) =
            (gradient(&densities, i), field.corrected_gradient(&scheme.influence, i).unwrap());
        let is_corner = [0, 6, 42, 48].contains(&i);
        if is_corner && found == [0.0; 2] {
            continue;
        }
        for axis in 0..2 {
            near(found[axis], expected[axis]);
        }
    }
    let alone = [[0.0, 0.0], [0.1, 0.0]];
    let search = BruteForce::new(&alone).unwrap();
    let seen = [1.0, 2.0].map(|density| Seen::new(0.01, [0.0; 2], density, 0.0));
    let force = scheme.forces(&search, &ParticleStates { fluid: 2, seen: &seen }, 0).unwrap();
    assert_eq!(force.density_gradient, [0.0; 2], "two particles span a line");
}

/// Two particles 0.1 apart, the first of which moves with `velocity` and has density `density`.
fn first_of_two(scheme: &Scheme<f64, 2, W<f64>>, velocity: [f64; 2], density: f64) -> (Forces<f64, 2>, f64) {
    let positions = [[0.0, 0.0], [0.1, 0.0]];
    let search = BruteForce::new(&positions).unwrap();
    let seen = [Seen::new(0.01, velocity, density, 0.0), Seen::new(0.01, [0.0; 2], 1.0, 0.0)];
    let state = ParticleStates { fluid: 2, seen: &seen };
    let force = scheme.forces(&search, &state, 0).unwrap();
    (force, scheme.density_rate(&search, &state, 0).unwrap())
}

#[test]
fn two_particles_obey_the_closed_forms() {
    let mut scheme = scheme::<f64>();
    let gradient = scheme.influence.gradient_at(&[-0.1, 0.0]);
    assert!(gradient[0] > 0.0, "towards the other");
    scheme.liquid.gravity = [0.5, -2.0];
    near(first_of_two(&scheme, [0.0; 2], 1.0).0.acceleration[1], -2.0);
    near(first_of_two(&scheme, [0.0; 2], 1.0).0.acceleration[0], 0.5);
    scheme.liquid.gravity = [0.0; 2];

    scheme.liquid.artificial_viscosity = 0.2;
    let length = 0.135;
    // v·x is −0.3 where they approach
    let stress = 0.2 * 10.0 * length * 0.3 / (0.01 + 0.01 * length * length);
    let braked = first_of_two(&scheme, [3.0, 0.0], 1.0).0.acceleration;
    near(braked[0], -0.01 * stress * gradient[0]);
    assert!(braked[0] < 0.0, "approach is slowed");
    assert_eq!(first_of_two(&scheme, [-3.0, 0.0], 1.0).0.acceleration, [0.0; 2], "retreat is not");

    near(first_of_two(&scheme, [3.0, 0.0], 1.0).1, 0.01 * 3.0 * gradient[0]);
    scheme.liquid.density_diffusion = 0.1;
    // F = x·∇W/r² = −|∇W|/r
    let diffused = 2.0 * 0.1 * length * 10.0 * 0.01 * 0.5 * -(gradient[0] / 0.1);
    near(first_of_two(&scheme, [0.0; 2], 1.5).1, diffused);
    assert!(diffused < 0.0, "the denser becomes less dense");
}

/// A particle at 0 with a wall particle at 0.1: dρ/dt of the first, which moves along x, and whose pressure is given.
fn beside_a_wall(velocity: f64, pressure: f64) -> f64 {
    let positions = [[0.0, 0.0], [0.1, 0.0]];
    let seen = [Seen::new(0.01, [velocity, 0.0], 1.0, pressure), Seen::new(0.01, [0.0; 2], 1.0, 0.0)];
    let state = ParticleStates { fluid: 1, seen: &seen };
    scheme().density_rate(&BruteForce::new(&positions).unwrap(), &state, 0).unwrap()
}

#[test]
fn a_wall_thins_what_leaves_it_only_where_it_pushes() {
    let gradient = scheme::<f64>().influence.gradient_at(&[-0.1, 0.0])[0];
    for pressure in [-1.0, 0.0, 1.0] {
        near(beside_a_wall(3.0, pressure), 0.01 * 3.0 * gradient);
    }
    near(beside_a_wall(-3.0, 1.0), -0.01 * 3.0 * gradient);
    assert_eq!((beside_a_wall(-3.0, 0.0), beside_a_wall(-3.0, -1.0)), (0.0, 0.0));
}

#[test]
fn walls_extrapolate_a_linear_pressure_and_push_only() {
    let mut scheme = scheme::<f64>();
    scheme.liquid.gravity = [0.3, -2.0];
    let positions: [[f64; 2]; N] = core::array::from_fn(|i| if i == 0 { [0.3, -0.1] } else { cloud()[i] });
    // the wall last, fluid first
    let positions: [[f64; 2]; N] = core::array::from_fn(|i| positions[(i + 1) % N]);
    let pressure_at = |x: &[f64; 2]| 5.0 + dot(&scheme.liquid.gravity, x);
    let pressures = positions.map(|x| pressure_at(&x));
    let (velocities, densities) = ([[0.5, -0.25]; N], [1.0; N]);
    let search = BruteForce::new(&positions).unwrap();
    let state = |pressures| seen(&velocities, &densities, pressures);
    let wall_of = |seen: &[Seen<f64, 2>; N]| scheme.wall(&search, &seen[..N - 1], N - 1);
    let wall = wall_of(&state(&pressures));
    near(wall.pressure, pressure_at(&positions[N - 1]));
    near(scheme.liquid.equation_of_state.pressure(wall.density), wall.pressure);
    near(wall.velocity[0], -0.5);
    near(wall.velocity[1], 0.25);
    let wall = wall_of(&state(&[-5.0; N]));
    assert_eq!((wall.pressure, wall.density), (0.0, 1.0));
}

#[test]
fn each_limit_of_the_step_is_its_closed_form() {
    let mut scheme = scheme::<f64>();
    let (limits, length) = (Limits::default(), 0.135);
    near(scheme.longest_step(&limits, 3.0, 0.0), 0.25 * length / 13.0);
    near(scheme.longest_step(&limits, 0.0, 1e6), 0.25 * libm::sqrt(length / 1e6));
    scheme.liquid.artificial_viscosity = 0.5;
    near(scheme.longest_step(&limits, 3.0, 0.0), 0.25 * length / 16.0);
    scheme.liquid.kinematic_viscosity = 2.0;
    near(scheme.longest_step(&limits, 3.0, 0.0), 0.125 * length * length / 2.0);
}

#[test]
fn slices_that_do_not_agree_and_lost_particles_are_errors() {
    let scheme = scheme::<f64>();
    let mut positions = cloud::<f64>();
    positions[7][1] = f64::NAN;
    let mut particles = Particles {
        positions: &mut positions,
        velocities: &mut [[0.0; 2]; N],
        densities: &mut [1.0; N],
        forces: &mut [Forces::NONE; N],
        rates: &mut [0.0; N],
        seen: &mut [Seen::NONE; N],
        sums: &mut OneByOne(CellStorage { starts: &mut [0_u8; 10], entries: &mut [0_u8; N] }),
    };
    let error = scheme.prepare(&mut particles).unwrap_err();
    assert_eq!(error, crate::Error::NotFinite { parameter: crate::Parameter::Position, index: 7 });
    let mut short = [[0.0; 2]; N - 1];
    particles.velocities = &mut short;
    let error = scheme.step(&mut particles, 0.1).unwrap_err();
    assert!(matches!(error, crate::Error::LengthMismatch { expected: N, .. }));
}
