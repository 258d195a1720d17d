//! The terms of weakly compressible SPH between a few particles, against their closed forms.

use sph_core::fluid::EquationOfState;
use sph_core::fluid::wcsph::{Forces, Liquid, ParticleStates, Scheme, Seen};
use sph_core::kernel::WendlandC2;
use sph_core::{BruteForce, CellLayout, Influence, KernelInfluence};

type Plane = Scheme<f64, 2, KernelInfluence<f64, 2, WendlandC2>>;

const MASS: f64 = 0.01;
const SUPPORT: f64 = 0.27;

fn scheme() -> Plane {
    Scheme {
        liquid: Liquid {
            equation_of_state: EquationOfState::linear(1.0, 10.0).unwrap(),
            gravity: [0.0; 2],
            artificial_viscosity: 0.0,
            kinematic_viscosity: 0.0,
            density_diffusion: 0.0,
            shift_speed: 0.0,
        },
        influence: KernelInfluence::new(SUPPORT).unwrap(),
        layout: CellLayout::bounded(&[-1.0; 2], &[1.0; 2], [7, 7]).unwrap(),
        mass: MASS,
    }
}

/// A particle with velocity, density and pressure.
fn particle(velocity: [f64; 2], density: f64, pressure: f64) -> Seen<f64, 2> {
    Seen::new(MASS, velocity, density, pressure)
}

/// What acts on the first of some particles, of which the first `fluid` are no wall.
fn first(
    scheme: &Plane,
    positions: &[[f64; 2]],
    seen: &[Seen<f64, 2>],
    drifts: &[[f64; 2]],
    fluid: usize,
) -> Forces<f64, 2> {
    let search = BruteForce::new(positions).unwrap();
    let mut seen = seen.to_vec();
    seen.iter_mut().zip(drifts).for_each(|(seen, &drift)| seen.shift_velocity = drift);
    scheme.forces(&search, &ParticleStates { fluid, seen: &seen }, 0).unwrap()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found}, not {expected}");
}

const PAIR: [[f64; 2]; 2] = [[0.0, 0.0], [0.1, 0.0]];
const STILL: [[f64; 2]; 2] = [[0.0; 2]; 2];

/// ∂W/∂x at the first of the pair, which points to the second.
fn slope() -> f64 {
    scheme().influence.gradient_at(&[-0.1, 0.0])[0]
}

#[test]
fn walls_push_and_do_not_pull() {
    let scheme = scheme();
    for (pressure, pushes) in [(3.0, true), (-3.0, false)] {
        let seen = [particle([0.0; 2], 1.0, pressure), particle([0.0; 2], 1.0, 0.0)];
        let by_fluid = first(&scheme, &PAIR, &seen, &STILL, 2).acceleration[0];
        let by_wall = first(&scheme, &PAIR, &seen, &STILL[..1], 1).acceleration[0];
        near(by_fluid, -MASS * pressure * slope());
        near(by_wall, if pushes { by_fluid } else { 0.0 });
    }
}

#[test]
fn walls_are_smooth_to_artificial_viscosity() {
    let mut scheme = scheme();
    scheme.liquid.artificial_viscosity = 0.5;
    let seen = [particle([3.0, 0.0], 1.0, 0.0), particle([0.0; 2], 1.0, 0.0)];
    assert!(first(&scheme, &PAIR, &seen, &STILL, 2).acceleration[0] < 0.0);
    assert_eq!(first(&scheme, &PAIR, &seen, &STILL[..1], 1).acceleration, [0.0; 2]);
}

/// ν m (V_i + V_j) … of different densities: what one gains, the other loses.
#[test]
fn laminar_viscosity_takes_the_volumes_of_both() {
    let mut scheme = scheme();
    scheme.liquid.kinematic_viscosity = 0.3;
    let (one, other) = (particle([3.0, 1.0], 1.0, 0.0), particle([0.0; 2], 1.6, 0.0));
    let found = first(&scheme, &PAIR, &[one, other], &STILL, 2).acceleration;
    // F = x·∇W/r² = −|∇W|/r
    let factor = 0.3 * (MASS / 1.0 + MASS / 1.6) * -slope() / 0.1;
    near(found[0], 3.0 * factor);
    near(found[1], factor);
    assert!(found[0] < 0.0, "it is slowed");
    let back = first(&scheme, &PAIR, &[other, one], &STILL, 2).acceleration;
    near(back[0], -found[0]);
    near(back[1], -found[1]);
}

#[test]
fn shifts_lead_to_where_particles_are_few_and_are_held() {
    let mut scheme = scheme();
    let seen = [particle([0.0; 2], 1.0, 0.0); 2];
    for speed in [0.5, 2.0] {
        scheme.liquid.shift_speed = speed;
        let far = [[0.0, 0.0], [0.25, 0.0]];
        let shift = first(&scheme, &far, &seen, &STILL, 2).shift;
        let gradient = scheme.influence.gradient_at(&[-0.25, 0.0])[0];
        near(shift[0], -speed * SUPPORT * MASS * gradient);
        assert!(shift[0] < 0.0 && shift[0] > -speed / 2.0, "away from the other");
    }
    // a hundred at one place push harder than half the speed
    let mut crowd = vec![[0.1, 0.0]; 101];
    crowd[0] = [0.0; 2];
    let shift = first(&scheme, &crowd, &[seen[0]; 101], &[[0.0; 2]; 101], 101).shift;
    near(shift[0], -1.0);
    near(shift[1], 0.0);
}

/// Σ (V_i v_i (δv_i·∇W) + V_j v_j (δv_j·∇W)): what is carried by the shifts.
#[test]
fn shifted_particles_carry_their_momentum() {
    let mut scheme = scheme();
    scheme.liquid.shift_speed = 2.0;
    let (one, other) = (particle([3.0, 1.0], 1.0, 0.0), particle([-1.0, 0.5], 1.6, 0.0));
    let drifts = [[0.2, 0.7], [-0.1, 0.3]];
    let found = first(&scheme, &PAIR, &[one, other], &drifts, 2).acceleration;
    for axis in 0..2 {
        let own = one.velocity[axis] * MASS / 1.0 * drifts[0][0];
        let theirs = other.velocity[axis] * MASS / 1.6 * drifts[1][0];
        near(found[axis], (own + theirs) * slope());
    }
}

/// Spray has too few neighbours in some direction for a gradient: L = Σ V x ∇W is a fifth or less there.
#[test]
fn spray_has_no_gradient_of_density() {
    let mut scheme = scheme();
    scheme.liquid.density_diffusion = 0.1;
    let lattice = |rows: std::ops::RangeInclusive<i32>| -> Vec<[f64; 2]> {
        let row = |j: i32| (-3..=3).map(move |i| [0.1 * f64::from(i), 0.1 * f64::from(j)]);
        let mut places: Vec<_> = rows.flat_map(row).collect();
        places.sort_by(|a, b| (a[0].hypot(a[1])).total_cmp(&b[0].hypot(b[1])));
        places
    };
    // a sheet of one row and a little of another has a direction in which L is small but not zero
    let mut sheet = lattice(0..=0);
    sheet.push([0.0, 0.02]);
    for (positions, has_gradient) in [(lattice(-3..=3), true), (lattice(-3..=0), true), (sheet, false)] {
        let seen: Vec<_> = positions.iter().map(|x| particle([0.0; 2], 1.0 + 0.1 * x[0], 0.0)).collect();
        let drifts = vec![[0.0; 2]; positions.len()];
        let gradient = first(&scheme, &positions, &seen, &drifts, positions.len()).density_gradient;
        if has_gradient {
            near(gradient[0], 0.1);
            near(gradient[1], 0.0);
        } else {
            assert_eq!(gradient, [0.0; 2]);
        }
    }
}

/// dρ/dt = m Σ v_ij·∇W: always where the fluid comes, and where it goes only while the two press on each other.
#[test]
fn a_wall_that_does_not_pull_does_not_thin_the_fluid() {
    let mut scheme = scheme();
    scheme.liquid.density_diffusion = 0.1;
    let search = BruteForce::new(&PAIR).unwrap();
    for (speed, pressure, counts) in
        [(3.0, 0.0, true), (3.0, 2.0, true), (-3.0, 2.0, true), (-3.0, 0.0, false)]
    {
        let seen = [particle([speed, 0.0], 1.5, pressure), particle([0.0; 2], 1.0, 0.0)];
        let rate = scheme.density_rate(&search, &ParticleStates { fluid: 1, seen: &seen }, 0).unwrap();
        near(rate, if counts { MASS * speed * slope() } else { 0.0 });
    }
}

/// δ-SPH leaves a linear density alone; a shift carries the particle along it: dρ/dt = δv·∇ρ.
#[test]
fn a_linear_density_is_not_diffused_and_shifts_follow_it() {
    let mut scheme = scheme();
    scheme.liquid.density_diffusion = 0.1;
    let search = BruteForce::new(&PAIR).unwrap();
    let gradient = [0.4, -0.3];
    let mut seen = [particle([0.0; 2], 1.0, 0.0), particle([0.0; 2], 1.0 + 0.4 * PAIR[1][0], 0.0)];
    seen.iter_mut().for_each(|seen| seen.density_gradient = gradient);
    for drift in [[0.0; 2], [0.2, 0.5]] {
        seen[0].shift_velocity = drift;
        let rate = scheme.density_rate(&search, &ParticleStates { fluid: 2, seen: &seen }, 0).unwrap();
        near(rate, drift[0] * gradient[0] + drift[1] * gradient[1]);
    }
}
