//! Reads a particle file and evaluates a field of it on a grid: `cargo run -p sph-host --example sample_file [FILE]`.
//!
//! The file needs coordinates, masses and a field `temperature`; without one, this writes a small file of its own.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use sph_host::estimate_choice::Estimate;
use sph_host::kernel_choice::KernelName;
use sph_host::output::{self, Target};
use sph_host::sample::{self, ParticleSource, Request, SamplePoints, SupportFrom};
use sph_host::scalar_choice::ScalarName;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let path = match std::env::args().nth(1) {
        Some(path) => PathBuf::from(path),
        None => lattice(folder.path())?,
    };
    let request = Request {
        particles: ParticleSource::File(path.into()),
        at: SamplePoints::Grid { counts: vec![4, 4], bounds: None },
        kernel: KernelName::WendlandC2,
        dim: None,
        quantities: vec!["temperature".into()],
        gradient: true,
        surface: None,
        support: Some(SupportFrom::Radius(0.26)),
        only: Vec::new(),
        periodic: None,
        part: None,
        estimate: Estimate::Corrected,
        mass: None,
        recompute_density: false,
        scalar: ScalarName::F64,
        threads: None,
        chunk: None,
        exact: false,
    };
    let sampled = sample::run(&request, &())?; // () shows no progress
    for warning in &sampled.warnings {
        eprintln!("warning: {warning}");
    }
    output::write(&sampled.table, &Target { path: folder.path().join("temperature.vti"), force: false })?;
    output::write_csv(&sampled.table, std::io::stdout())?;
    Ok(())
}

/// A file with a temperature that rises by 3 degrees per metre along x.
fn lattice(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let mut text = String::from("x,y,mass,temperature\n");
    for cell in 0..100 {
        let [x, y] = [cell % 10, cell / 10].map(|k| 0.1 * f64::from(k));
        writeln!(text, "{x},{y},0.01,{}", 20.0 + 3.0 * x)?;
    }
    let path = folder.join("lattice.csv");
    std::fs::write(&path, text)?;
    Ok(path)
}
