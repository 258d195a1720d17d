//! A liquid on threads: the core's slices with `Vec`s behind them.

use rayon::prelude::*;
use sph_core::fluid::wcsph::{Executor, Forces, Limits, Particles, Scheme, WallState};
use sph_core::{CellLayout, Error, Scalar};

use super::setup::Setup;
use crate::kernel_choice::{AnyInfluence, KernelName};

/// Spread over rayon's threads.
struct Threads;

/// Particles that a thread takes at least.
const SHARE: usize = 64;

impl Executor for Threads {
    fn fill<U: Send>(&self, out: &mut [U], f: impl Fn(usize) -> U + Sync) {
        out.par_iter_mut().with_min_len(SHARE).enumerate().for_each(|(i, slot)| *slot = f(i));
    }
}

/// The fluid at one time, in f64 whatever it is computed in.
#[derive(Clone, Debug)]
pub(super) struct Snapshot<const D: usize> {
    pub(super) time: f64,
    pub(super) positions: Vec<[f64; D]>,
    pub(super) velocities: Vec<[f64; D]>,
    pub(super) densities: Vec<f64>,
    pub(super) pressures: Vec<f64>,
}

/// A simulation whose scalar is not known.
pub(super) trait Simulate<const D: usize> {
    /// Steps until a time and lands on it.
    fn advance(&mut self, until: f64) -> Result<(), Error>;

    /// Works out forces anew from positions, velocities and densities: what a resumed run begins with.
    fn prepare(&mut self) -> Result<(), Error>;

    /// The fluid now.
    fn snapshot(&self) -> Snapshot<D>;

    /// Steps so far.
    fn steps(&self) -> u64;

    /// Takes up a fluid that was written before.
    fn restore(&mut self, snapshot: &Snapshot<D>, steps: u64);
}

/// A weakly compressible liquid in scalar T.
pub(super) struct Simulation<T, const D: usize> {
    scheme: Scheme<T, D, AnyInfluence<T, D>>,
    limits: Limits<T>,
    time: f64,
    steps: u64,
    positions: Vec<[T; D]>,
    velocities: Vec<[T; D]>,
    densities: Vec<T>,
    pressures: Vec<T>,
    forces: Vec<Forces<T, D>>,
    drifts: Vec<[T; D]>,
    rates: Vec<T>,
    walls: Vec<WallState<T, D>>,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl<T: Scalar, const D: usize> Simulation<T, D> {
    /// The fluid of a setup, ready for its first step.
    pub(super) fn new(setup: &Setup<D>, kernel: KernelName) -> Result<Self, Error> {
        let liquid = setup.liquid::<T>()?;
        let support = setup.reach * setup.spacing;
        let scheme = Scheme {
            liquid,
            influence: AnyInfluence::new(kernel, T::from_f64(support))?,
            layout: layout(setup, support)?,
            mass: T::from_f64(setup.mass()),
        };
        let (fluid, walls) = (setup.positions.len(), setup.walls.len());
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        let rest = WallState {
            pressure: T::ZERO,
            density: liquid.equation_of_state.rest_density(),
            velocity: [T::ZERO; D],
        };
        let mut velocities: Vec<_> = setup.velocities.iter().map(narrow).collect();
        velocities.resize(fluid + walls, [T::ZERO; D]);
        let of_pressure = |&pressure: &f64| liquid.equation_of_state.density(T::from_f64(pressure));
        let mut densities: Vec<_> = setup.pressures.iter().map(of_pressure).collect();
        densities.resize(fluid + walls, rest.density);
        let mut simulation = Self {
            scheme,
            limits: setup.limits(),
            time: 0.0,
            steps: 0,
            positions: setup.positions.iter().chain(&setup.walls).map(narrow).collect(),
            velocities,
            densities,
            pressures: vec![T::ZERO; fluid + walls],
            forces: vec![Forces::NONE; fluid],
            drifts: vec![[T::ZERO; D]; fluid],
            rates: vec![T::ZERO; fluid],
            walls: vec![rest; walls],
            starts: vec![0; scheme.layout.cells() + 1],
            entries: vec![0; fluid + walls],
        };
        simulation.prepare()?;
        Ok(simulation)
    }

    fn particles(&mut self) -> (Scheme<T, D, AnyInfluence<T, D>>, Particles<'_, T, D, u32>) {
        let particles = Particles {
            positions: &mut self.positions,
            velocities: &mut self.velocities,
            densities: &mut self.densities,
            pressures: &mut self.pressures,
            forces: &mut self.forces,
            drifts: &mut self.drifts,
            rates: &mut self.rates,
            walls: &mut self.walls,
            starts: &mut self.starts,
            entries: &mut self.entries,
        };
        (self.scheme, particles)
    }
}

/// Cells as wide as the support, over the box of the setup.
pub(super) fn layout<T: Scalar, const D: usize>(
    setup: &Setup<D>,
    support: f64,
) -> Result<CellLayout<T, D>, Error> {
    let counts = std::array::from_fn(|axis| {
        ((setup.upper[axis] - setup.lower[axis]) / support).floor().clamp(1.0, 1e6) as u32
    });
    let (lower, upper) = (setup.lower.map(T::from_f64), setup.upper.map(T::from_f64));
    let mut layout = CellLayout::bounded(&lower, &upper, counts)?;
    for axis in (0..D).filter(|&axis| setup.periodic[axis]) {
        layout = layout.periodic(axis, lower[axis], upper[axis])?;
    }
    Ok(layout)
}

impl<T: Scalar, const D: usize> Simulate<D> for Simulation<T, D> {
    fn advance(&mut self, until: f64) -> Result<(), Error> {
        while self.time < until {
            let (limits, left) = (self.limits, until - self.time);
            let (scheme, mut particles) = self.particles();
            let longest = scheme.stable_step(&particles, &limits).to_f64();
            // Equal steps for the rest of the way, so that the last one is not tiny.
            let steps = (left / longest).ceil().max(1.0);
            let dt = T::from_f64(left / steps);
            scheme.step(&mut particles, dt, &Threads)?;
            self.time = if steps > 1.0 { self.time + dt.to_f64() } else { until };
            self.steps += 1;
        }
        Ok(())
    }

    fn prepare(&mut self) -> Result<(), Error> {
        let (scheme, mut particles) = self.particles();
        scheme.prepare(&mut particles, &Threads)
    }

    fn snapshot(&self) -> Snapshot<D> {
        let fluid = self.forces.len();
        let wide = |vectors: &[[T; D]]| vectors.iter().map(|vector| vector.map(T::to_f64)).collect();
        let wide_scalars = |values: &[T]| values.iter().map(|value| value.to_f64()).collect();
        Snapshot {
            time: self.time,
            positions: wide(&self.positions[..fluid]),
            velocities: wide(&self.velocities[..fluid]),
            densities: wide_scalars(&self.densities[..fluid]),
            pressures: wide_scalars(&self.pressures[..fluid]),
        }
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn restore(&mut self, snapshot: &Snapshot<D>, steps: u64) {
        (self.time, self.steps) = (snapshot.time, steps);
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        for (to, from) in self.positions.iter_mut().zip(&snapshot.positions) {
            *to = narrow(from);
        }
        for (to, from) in self.velocities.iter_mut().zip(&snapshot.velocities) {
            *to = narrow(from);
        }
        for (to, &from) in self.densities.iter_mut().zip(&snapshot.densities) {
            *to = T::from_f64(from);
        }
    }
}
