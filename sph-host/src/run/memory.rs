//! What would not fit in memory is refused before it is built.

use super::definition::{Case, Form};
use super::error::Error;
use crate::memory;

/// Bytes for each particle of fluid or wall, fewer than any solver takes: WCSPH was measured to take 650 (three dimensions) to 770 (two).
const BYTES_A_PARTICLE: f64 = 400.0;

/// The resolution of which particles are counted to know those of another.
const PROBE: u32 = 8;

/// Refuses a case whose particles cannot fit in memory.
pub(super) fn refuse_oversize<const D: usize>(form: &Form<D>, resolution: u32) -> Result<(), Error> {
    let particles = particles(&*(form.build)(PROBE), resolution);
    let needed = particles * BYTES_A_PARTICLE;
    let available = memory::available().map_or(f64::INFINITY, |bytes| bytes as f64);
    if needed <= available {
        return Ok(());
    }
    Err(Error::TooLarge { resolution, dim: D, particles, needed, available })
}

/// About how many particles a case has at a resolution: the fluid's grow as its volume, those of the walls, which are a few layers
/// thick, as its surface.
fn particles<const D: usize>(probe: &dyn Case<D>, resolution: u32) -> f64 {
    let setup = probe.setup();
    let finer = f64::from(resolution) / f64::from(PROBE);
    let [fluid, walls] = [setup.positions.len(), setup.walls.len()].map(|count| count as f64);
    (fluid * finer + walls) * finer.powi(D as i32 - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::CaseName;

    #[test]
    fn particles_are_known_before_they_are_built() {
        for case in CaseName::ALL {
            let Some(form) = &case.definition().in_2d else { continue };
            let setup = (form.build)(40).setup();
            let found = (setup.positions.len() + setup.walls.len()) as f64;
            let expected = particles(&*(form.build)(PROBE), 40);
            assert!((expected / found - 1.0).abs() < 0.15, "{case}: {expected} for {found}");
        }
    }

    #[test]
    fn what_no_memory_holds_is_refused() {
        let form = CaseName::DamBreak.definition().in_3d.as_ref().unwrap();
        let refused = refuse_oversize(form, 100_000).unwrap_err().to_string();
        assert!(refused.contains("100000") && refused.contains("GB"), "{refused}");
    }
}
