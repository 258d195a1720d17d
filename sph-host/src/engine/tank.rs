//! A tank of water that sloshes: what the time and the instructions of a step are measured on.

use sph_core::Error;

use super::incompressible::Incompressible;
use super::setup::{Setup, StateEquation, cells, centre, jittered, walls};
use super::simulation::{Simulate, Simulation};
use crate::fast::{InstructionSet, Real};
use crate::kernel_choice::KernelName;

/// Water a metre deep in a tank a metre wide, in D dimensions.
pub struct Tank<const D: usize> {
    simulation: Box<dyn Simulate<D>>,
    /// Fluid particles.
    particles: usize,
    time: f64,
}

impl<const D: usize> Tank<D> {
    /// A tank `side` particles wide as weakly compressible SPH computes it, with the code of an instruction set.
    ///
    /// # Errors
    /// What [`Simulation::new`] reports.
    pub fn weakly_compressible<T: Real>(side: u32, level: InstructionSet) -> Result<Self, Error> {
        let setup = setup(side);
        let particles = setup.positions.len();
        let simulation = Simulation::<T, D>::new(&setup, KernelName::WendlandC2)?.at_level(level);
        Ok(Self { simulation: Box::new(simulation), particles, time: 0.0 })
    }

    /// The same as incompressible SPH computes it.
    ///
    /// # Errors
    /// What [`Incompressible::new`] reports.
    pub fn incompressible<T: Real>(side: u32, level: InstructionSet) -> Result<Self, Error> {
        let setup = setup(side);
        let particles = setup.positions.len();
        let inside = setup.upper.map(|upper| (0.0, upper - 3.0 * setup.spacing));
        let simulation = Incompressible::<T, D>::new(&setup, inside, KernelName::WendlandC2)?.at_level(level);
        Ok(Self { simulation: Box::new(simulation), particles, time: 0.0 })
    }

    /// How many particles are water.
    #[must_use]
    pub fn particles(&self) -> usize {
        self.particles
    }

    /// Computes some more seconds of the flow; returns how many steps that took.
    ///
    /// # Errors
    /// Where a particle is lost.
    pub fn advance(&mut self, seconds: f64) -> Result<u64, Box<dyn std::error::Error>> {
        let before = self.simulation.tally().steps;
        self.time += seconds;
        self.simulation.advance(self.time)?;
        Ok(self.simulation.tally().steps - before)
    }
}

/// The water before its first step.
fn setup<const D: usize>(side: u32) -> Setup<D> {
    let spacing = 1.0 / f64::from(side);
    let counts = [i64::from(side); D];
    let fluid = cells([0; D], counts);
    let place = |(k, cell): (usize, &[i64; D])| jittered(k, centre(cell, spacing), 0.1 * spacing);
    let positions: Vec<[f64; D]> = fluid.iter().enumerate().map(place).collect();
    let mut gravity = [0.0; D];
    gravity[D - 1] = -9.81;
    let mut tank = counts;
    tank[D - 1] += tank[D - 1] / 2;
    // slowly enough for lists to last several steps, as in a run
    let velocity = |x: &[f64; D]| {
        let mut velocity = [0.0; D];
        velocity[0] = 1.5 * x[D - 1];
        velocity
    };
    Setup {
        spacing,
        reach: 2.6,
        state_equation: StateEquation::Tait,
        rest_density: 1000.0,
        sound_speed: 10.0 * (2.0_f64 * 9.81).sqrt(),
        gravity,
        gravity_at: |_| {
            let mut gravity = [0.0; D];
            gravity[D - 1] = -9.81;
            gravity
        },
        artificial_viscosity: 0.03,
        kinematic_viscosity: 0.0,
        density_diffusion: 0.1,
        shift_speed: 0.0,
        velocities: positions.iter().map(velocity).collect(),
        pressures: positions.iter().map(|x| 9810.0 * (1.0 - x[D - 1])).collect(),
        positions,
        walls: walls(tank, 3, [(true, true); D], spacing),
        lower: [-3.0 * spacing; D],
        upper: tank.map(|count| (count as f64 + 3.0) * spacing),
        periodic: [false; D],
    }
}
