//! With what a case is simulated, and how the solver is made.

use sph_core::scalar::compact::Compact;
use sph_core::scalar::fast::Fast32;
use sph_lab::{Choice, Chosen, Emulated};

use super::case::CaseName;
use super::error::Error;
use super::solver::Solver;
use crate::engine::{Incompressible, PositionBased, Setup, Simulate, Simulation};
use crate::kernel_choice::KernelName;
use crate::output::Precision;
use crate::scalar_choice::ScalarName;

/// With what a case is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Method {
    pub(super) solver: Solver,
    pub(super) scalar: ScalarName,
    pub(super) kernel: KernelName,
}

impl Method {
    /// What is asked for, with defaults for the rest, where it can be had together.
    pub(super) fn choose(
        case: CaseName,
        dim: usize,
        solver: Option<Solver>,
        scalar: Option<ScalarName>,
        kernel: Option<KernelName>,
    ) -> Result<Self, Error> {
        let solver = solver.or(case.solver(dim)).unwrap_or(Solver::ALL[0]);
        if !case.solvers().contains(&solver) {
            return Err(Error::SolverForCase { solver, case });
        }
        let kernels = solver.kernels();
        let scalar = scalar.unwrap_or(solver.usual_scalar());
        if !solver.takes(scalar) {
            return Err(Error::ScalarForSolver { scalar, solver });
        }
        let kernel = kernel.unwrap_or(kernels[0]);
        if !kernels.contains(&kernel) {
            return Err(Error::KernelForSolver { kernel, solver });
        }
        Ok(Self { solver, scalar, kernel })
    }

    /// The fluid of a setup in a box, with a whole number of steps in `interval` where steps are equal.
    pub(super) fn simulation<const D: usize>(
        self,
        setup: &Setup<D>,
        inside: [(f64, f64); D],
        interval: f64,
    ) -> Result<Box<dyn Simulate<D>>, Error> {
        let size = inside.map(|(_, upper)| upper);
        Ok(match (self.solver, self.scalar) {
            (Solver::Wcsph, ScalarName::F32) => {
                Box::new(Simulation::<f32, D>::new(setup, self.kernel).map_err(Error::Begin)?)
            }
            (Solver::Wcsph, _) => {
                Box::new(Simulation::<f64, D>::new(setup, self.kernel).map_err(Error::Begin)?)
            }
            (Solver::Incompressible, ScalarName::F32) => {
                Box::new(Incompressible::<f32, D>::new(setup, inside, self.kernel).map_err(Error::Begin)?)
            }
            (Solver::Incompressible, _) => {
                Box::new(Incompressible::<f64, D>::new(setup, inside, self.kernel).map_err(Error::Begin)?)
            }
            (Solver::Pbf, ScalarName::F64) => self.position_based::<f64, D>(setup, size, interval)?,
            (Solver::Pbf, ScalarName::F32) => self.position_based::<f32, D>(setup, size, interval)?,
            (Solver::Pbf, ScalarName::Fast32) => self.position_based::<Fast32, D>(setup, size, interval)?,
            (Solver::Pbf, ScalarName::Fixed(format)) => {
                format.scope(|| self.position_based::<Emulated, D>(setup, size, interval))?
            }
            (Solver::Pbf, ScalarName::Mini(format)) => {
                Choice::Mini(format).scope(|| self.position_based::<Chosen, D>(setup, size, interval))?
            }
        })
    }

    fn position_based<T: Compact, const D: usize>(
        self,
        setup: &Setup<D>,
        size: [f64; D],
        interval: f64,
    ) -> Result<Box<dyn Simulate<D>>, Error> {
        match PositionBased::<T, D>::new(setup, size, interval) {
            Ok(fluid) => Ok(Box::new(fluid)),
            Err(sph_core::Error::NotRepresentable { .. }) => {
                let radii = size.map(|length| length / setup.spacing / 2.0).into_iter().fold(0.0, f64::max);
                Err(Error::BoxTooLarge { scalar: self.scalar, radii })
            }
            Err(error) => Err(Error::Begin(error)),
        }
    }

    /// Whether the density follows an equation of state, so that there is an energy of compression.
    pub(super) fn has_equation_of_state(self) -> bool {
        self.solver == Solver::Wcsph
    }

    /// Of the numbers in a frame's file: enough to go on from it with the same bits.
    pub(super) fn precision(self) -> Precision {
        match (self.solver, self.scalar) {
            (Solver::Wcsph | Solver::Incompressible, ScalarName::F32) => Precision::F32,
            _ => Precision::F64,
        }
    }

    /// Relative rounding of a sum over the particles.
    pub(super) fn rounding(self) -> f64 {
        if self.scalar == ScalarName::F64 { 1e-12 } else { 1e-4 }
    }
}
