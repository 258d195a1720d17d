//! A liquid on threads: the core's slices with `Vec`s behind them.

use sph_core::fluid::wcsph::{Forces, Limits, Particles, Scheme, Seen};
use sph_core::{CellLayout, Error, Scalar};

use super::neighbourhoods::SimdKernel;
use super::setup::Setup;
use super::summation::SimdSummation;
use super::verlet_lists::VerletLists;
use crate::fast::{InstructionSet, Real};
use crate::kernel_choice::{AnyInfluence, KernelName};

/// The fluid at one time, in f64 whatever it is computed in.
#[derive(Clone, Debug)]
pub(crate) struct Snapshot<const D: usize> {
    pub(crate) time: f64,
    pub(crate) positions: Vec<[f64; D]>,
    pub(crate) velocities: Vec<[f64; D]>,
    pub(crate) densities: Vec<f64>,
    pub(crate) pressures: Vec<f64>,
}

impl<const D: usize> Snapshot<D> {
    /// Room for so many particles.
    pub(super) fn empty(time: f64, particles: usize) -> Self {
        Self {
            time,
            positions: vec![[0.0; D]; particles],
            velocities: vec![[0.0; D]; particles],
            densities: vec![0.0; particles],
            pressures: vec![0.0; particles],
        }
    }
}

/// What a simulation counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// Steps so far.
    pub(crate) steps: u64,
    /// How often a particle was put back into the box.
    pub(crate) put_back: u64,
    /// Iterations so far, of a solver that has any.
    pub(crate) iterations: u64,
}

/// Why a run cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(crate) enum RunError {
    #[error(transparent)]
    Core(#[from] Error),
    #[error("a particle moves at {speed} m/s, more than twice the speed of sound, {sound} m/s")]
    TooFast { speed: f64, sound: f64 },
}

/// A simulation whose scalar is not known.
pub(crate) trait Simulate<const D: usize> {
    /// Steps until a time and lands on it.
    fn advance(&mut self, until: f64) -> Result<(), RunError>;

    /// Works out forces anew from positions, velocities and densities: what a resumed run begins with.
    fn prepare(&mut self) -> Result<(), Error>;

    /// The fluid now.
    fn snapshot(&self) -> Snapshot<D>;

    /// What was counted so far.
    fn tally(&self) -> Tally;

    /// Takes up a fluid that was written before.
    fn restore(&mut self, snapshot: &Snapshot<D>, tally: Tally);
}

/// A weakly compressible liquid in scalar T, its fluid kept in the order of cells.
pub(crate) struct Simulation<T, const D: usize> {
    scheme: Scheme<T, D, AnyInfluence<T, D>>,
    limits: Limits<T>,
    gravity: fn(f64) -> [f64; D],
    time: f64,
    steps: u64,
    /// Steps since the fluid was sorted.
    unsorted: u32,
    /// The number of each fluid particle in the setup and in snapshots.
    ids: Vec<u32>,
    positions: Vec<[T; D]>,
    velocities: Vec<[T; D]>,
    densities: Vec<T>,
    forces: Vec<Forces<T, D>>,
    rates: Vec<T>,
    seen: Vec<Seen<T, D>>,
    sums: SimdSummation<T, D>,
}

/// Steps from sorting to sorting.
const SORT_EVERY: u32 = 64;

impl<T: Real, const D: usize> Simulation<T, D> {
    /// The fluid of a setup, ready for its first step.
    pub(crate) fn new(setup: &Setup<D>, kernel: KernelName) -> Result<Self, Error> {
        let liquid = setup.liquid::<T>()?;
        let support = T::from_f64(setup.reach * setup.spacing);
        let scheme = Scheme {
            liquid,
            influence: AnyInfluence::new(kernel, support)?,
            layout: layout(setup, support.to_f64())?,
            mass: T::from_f64(setup.mass()),
        };
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        let walls: Vec<[T; D]> = setup.walls.iter().map(narrow).collect();
        let fluid = setup.positions.len();
        let rows = VerletLists::new(*scheme.layout.domain(), support, fluid, &walls)?;
        let of_pressure = |&pressure: &f64| liquid.equation_of_state.density(T::from_f64(pressure));
        let mut simulation = Self {
            scheme,
            limits: setup.limits(),
            gravity: setup.gravity_at,
            time: 0.0,
            steps: 0,
            unsorted: 0,
            ids: (0..fluid as u32).collect(),
            seen: vec![Seen::NONE; fluid + walls.len()],
            positions: setup.positions.iter().map(narrow).chain(walls).collect(),
            velocities: setup.velocities.iter().map(narrow).collect(),
            densities: setup.pressures.iter().map(of_pressure).collect(),
            forces: vec![Forces::NONE; fluid],
            rates: vec![T::ZERO; fluid],
            sums: SimdSummation::new(rows, SimdKernel::new::<D>(kernel, support)),
        };
        simulation.prepare()?;
        Ok(simulation)
    }

    /// The same with the code of another instruction set: the bits are the same, the time is not.
    pub(crate) fn at_level(self, level: InstructionSet) -> Self {
        Self { sums: self.sums.at_level(level), ..self }
    }

    fn particles(&mut self) -> (Scheme<T, D, AnyInfluence<T, D>>, Particles<'_, T, D, SimdSummation<T, D>>) {
        let particles = Particles {
            positions: &mut self.positions,
            velocities: &mut self.velocities,
            densities: &mut self.densities,
            forces: &mut self.forces,
            rates: &mut self.rates,
            seen: &mut self.seen,
            sums: &mut self.sums,
        };
        (self.scheme, particles)
    }

    /// Sorts the fluid by cells, and by number in each: an order that follows from the positions alone.
    fn sort(&mut self) -> Result<(), Error> {
        let (ids, from) = sorted(&self.ids, &self.positions, &self.sums.rows)?;
        self.ids = ids;
        gather(&mut self.positions, &from);
        gather(&mut self.velocities, &from);
        gather(&mut self.densities, &from);
        gather(&mut self.forces, &from);
        gather(&mut self.seen, &from);
        self.sums.rows.forget();
        self.unsorted = 0;
        Ok(())
    }
}

/// The numbers of particles in the order of their cells, and where each of them was.
pub(super) fn sorted<T: Real, const D: usize>(
    ids: &[u32],
    positions: &[[T; D]],
    rows: &VerletLists<T, D>,
) -> Result<(Vec<u32>, Vec<usize>), Error> {
    let mut place = vec![0_u32; ids.len()];
    for (k, &id) in ids.iter().enumerate() {
        place[id as usize] = k as u32;
    }
    let by_id: Vec<[T; D]> = place.iter().map(|&k| positions[k as usize]).collect();
    let ids = rows.order(&by_id)?;
    let from = ids.iter().map(|&id| place[id as usize] as usize).collect();
    Ok((ids, from))
}

/// values[k] = old values[from[k]], for as many as `from` has.
pub(super) fn gather<U: Copy>(values: &mut [U], from: &[usize]) {
    let gathered: Vec<U> = from.iter().map(|&k| values[k]).collect();
    values[..gathered.len()].copy_from_slice(&gathered);
}

/// SortedCells of this width, over the box of the setup.
pub(crate) fn layout<T: Scalar, const D: usize>(
    setup: &Setup<D>,
    width: f64,
) -> Result<CellLayout<T, D>, Error> {
    let counts = std::array::from_fn(|axis| {
        ((setup.upper[axis] - setup.lower[axis]) / width).floor().clamp(1.0, 1e6) as u32
    });
    let (lower, upper) = (setup.lower.map(T::from_f64), setup.upper.map(T::from_f64));
    let mut layout = CellLayout::bounded(&lower, &upper, counts)?;
    for axis in (0..D).filter(|&axis| setup.periodic[axis]) {
        layout = layout.periodic(axis, lower[axis], upper[axis])?;
    }
    Ok(layout)
}

impl<T: Real, const D: usize> Simulate<D> for Simulation<T, D> {
    fn advance(&mut self, until: f64) -> Result<(), RunError> {
        while self.time < until {
            if self.unsorted == SORT_EVERY {
                self.sort()?;
            }
            self.scheme.liquid.gravity = (self.gravity)(self.time).map(T::from_f64);
            let (limits, left) = (self.limits, until - self.time);
            let (scheme, mut particles) = self.particles();
            let (speed, acceleration) = particles.extremes();
            let sound = scheme.liquid.equation_of_state.sound_speed();
            if speed > sound.times(2) {
                return Err(RunError::TooFast { speed: speed.to_f64(), sound: sound.to_f64() });
            }
            let longest = scheme.longest_step(&limits, speed, acceleration).to_f64();
            // Equal steps for the rest of the way, so that the last one is not tiny.
            let steps = (left / longest).ceil().max(1.0);
            let dt = T::from_f64(left / steps);
            scheme.step(&mut particles, dt)?;
            self.time = if steps > 1.0 { self.time + dt.to_f64() } else { until };
            self.steps += 1;
            self.unsorted += 1;
        }
        Ok(())
    }

    fn prepare(&mut self) -> Result<(), Error> {
        self.sort()?;
        self.scheme.liquid.gravity = (self.gravity)(self.time).map(T::from_f64);
        let (scheme, mut particles) = self.particles();
        scheme.prepare(&mut particles)
    }

    fn snapshot(&self) -> Snapshot<D> {
        let mut snapshot = Snapshot::empty(self.time, self.ids.len());
        for (k, &id) in self.ids.iter().enumerate() {
            let id = id as usize;
            snapshot.positions[id] = self.positions[k].map(T::to_f64);
            snapshot.velocities[id] = self.velocities[k].map(T::to_f64);
            snapshot.densities[id] = self.densities[k].to_f64();
            snapshot.pressures[id] = self.seen[k].pressure.to_f64();
        }
        snapshot
    }

    fn tally(&self) -> Tally {
        Tally { steps: self.steps, ..Tally::default() }
    }

    fn restore(&mut self, snapshot: &Snapshot<D>, tally: Tally) {
        (self.time, self.steps) = (snapshot.time, tally.steps);
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        for (k, &id) in self.ids.iter().enumerate() {
            let id = id as usize;
            self.positions[k] = narrow(&snapshot.positions[id]);
            self.velocities[k] = narrow(&snapshot.velocities[id]);
            self.densities[k] = T::from_f64(snapshot.densities[id]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::setup::column;

    #[test]
    fn a_particle_faster_than_twice_sound_is_lost() {
        let (mut setup, _) = column();
        for (speed, is_lost) in [(1.99, false), (2.01, true)] {
            setup.velocities[7] = [-speed * setup.sound_speed, 0.0];
            let mut simulation = Simulation::<f64, 2>::new(&setup, KernelName::WendlandC2).unwrap();
            match simulation.advance(1e-9) {
                Err(RunError::TooFast { speed, sound }) => {
                    assert!(is_lost && sound == setup.sound_speed, "{speed}");
                    assert_eq!(speed, 2.01 * sound);
                }
                other => assert!(other == Ok(()) && !is_lost, "{other:?}"),
            }
        }
    }
}
