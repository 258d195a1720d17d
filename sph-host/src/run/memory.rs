//! What would not fit in memory is refused before it is built.

use super::definition::Form;
use super::error::Error;
use super::solver::Solver;
use crate::memory;

/// Bytes for each particle of fluid or wall. Measured: 650 (three dimensions) to 770 (two) with WCSPH, 1100 to 1150 with the
/// incompressible solver, which keeps all pairs for a step.
fn bytes_a_particle(solver: Solver) -> f64 {
    match solver {
        Solver::Incompressible => 1000.0,
        Solver::Wcsph | Solver::Pbf => 600.0,
    }
}

/// The resolution of which particles are counted, and twice it, to know those of another.
const PROBE: u32 = 16;

/// Refuses a case whose particles cannot fit in memory.
pub(super) fn refuse_oversize<const D: usize>(
    form: &Form<D>,
    resolution: u32,
    solver: Solver,
) -> Result<(), Error> {
    let particles = particles(form, resolution);
    let needed = particles * bytes_a_particle(solver);
    let Some(available) = memory::short_of(needed) else { return Ok(()) };
    Err(Error::TooLarge { resolution, dim: D, particles, needed, available })
}

/// About how many particles a case has at a resolution: those of the fluid and those of its walls each grow by the power that
/// two coarse resolutions show.
fn particles<const D: usize>(form: &Form<D>, resolution: u32) -> f64 {
    let count = |resolution| {
        let setup = (form.build)(resolution).setup();
        [setup.positions.len() as f64, setup.walls.len() as f64]
    };
    let (coarse, fine) = (count(PROBE), count(2 * PROBE));
    let finer = f64::from(resolution) / f64::from(2 * PROBE);
    let grown = |(coarse, fine): (f64, f64)| fine * finer.powf((fine / coarse.max(1.0)).max(1.0).log2());
    coarse.into_iter().zip(fine).map(grown).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::CaseName;

    fn are_known<const D: usize>(case: CaseName, form: Option<&Form<D>>) {
        let Some(form) = form else { return };
        let setup = (form.build)(48).setup();
        let found = (setup.positions.len() + setup.walls.len()) as f64;
        let expected = particles(form, 48);
        assert!((expected / found - 1.0).abs() < 0.05, "{case} in {D} dimensions: {expected} for {found}");
    }

    #[test]
    fn particles_are_known_before_they_are_built() {
        for case in CaseName::ALL {
            are_known(*case, case.definition().in_2d.as_ref());
            are_known(*case, case.definition().in_3d.as_ref());
        }
    }

    #[test]
    fn what_no_memory_holds_is_refused() {
        let form = CaseName::DamBreak.definition().in_3d.as_ref().unwrap();
        let refused = refuse_oversize(form, 100_000, Solver::Incompressible).unwrap_err().to_string();
        assert!(refused.contains("100000") && refused.contains("GB"), "{refused}");
    }
}
