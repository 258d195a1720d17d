//! A liquid on threads: the core's slices with `Vec`s behind them.

use rayon::prelude::*;
use sph_core::fluid::wcsph::{Executor, Forces, Limits, Particles, Scheme, Seen, WallState};
use sph_core::{CellLayout, Error, Influence, Scalar};

use super::rows::{Finder, MARGIN};
use super::setup::Setup;

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

/// Why a run cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub(super) enum Lost {
    #[error(transparent)]
    Core(#[from] Error),
    #[error("a particle moves at {speed} m/s, more than twice the speed of sound, {sound} m/s")]
    TooFast { speed: f64, sound: f64 },
}

/// A simulation whose scalar is not known.
pub(super) trait Simulate<const D: usize> {
    /// Steps until a time and lands on it.
    fn advance(&mut self, until: f64) -> Result<(), Lost>;

    /// Works out forces anew from positions, velocities and densities: what a resumed run begins with.
    fn prepare(&mut self) -> Result<(), Error>;

    /// The fluid now.
    fn snapshot(&self) -> Snapshot<D>;

    /// Steps so far.
    fn steps(&self) -> u64;

    /// Takes up a fluid that was written before.
    fn restore(&mut self, snapshot: &Snapshot<D>, steps: u64);
}

/// A weakly compressible liquid in scalar T, its fluid kept in the order of cells.
pub(super) struct Simulation<T, const D: usize, W> {
    scheme: Scheme<T, D, W>,
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
    pressures: Vec<T>,
    forces: Vec<Forces<T, D>>,
    drifts: Vec<[T; D]>,
    rates: Vec<T>,
    walls: Vec<WallState<T, D>>,
    seen: Vec<Seen<T, D>>,
    finder: Finder<T, D>,
}

/// Steps from sorting to sorting.
const SORT_EVERY: u32 = 64;

impl<T: Scalar, const D: usize, W: Influence<T, D> + Copy + Sync> Simulation<T, D, W> {
    /// The fluid of a setup, ready for its first step; `influence` makes W for a support radius.
    pub(super) fn new(
        setup: &Setup<D>,
        influence: impl FnOnce(T) -> Result<W, Error>,
    ) -> Result<Self, Error> {
        let liquid = setup.liquid::<T>()?;
        let support = setup.reach * setup.spacing;
        let by_rows = !setup.periodic.contains(&true);
        let scheme = Scheme {
            liquid,
            influence: influence(T::from_f64(support))?,
            layout: layout(setup, if by_rows { support * (1.0 + MARGIN) } else { support })?,
            mass: T::from_f64(setup.mass()),
        };
        let (fluid, walls) = (setup.positions.len(), setup.walls.len());
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        let rest = WallState {
            pressure: T::ZERO,
            density: liquid.equation_of_state.rest_density(),
            velocity: [T::ZERO; D],
        };
        let of_pressure = |&pressure: &f64| liquid.equation_of_state.density(T::from_f64(pressure));
        let rows_for = by_rows.then_some(T::from_f64(support));
        let mut simulation = Self {
            scheme,
            limits: setup.limits(),
            gravity: setup.gravity_at,
            time: 0.0,
            steps: 0,
            unsorted: 0,
            ids: (0..fluid as u32).collect(),
            positions: setup.positions.iter().chain(&setup.walls).map(narrow).collect(),
            velocities: setup.velocities.iter().map(narrow).collect(),
            densities: setup.pressures.iter().map(of_pressure).collect(),
            pressures: vec![T::ZERO; fluid],
            forces: vec![Forces::NONE; fluid],
            drifts: vec![[T::ZERO; D]; fluid],
            rates: vec![T::ZERO; fluid],
            walls: vec![rest; walls],
            seen: vec![Seen::NONE; fluid + walls],
            finder: Finder::new(fluid + walls, scheme.layout.cells(), rows_for),
        };
        simulation.prepare()?;
        Ok(simulation)
    }

    fn particles(&mut self) -> (Scheme<T, D, W>, Particles<'_, T, D, &mut Finder<T, D>>) {
        let particles = Particles {
            positions: &mut self.positions,
            velocities: &mut self.velocities,
            densities: &mut self.densities,
            pressures: &mut self.pressures,
            forces: &mut self.forces,
            drifts: &mut self.drifts,
            rates: &mut self.rates,
            walls: &mut self.walls,
            seen: &mut self.seen,
            search: &mut self.finder,
        };
        (self.scheme, particles)
    }

    /// Sorts the fluid by cells, and by number in each: an order that follows from the positions alone.
    fn sort(&mut self) -> Result<(), Error> {
        let mut place = vec![0_u32; self.ids.len()];
        for (k, &id) in self.ids.iter().enumerate() {
            place[id as usize] = k as u32;
        }
        let by_id: Vec<[T; D]> = place.iter().map(|&k| self.positions[k as usize]).collect();
        self.ids = self.finder.order(&self.scheme.layout, &by_id)?;
        let from: Vec<usize> = self.ids.iter().map(|&id| place[id as usize] as usize).collect();
        gather(&mut self.positions, &from);
        gather(&mut self.velocities, &from);
        gather(&mut self.densities, &from);
        gather(&mut self.pressures, &from);
        gather(&mut self.forces, &from);
        self.finder.forget();
        self.unsorted = 0;
        Ok(())
    }
}

/// values[k] = old values[from[k]], for as many as `from` has.
fn gather<U: Copy>(values: &mut [U], from: &[usize]) {
    let gathered: Vec<U> = from.iter().map(|&k| values[k]).collect();
    values[..gathered.len()].copy_from_slice(&gathered);
}

/// Cells of this width, over the box of the setup.
pub(super) fn layout<T: Scalar, const D: usize>(
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

impl<T: Scalar, const D: usize, W: Influence<T, D> + Copy + Sync> Simulate<D> for Simulation<T, D, W> {
    fn advance(&mut self, until: f64) -> Result<(), Lost> {
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
                return Err(Lost::TooFast { speed: speed.to_f64(), sound: sound.to_f64() });
            }
            let longest = scheme.longest_step(&limits, speed, acceleration).to_f64();
            // Equal steps for the rest of the way, so that the last one is not tiny.
            let steps = (left / longest).ceil().max(1.0);
            let dt = T::from_f64(left / steps);
            scheme.step(&mut particles, dt, &Threads)?;
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
        scheme.prepare(&mut particles, &Threads)
    }

    fn snapshot(&self) -> Snapshot<D> {
        let fluid = self.ids.len();
        let mut snapshot = Snapshot {
            time: self.time,
            positions: vec![[0.0; D]; fluid],
            velocities: vec![[0.0; D]; fluid],
            densities: vec![0.0; fluid],
            pressures: vec![0.0; fluid],
        };
        for (k, &id) in self.ids.iter().enumerate() {
            let id = id as usize;
            snapshot.positions[id] = self.positions[k].map(T::to_f64);
            snapshot.velocities[id] = self.velocities[k].map(T::to_f64);
            snapshot.densities[id] = self.densities[k].to_f64();
            snapshot.pressures[id] = self.pressures[k].to_f64();
        }
        snapshot
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn restore(&mut self, snapshot: &Snapshot<D>, steps: u64) {
        (self.time, self.steps) = (snapshot.time, steps);
        let narrow = |vector: &[f64; D]| vector.map(T::from_f64);
        for (k, &id) in self.ids.iter().enumerate() {
            let id = id as usize;
            self.positions[k] = narrow(&snapshot.positions[id]);
            self.velocities[k] = narrow(&snapshot.velocities[id]);
            self.densities[k] = T::from_f64(snapshot.densities[id]);
        }
    }
}
