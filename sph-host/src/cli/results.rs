//! Where results of `fluisim sample` go: one file, a part of one, or one for each moment of a series.

use std::io::BufWriter;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::surface::SurfaceWords;
use super::to_stdout;
use crate::io::{Moment, is_series, read_series};
use crate::output::{
    self, Content, Format, Table, Target, joint_path, piece_path, write_collection, write_joint,
};
use crate::part::Part;
use crate::sample::SamplePoints;

/// The files of particles that the words name; a series stands for its files.
pub(super) fn moments(words: Vec<PathBuf>) -> Result<Vec<Moment>, Failure> {
    let mut moments = Vec::new();
    for path in words {
        if is_series(&path) {
            moments.extend(read_series(&path)?);
        } else {
            moments.push(Moment { time: moments.len() as f64, path });
        }
    }
    Ok(moments)
}

/// Where results go.
pub(super) struct Results {
    /// None: standard output.
    out: Option<PathBuf>,
    force: bool,
    part: Option<Part>,
    /// What is written of a result, if not all of it.
    surface: Option<SurfaceWords>,
    /// The place in the name where the number of a moment stands, and its digits; none where there is no such place.
    number: Option<Number>,
    is_series: bool,
}

/// A `%04d` in a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Number {
    start: usize,
    end: usize,
    digits: usize,
}

impl Results {
    /// The place of the results of one set of particles, or of a series of them.
    pub(super) fn new(
        out: Option<PathBuf>,
        force: bool,
        part: Option<Part>,
        surface: Option<SurfaceWords>,
        is_series: bool,
    ) -> Result<Self, Failure> {
        let out = out.filter(|path| path != Path::new("/dev/stdout"));
        let number = out.as_deref().and_then(number);
        let is_left = |Number { end, .. }: Number| {
            out.as_deref().and_then(Path::to_str).and_then(|name| number_in(&name[end..])).is_some()
        };
        if number.is_some_and(is_left) {
            return Err(Failure::usage(
                "--out has two places for a number: one is expected, such as out_%04d.vti",
            ));
        }
        if is_series && number.is_none() {
            return Err(Failure::usage(
                "several files of particles have a result each: --out needs a name with a number in it, such as out_%04d.vti",
            ));
        }
        Ok(Self { out, force, part, surface, number, is_series })
    }

    /// The file of this process for the result with this number.
    fn target(&self, number: usize) -> Option<Target> {
        let path = self.whole(number)?;
        let path = self.part.map_or_else(|| path.clone(), |part| piece_path(&path, part));
        Some(self.file(path))
    }

    /// The file of the result with this number, if it were not in parts.
    fn whole(&self, number: usize) -> Option<PathBuf> {
        let out = self.out.as_ref()?;
        let Some(Number { start, end, digits }) = self.number else { return Some(out.clone()) };
        let name = out.display().to_string();
        Some(PathBuf::from(format!("{}{number:0digits$}{}", &name[..start], &name[end..])))
    }

    /// The file that names the parts, which the first of these writes.
    fn joint(&self, number: usize) -> Option<PathBuf> {
        self.part.filter(|part| part.number() == 1)?;
        joint_path(&self.whole(number)?)
    }

    /// The file that names all moments: that of the results without the number.
    fn collection(&self) -> Option<PathBuf> {
        if !self.is_series {
            return None;
        }
        let (out, Number { start, end, .. }) = (self.out.as_ref()?, self.number?);
        if self.part.is_some_and(|part| part.number() > 1) {
            return None;
        }
        let ending = out.extension()?.to_str()?.to_ascii_lowercase();
        let name = out.display().to_string();
        let without = format!("{}{}", name[..start].trim_end_matches(['_', '-', '.']), &name[end..]);
        let is_named = Path::new(&without).file_stem().is_some() && !without.starts_with('.');
        (matches!(&*ending, "vtk" | "vtu" | "vti") && is_named)
            .then(|| Path::new(&without).with_extension("pvd"))
    }

    fn file(&self, path: PathBuf) -> Target {
        Target { path, force: self.force }
    }

    /// Before the work: that all files can be written.
    pub(super) fn check(&self, count: usize, at: &SamplePoints, content: Content) -> Result<(), Failure> {
        if let Some(surface) = &self.surface {
            surface.check(at, self.target(0).as_ref())?;
        }
        for number in 0..count {
            let Some(target) = self.target(number) else { continue };
            let format = target.check(content)?;
            if self.part.is_some() && format.ending == ".png" {
                return Err(Failure::usage("--part leaves a piece of the result: a picture has none"));
            }
            if let Some(joint) = self.joint(number) {
                self.file(joint).check_place()?;
            }
        }
        self.collection().map_or(Ok(()), |path| self.file(path).check_place())?;
        Ok(())
    }

    /// Whether parts of a grid share a layer, so that no gap is between them.
    pub(super) fn shares_layers(&self) -> bool {
        self.out.as_deref().and_then(Format::of).is_some_and(|format| format.ending == ".vti")
    }

    /// Writes the result with this number.
    pub(super) fn write(&self, number: usize, table: &Table) -> Result<(), Failure> {
        let Some(target) = self.target(number) else {
            return to_stdout(output::write_csv(table, BufWriter::new(std::io::stdout().lock())));
        };
        if let Some(surface) = &self.surface {
            return surface.write(table, &target);
        }
        output::write(table, &target)?;
        if let (Some(joint), Some(part), Some(whole)) = (self.joint(number), self.part, self.whole(number)) {
            write_joint(table, &self.file(joint), part, &whole)?;
        }
        Ok(())
    }

    /// Writes the file that names the results of a series, if their format has such.
    pub(super) fn finish(&self, times: &[f64]) -> Result<(), Failure> {
        let Some(collection) = self.collection() else { return Ok(()) };
        let file = |number| self.joint(number).or_else(|| self.whole(number)).unwrap_or_default();
        let moments: Vec<(f64, PathBuf)> =
            times.iter().enumerate().map(|(number, &time)| (time, file(number))).collect();
        Ok(write_collection(&moments, &self.file(collection))?)
    }
}

/// The place of `%d` or `%04d` in a file's name.
fn number(path: &Path) -> Option<Number> {
    let name = path.to_str()?;
    let folder = name.len() - path.file_name()?.len();
    let Number { start, end, digits } = number_in(&name[folder..])?;
    Some(Number { start: folder + start, end: folder + end, digits })
}

fn number_in(text: &str) -> Option<Number> {
    let start = text.find('%')?;
    let digits: String = text[start + 1..].chars().take_while(char::is_ascii_digit).collect();
    let end = start + 1 + digits.len();
    let is_number = text[end..].starts_with('d') && (digits.is_empty() || digits.starts_with('0'));
    let digits = if digits.is_empty() { 1 } else { digits.parse().ok().filter(|&digits| digits <= 9)? };
    is_number.then_some(Number { start, end: end + 1, digits })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_a_place_for_a_number() {
        let results = |name: &str| Results::new(Some(name.into()), false, None, None, true);
        for (name, first, all) in [
            ("out_%04d.vti", "out_0003.vti", Some("out.pvd")),
            ("a%b/out-%d.vtu", "a%b/out-3.vtu", Some("a%b/out.pvd")),
            ("%02d.csv", "03.csv", None),
            ("%02d.vtu", "03.vtu", None),
            ("o%03dx.npz", "o003x.npz", None),
        ] {
            let results = results(name).unwrap_or_else(|_| panic!("{name}"));
            assert_eq!(results.whole(3).as_deref(), Some(Path::new(first)));
            assert_eq!(results.collection().as_deref(), all.map(Path::new), "{name}");
        }
        for wrong in ["o_%d_%03d.vti", "out.vti", "out_%.vti", "out_%4d.vti", "out_%0x.vti", "%04d/out.vti"] {
            assert!(results(wrong).is_err(), "{wrong}");
        }
        let alone = Results::new(Some("o_%04d.vti".into()), false, None, None, false);
        let alone = alone.unwrap_or_else(|_| panic!());
        assert_eq!(alone.whole(0).as_deref(), Some(Path::new("o_0000.vti")));
        assert_eq!(alone.collection(), None);
        let part = Part::new(1, 4).unwrap();
        let results =
            Results::new(Some("o_%d.vti".into()), false, Some(part), None, true).unwrap_or_else(|_| panic!());
        assert_eq!(results.target(2).map(|target| target.path).as_deref(), Some(Path::new("o_2_1.vti")));
        assert_eq!(results.joint(2).as_deref(), Some(Path::new("o_2.pvti")));
    }
}
