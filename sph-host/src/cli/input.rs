//! Words that say how a file of particles is read, and which of them are taken.

use std::path::{Path, PathBuf};

use clap::Args;

use super::failure::Failure;
use super::parse;
use crate::demo;
use crate::io::{InputFile, Takes, endings_that_take};
use crate::sample::{Only, ParticleSource};

/// What a file's name does not say.
#[derive(Debug, Args)]
pub(super) struct InputArgs {
    /// Where the coordinates are: an array of vectors, or a column for each axis; without it, x, y, z or as programs call them
    /// (Points:0, pos_x, Coordinates and the like)
    #[arg(long, value_name = "NAME|X,Y[,Z]", value_delimiter = ',')]
    position: Vec<String>,
    /// Take the particles whose column has one of these values, or one from LOW to HIGH; again for more conditions
    #[arg(long, value_name = "NAME=VALUE[,VALUE…]|NAME=LOW..HIGH", value_parser = parse::only, allow_hyphen_values = true)]
    only: Vec<Only>,
    /// What standard input (-) holds, else the particles' file, as an ending: csv, npz, csv.gz …
    #[arg(long, value_name = "FORMAT")]
    format: Option<String>,
    /// Lines of a text table to pass over before its header
    #[arg(long, value_name = "N", default_value_t = 0)]
    skip_lines: usize,
    #[arg(long, value_name = "NAME", help = group_help())]
    group: Option<String>,
    /// About how many particles a built-in set is to have
    #[arg(long = "particles", id = "count", value_name = "N", value_parser = parse::count)]
    count: Option<usize>,
}

impl InputArgs {
    /// The particles, and which of them are wanted; `points` is the file of points.
    pub(super) fn particles(
        &self,
        words: PathBuf,
        points: Option<&Path>,
    ) -> Result<(ParticleSource, Vec<Only>), Failure> {
        if let Some(name) = words.to_str().and_then(|words| words.strip_prefix("demo:")) {
            if demo::SETS.iter().all(|(known, _)| *known != name) {
                return Err(super::sample_messages::unknown_set(name));
            }
            if !self.position.is_empty() || self.skip_lines > 0 || self.group.is_some() {
                return Err(Failure::usage(
                    "--position, --group and --skip-lines say how a file is read, not a built-in set",
                ));
            }
            return Ok((ParticleSource::Demo(name.to_owned(), self.count), self.only.clone()));
        }
        if self.count.is_some() {
            return Err(Failure::usage("--particles N sizes a built-in set, not a file"));
        }
        let is_twice = |at: usize| self.position[..at].contains(&self.position[at]);
        if self.position.iter().any(String::is_empty) || (0..self.position.len()).any(is_twice) {
            return Err(Failure::usage("--position names an array, or a column for each axis, each once"));
        }
        if self.position.len() > 3 {
            return Err(Failure::usage(
                "--position names one array, or a column for each of up to three axes",
            ));
        }
        let (position, skip_lines, group) = (self.position.clone(), self.skip_lines, self.group.clone());
        let file = InputFile { position, skip_lines, group, ..words.into() };
        let is_of_points = points == Some(Path::new("-")) && !file.is_standard_input();
        let format = self.format.clone().filter(|_| !is_of_points);
        Ok((ParticleSource::File(known(InputFile { format, ..file })?), self.only.clone()))
    }

    /// A file of points.
    pub(super) fn points(&self, path: PathBuf) -> Result<InputFile, Failure> {
        let file = InputFile::from(path);
        let format = self.format.clone().filter(|_| file.is_standard_input());
        let file = InputFile { format, position: self.position.clone(), ..file };
        // a group is that of the particles, and of points in such a file
        let is_grouped = file.known_format()?.0.takes == Takes::Groups;
        known(InputFile { group: self.group.clone().filter(|_| is_grouped), ..file })
    }
}

fn group_help() -> String {
    format!(
        "The particles of this group of an HDF5 file ({}): PySPH's name, such as fluid, or a place, such as PartType1; without it, \
         PartType0 or the only group with particles",
        endings_that_take(Takes::Groups).copied().collect::<Vec<_>>().join(", ")
    )
}

/// The file, if its format is known.
fn known(file: InputFile) -> Result<InputFile, Failure> {
    file.known_format()?;
    Ok(file)
}
