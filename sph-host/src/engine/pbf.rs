//! A position-based fluid with SI units around it.
//!
//! The solver counts lengths in h, two spacings, and time in frames. A frame here is as long as keeps the fluid as little
//! compressed as it is made for: g Δt²/h times the depth in spacings is [`WEIGHT`]. f32 and fixed point come back from f64 to the
//! same bits, so a frame file holds the whole state.

use sph_core::fluid::{BorrowedFluid, Container, OpenBox, Particle, Settings};
use sph_core::kernel::{Kernel, Poly6, normalisation};
use sph_core::scalar::compact::Compact;
use sph_core::vector::{norm_squared, scale};
use sph_core::{CellGrid, CellLayout, Error, Neighbours, Parameter};

use super::setup::Setup;
use super::simulation::{RunError, Simulate, Snapshot, Tally};
use crate::parallel;

/// Acceleration in h a frame² times depth in spacings, as in the solver's documentation: 0.005 at twelve spacings.
const WEIGHT: f64 = 0.06;

/// A position-based fluid in scalar T, in a box.
pub(crate) struct PositionBased<T: Compact, const D: usize> {
    walls: OpenBox<T, D>,
    particles: Vec<Particle<T, D>>,
    starts: Vec<u32>,
    gravity: fn(f64) -> [f64; D],
    /// h in metres, Δt in seconds.
    unit: f64,
    dt: f64,
    steps: u64,
    rest_density: f64,
}

impl<T: Compact, const D: usize> PositionBased<T, D> {
    /// The fluid of a setup in a box of this size, with a whole number of frames in `interval`.
    ///
    /// # Errors
    /// [`Error::NotRepresentable`] where the box is too large for the scalar, and what [`BorrowedFluid::new`] reports.
    pub(crate) fn new(setup: &Setup<D>, size: [f64; D], interval: f64) -> Result<Self, Error> {
        let unit = 2.0 * setup.spacing;
        let in_units = size.map(|length| T::from_f64(length / unit));
        for (stored, length) in in_units.iter().zip(size) {
            if (stored.to_f64() * unit / length - 1.0).abs() > 1e-3 {
                return Err(Error::NotRepresentable { parameter: Parameter::Position });
            }
        }
        let depth = setup.positions.iter().map(|x| x[D - 1]).fold(0.0, f64::max) / setup.spacing;
        let gravity = norm_squared(&setup.gravity).sqrt();
        let longest = (WEIGHT / depth.max(1.0) * unit / gravity).sqrt();
        let cells: usize = in_units.iter().map(|length| length.floor_to_i32().max(0) as usize + 1).product();
        let mut fluid = Self {
            walls: OpenBox::try_new(in_units)?,
            particles: Vec::new(),
            starts: vec![0; cells],
            gravity: setup.gravity_at,
            unit,
            dt: interval / (interval / longest).ceil(),
            steps: 0,
            rest_density: setup.rest_density,
        };
        let at_rest = setup.positions.iter().zip(&setup.velocities);
        fluid.particles = at_rest.map(|(x, v)| fluid.particle(x, v, 0.0)).collect();
        fluid.solver()?;
        Ok(fluid)
    }

    /// Seconds of a frame.
    pub(crate) fn frame(&self) -> f64 {
        self.dt
    }

    /// Positions in m and velocities in m/s.
    pub(crate) fn motion(&self) -> (Vec<[f64; D]>, Vec<[f64; D]>) {
        let speed = self.unit / self.dt;
        let positions = self.particles.iter().map(|p| p.position().map(|x| x.to_f64() * self.unit));
        let velocities = self.particles.iter().map(|p| p.velocity().map(|v| v.to_f64() * speed));
        (positions.collect(), velocities.collect())
    }

    fn particle(&self, position: &[f64; D], velocity: &[f64; D], pressure: f64) -> Particle<T, D> {
        let position = position.map(|x| T::from_f64(x / self.unit));
        let velocity = velocity.map(|v| T::from_f64(v / (self.unit / self.dt)));
        Particle::new(position, velocity).with_pressure(T::from_f64(pressure))
    }

    fn solver(&mut self) -> Result<BorrowedFluid<'_, T, OpenBox<T, D>, D>, Error> {
        BorrowedFluid::new(&self.walls, Settings::DEFAULT, &mut self.particles, &mut self.starts)
    }

    /// ρ/ρ₀ of each particle: the kernel's sum over the fluid, and the walls' share.
    fn densities(&self) -> Option<Vec<f64>> {
        let positions: Vec<[f64; D]> =
            self.particles.iter().map(|particle| particle.position().map(T::to_f64)).collect();
        let size = Container::<T, D>::size(&self.walls).map(T::to_f64);
        let counts = size.map(|length| length.floor().max(1.0) as u32);
        let layout = CellLayout::bounded(&[0.0; D], &size, counts).ok()?;
        let mut starts = vec![0_u32; layout.cells() + 1];
        let mut entries = vec![0_u32; positions.len()];
        let search = CellGrid::build(layout, &positions, &mut starts, &mut entries).ok()?;
        let volume = 0.5_f64.powi(D as i32) * normalisation::<Poly6>(D as u32);
        let mut densities = vec![0.0; positions.len()];
        parallel::fill(&mut densities, |i| {
            let mut sum = 0.0;
            search.for_each(&positions[i], 1.0, |neighbour| {
                sum += Poly6::profile(neighbour.distance_squared.sqrt())
            });
            let wall = self.walls.wall(&self.particles[i].position().map(T::near));
            let share = wall.map_or(T::ZERO, |wall| T::from_near(wall.share));
            volume * sum + share.to_f64()
        });
        Some(densities)
    }
}

impl<T: Compact, const D: usize> Simulate<D> for PositionBased<T, D> {
    fn advance(&mut self, until: f64) -> Result<(), RunError> {
        let wanted = (until / self.dt).round() as u64;
        let (gravity, dt, to_units, first) =
            (self.gravity, self.dt, self.dt * self.dt / self.unit, self.steps);
        let mut solver = self.solver()?;
        for step in first..wanted {
            let acceleration = scale(&gravity(step as f64 * dt), to_units);
            solver.step(acceleration.map(T::from_f64));
        }
        self.steps = wanted.max(first);
        Ok(())
    }

    fn prepare(&mut self) -> Result<(), Error> {
        // what a frame's file holds, and no more
        self.restore(&self.snapshot(), self.tally());
        self.solver().map(drop)
    }

    fn snapshot(&self) -> Snapshot<D> {
        let (positions, velocities) = self.motion();
        let densities = self.densities().unwrap_or_else(|| vec![f64::NAN; self.particles.len()]);
        Snapshot {
            time: self.steps as f64 * self.dt,
            positions,
            velocities,
            densities: densities.iter().map(|density| density * self.rest_density).collect(),
            pressures: self.particles.iter().map(|p| p.pressure().to_f64()).collect(),
        }
    }

    fn tally(&self) -> Tally {
        Tally { steps: self.steps, ..Tally::default() }
    }

    fn restore(&mut self, snapshot: &Snapshot<D>, tally: Tally) {
        self.steps = tally.steps;
        let states = snapshot.positions.iter().zip(&snapshot.velocities).zip(&snapshot.pressures);
        self.particles = states.map(|((x, v), &p)| self.particle(x, v, p)).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::setup::column;
    use sph_core::scalar::fixed::{I8F24, I16F16, Saturating};

    fn check<T: Compact>() {
        let (setup, size) = column();
        let mut fluid = PositionBased::<T, 2>::new(&setup, size, 0.01).unwrap();
        let mut again = PositionBased::<T, 2>::new(&setup, size, 0.01).unwrap();
        fluid.advance(0.1).unwrap();
        let snapshot = fluid.snapshot();
        again.restore(&snapshot, fluid.tally());
        fluid.advance(0.2).unwrap();
        again.advance(0.2).unwrap();
        let [one, other] = [&fluid, &again].map(|fluid| fluid.snapshot());
        assert_eq!(one.positions, other.positions, "{}", T::NAME);
        assert_eq!(one.velocities, other.velocities, "{}", T::NAME);
        assert_ne!(one.positions, snapshot.positions);
        // on the whole it falls, and slower than freely
        let mut early = PositionBased::<T, 2>::new(&setup, size, 0.01).unwrap();
        early.advance(0.03).unwrap();
        let mean =
            early.snapshot().velocities.iter().map(|v| v[1]).sum::<f64>() / setup.positions.len() as f64;
        assert!((-0.3..-0.05).contains(&mean), "{}: {mean}", T::NAME);
    }

    #[test]
    fn a_snapshot_is_the_whole_state_and_seconds_are_seconds() {
        check::<f32>();
        check::<Saturating<I16F16>>();
        check::<Saturating<I8F24>>();
    }

    #[test]
    fn an_emulated_fluid_moves_as_the_compiled_one() {
        fn positions<T: Compact>() -> Vec<[f64; 2]> {
            let (setup, size) = column();
            let mut fluid = PositionBased::<T, 2>::new(&setup, size, 0.01).unwrap();
            fluid.advance(0.2).unwrap();
            fluid.snapshot().positions
        }
        let emulated = |name: &str| {
            let format: sph_lab::Format = name.parse().unwrap();
            // whose thread it is does not matter as long as each enters the format
            let pool = rayon::ThreadPoolBuilder::new().num_threads(2).start_handler(move |_| format.enter());
            pool.build().unwrap().install(positions::<sph_lab::Emulated>)
        };
        assert_eq!(emulated("i16f16"), positions::<Saturating<I16F16>>());
        assert_eq!(emulated("i8f24"), positions::<Saturating<I8F24>>());
        assert_ne!(emulated("i24f8"), positions::<Saturating<I8F24>>());
    }

    #[test]
    fn a_box_that_the_scalar_cannot_hold_is_refused() {
        use sph_core::scalar::fixed::I4F28;
        let (setup, size) = column();
        let refused = PositionBased::<Saturating<I4F28>, 2>::new(&setup, size, 0.01);
        assert!(matches!(refused.map(drop), Err(Error::NotRepresentable { .. })));
    }
}
