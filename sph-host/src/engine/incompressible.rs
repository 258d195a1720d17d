//! An incompressible liquid on threads: the core's slices with `Vec`s behind them.

use sph_core::fluid::incompressible::{Particles, Scheme, Shape, Tuning};
use sph_core::{Error, Influence};

use super::neighbourhoods::SimdKernel;
use super::setup::Setup;
use super::simulation::{RunError, Simulate, Snapshot, Tally, gather, layout, sorted};
use super::verlet_lists::VerletLists;
use crate::fast::{InstructionSet, Real};
use crate::kernel_choice::{AnyInfluence, KernelName};

mod contacts;
mod jobs;
mod summation;
#[cfg(test)]
mod tests;

use summation::SimdSummation;

/// An incompressible liquid in scalar T, its fluid kept in the order of cells.
pub(crate) struct Incompressible<T, const D: usize> {
    scheme: Scheme<T, D, AnyInfluence<T, D>>,
    gravity: fn(f64) -> [f64; D],
    time: f64,
    tally: Tally,
    /// Steps since the fluid was sorted.
    unsorted: u32,
    /// The number of each fluid particle in the setup and in snapshots.
    ids: Vec<u32>,
    positions: Vec<[T; D]>,
    velocities: Vec<[T; D]>,
    pressures: Vec<T>,
    shapes: Vec<Shape<T, D>>,
    pushes: Vec<[T; D]>,
    rates: Vec<T>,
    sources: Vec<T>,
    trial: Vec<T>,
    sums: SimdSummation<T, D>,
}

/// Steps from sorting to sorting: the fastest particle has moved three support radii.
const SORT_EVERY: u32 = 16;

/// Steps that a setup is given to settle at most: each opens a fifth of the excess.
const SETTLING_STEPS: u32 = 30;

/// The mean excess of density of a setup that has settled.
const SETTLED: f64 = 1e-4;

impl<T: Real, const D: usize> Incompressible<T, D> {
    /// The fluid of a setup, ready for its first step; what leaves `inside` is put back.
    pub(crate) fn new(setup: &Setup<D>, inside: [(f64, f64); D], kernel: KernelName) -> Result<Self, Error> {
        let number = T::from_f64;
        let support = number(setup.reach * setup.spacing);
        let influence = AnyInfluence::new(kernel, support)?;
        let volume = 1.0 / lattice_sum(&influence, setup.spacing, support.to_f64());
        let scheme = Scheme {
            rest_density: number(setup.rest_density),
            gravity: (setup.gravity_at)(0.0).map(number),
            viscosity: number(setup.artificial_viscosity * setup.sound_speed) * support * T::ratio(1, 2),
            influence,
            layout: layout(setup, support.to_f64())?,
            spacing: number(setup.spacing),
            volume: number(volume),
            inside: inside.map(|(lower, upper)| [number(lower), number(upper)]),
            tuning: Tuning::default(),
        };
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        let walls: Vec<[T; D]> = setup.walls.iter().map(narrow).collect();
        let fluid = setup.positions.len();
        let rows = VerletLists::new(*scheme.layout.domain(), support, fluid, &walls)?;
        let mut simulation = Self {
            sums: SimdSummation::new(rows, SimdKernel::new::<D>(kernel, support), walls.len()),
            scheme,
            gravity: setup.gravity_at,
            time: 0.0,
            tally: Tally::default(),
            unsorted: 0,
            ids: (0..fluid as u32).collect(),
            positions: setup.positions.iter().map(narrow).chain(walls).collect(),
            velocities: setup.velocities.iter().map(narrow).collect(),
            pressures: setup.pressures.iter().map(|&pressure| number(pressure)).collect(),
            shapes: vec![Shape::NONE; fluid],
            pushes: vec![[T::ZERO; D]; fluid],
            rates: vec![T::ZERO; fluid],
            sources: vec![T::ZERO; fluid],
            trial: vec![T::ZERO; fluid],
        };
        simulation.sort()?;
        let (scheme, mut particles) = simulation.particles();
        simulation.scheme.tuning.relaxation = scheme.estimate_relaxation(&mut particles)?;
        simulation.settle()?;
        simulation.prepare()?;
        Ok(simulation)
    }

    /// The same with the code of another instruction set: the bits are the same, the time is not.
    pub(crate) fn at_level(self, level: InstructionSet) -> Self {
        Self { sums: self.sums.at_level(level), ..self }
    }

    /// Moves particles apart that a setup has put too close together, velocities and pressures as they were: opened in the first
    /// steps of the run, the excess would become speed.
    fn settle(&mut self) -> Result<(), Error> {
        let (velocities, pressures) = (self.velocities.clone(), self.pressures.clone());
        self.pressures.fill(T::ZERO);
        self.scheme.gravity = [T::ZERO; D];
        for _ in 0..SETTLING_STEPS {
            self.velocities.fill([T::ZERO; D]);
            let (scheme, mut particles) = self.particles();
            scheme.prepare(&mut particles)?;
            let excess = |shape: &Shape<T, D>| (shape.density - T::ONE).max(T::ZERO).to_f64();
            let sum = particles.shapes.iter().map(excess).sum::<f64>();
            if sum <= SETTLED * particles.shapes.len() as f64 {
                break;
            }
            scheme.step(&mut particles, T::ONE)?;
        }
        (self.velocities, self.pressures) = (velocities, pressures);
        Ok(())
    }

    fn particles(&mut self) -> (Scheme<T, D, AnyInfluence<T, D>>, Particles<'_, T, D, SimdSummation<T, D>>) {
        let particles = Particles {
            positions: &mut self.positions,
            velocities: &mut self.velocities,
            pressures: &mut self.pressures,
            shapes: &mut self.shapes,
            pushes: &mut self.pushes,
            rates: &mut self.rates,
            sources: &mut self.sources,
            trial: &mut self.trial,
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
        gather(&mut self.pressures, &from);
        gather(&mut self.shapes, &from);
        self.sums.rows.forget();
        self.unsorted = 0;
        Ok(())
    }

    fn longest_step(&mut self) -> T {
        let (scheme, particles) = self.particles();
        scheme.longest_step(particles.greatest_speed())
    }

    fn gravity_at(&self, time: f64) -> [T; D] {
        (self.gravity)(time).map(T::from_f64)
    }
}

/// Σ W over a lattice of that spacing.
fn lattice_sum<T: Real, const D: usize>(influence: &AnyInfluence<T, D>, spacing: f64, support: f64) -> f64 {
    let reach = (support / spacing).ceil() as i64;
    let square = |cell: &[i64; D]| cell.iter().map(|&k| (k as f64 * spacing).powi(2)).sum::<f64>();
    let squares = super::cells([-reach; D], [reach + 1; D]).iter().map(square).collect::<Vec<_>>();
    let near = squares.into_iter().filter(|&square| square < support * support);
    near.map(|square| influence.influence(T::from_f64(square)).to_f64()).sum()
}

impl<T: Real, const D: usize> Simulate<D> for Incompressible<T, D> {
    fn advance(&mut self, until: f64) -> Result<(), RunError> {
        while self.time < until {
            if self.unsorted == SORT_EVERY {
                self.prepare()?;
            }
            self.scheme.gravity = self.gravity_at(self.time);
            let left = until - self.time;
            let longest = self.longest_step();
            // Equal steps for the rest of the way, so that the last one is not tiny.
            let steps = (left / longest.to_f64()).ceil().max(1.0);
            let dt = T::from_f64(left / steps);
            let time = if steps > 1.0 { self.time + dt.to_f64() } else { until };
            self.scheme.gravity = self.gravity_at(time);
            let (scheme, mut particles) = self.particles();
            let outcome = scheme.step(&mut particles, dt)?;
            self.time = time;
            self.tally.steps += 1;
            self.tally.put_back += u64::from(outcome.put_back);
            self.tally.iterations += u64::from(outcome.iterations);
            self.unsorted += 1;
        }
        Ok(())
    }

    fn prepare(&mut self) -> Result<(), Error> {
        self.sort()?;
        self.scheme.gravity = self.gravity_at(self.time);
        let (scheme, mut particles) = self.particles();
        scheme.prepare(&mut particles)
    }

    fn snapshot(&self) -> Snapshot<D> {
        let mut snapshot = Snapshot::empty(self.time, self.ids.len());
        for (k, &id) in self.ids.iter().enumerate() {
            let id = id as usize;
            snapshot.positions[id] = self.positions[k].map(T::to_f64);
            snapshot.velocities[id] = self.velocities[k].map(T::to_f64);
            snapshot.densities[id] = (self.shapes[k].density * self.scheme.rest_density).to_f64();
            snapshot.pressures[id] = self.pressures[k].to_f64();
        }
        snapshot
    }

    fn tally(&self) -> Tally {
        self.tally
    }

    fn restore(&mut self, snapshot: &Snapshot<D>, tally: Tally) {
        (self.time, self.tally) = (snapshot.time, tally);
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        for (k, &id) in self.ids.iter().enumerate() {
            let id = id as usize;
            self.positions[k] = narrow(&snapshot.positions[id]);
            self.velocities[k] = narrow(&snapshot.velocities[id]);
            self.pressures[k] = T::from_f64(snapshot.pressures[id]);
        }
    }
}
