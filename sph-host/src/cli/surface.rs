//! `--surface`: words to a surface of the result, written to a file.

use super::failure::Failure;
use super::say;
use crate::output::{self, Content, Format, SurfaceError, Table, Target};
use crate::sample::SamplePoints;

/// A column of the result and the value that it has on the surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SurfaceWords {
    pub(super) column: String,
    level: f64,
}

/// A name, which may have `=` in it, and a finite number behind the last one.
pub(super) fn words(text: &str) -> Result<SurfaceWords, String> {
    let parts = text.rsplit_once('=').map(|(column, level)| (column.trim(), level.trim().parse::<f64>()));
    match parts {
        Some((column, Ok(level))) if !column.is_empty() && level.is_finite() => {
            Ok(SurfaceWords { column: column.to_owned(), level })
        }
        _ => Err(String::from(
            "expected NAME=LEVEL, the name of a column and a finite number, such as density=500",
        )),
    }
}

impl SurfaceWords {
    /// That there is a grid in space, and a file to write to, before anything is read.
    pub(super) fn check(&self, at: &SamplePoints, target: Option<&Target>) -> Result<(), Failure> {
        let counts: &[usize] = if let SamplePoints::Grid { counts, .. } = at { counts } else { &[] };
        if counts.len() != 3 || counts.contains(&1) {
            return Err(Failure::usage(
                "--surface needs a grid in space, at least two cells along each axis: --grid NX,NY,NZ",
            ));
        }
        if target.is_none() {
            let endings = output::FORMATS.iter().filter(|format| format.holds.contains(&Content::Surface));
            let files: Vec<String> = endings.map(|format| format!("--out FILE{}", format.ending)).collect();
            return Err(Failure::usage(format!(
                "--surface writes triangles to a file: {}",
                files.join(" or ")
            )));
        }
        Ok(())
    }

    /// Takes the surface of the result and writes it.
    pub(super) fn write(&self, table: &Table, target: &Target) -> Result<(), Failure> {
        let surface = table.surface(&self.column, self.level).map_err(|error| explain(&error))?;
        let coarse = surface
            .coarse()
            .filter(|_| Format::of(&target.path).is_some_and(|format| format.ending == ".ply"));
        for warning in surface.warnings.iter().chain(&coarse) {
            let advice = match warning {
                output::SurfaceWarning::Border { .. } => "; a larger --bounds may close it",
                _ => "",
            };
            say(&format!("warning: {warning}{advice}"));
        }
        Ok(output::write_surface(&surface, target)?)
    }
}

fn explain(error: &SurfaceError) -> Failure {
    let advice = match error {
        SurfaceError::NotCrossed { .. } => ": choose a LEVEL in between",
        _ => "",
    };
    Failure::input(format!("--surface: {error}{advice}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_is_a_name_and_a_finite_level() {
        assert_eq!(
            words("density=5e2").unwrap(),
            SurfaceWords { column: String::from("density"), level: 500.0 }
        );
        assert_eq!(words("a = b=-1").unwrap(), SurfaceWords { column: String::from("a = b"), level: -1.0 });
        for wrong in ["", "density", "=5", "density=", "density=x", "density=nan", "density=inf", "5"] {
            assert!(words(wrong).is_err(), "{wrong}");
        }
    }
}
