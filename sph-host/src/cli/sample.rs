//! `fluisim sample`: words to a [`Request`], its result to a file.

use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{ArgGroup, Args};
use serde_json::{Map, Value, json};

use super::failure::Failure;
use super::parse::{self, Bounds, Counts};
use super::progress::Bar;
use super::sample_messages::{explain, in_words, unknown_set};
use super::support::SupportArgs;
use super::surface::{self, SurfaceWords};
use super::{say, to_stdout};
use crate::demo;
use crate::estimate_choice::Estimate;
use crate::io;
use crate::kernel_choice::KernelName;
use crate::output::{self, Content, Target};
use crate::sample::{self, ParticleSource, Request, SamplePoints, Sampled};
use crate::scalar_choice::ScalarName;

/// Evaluate the fields of a particle set at points, on a grid, or at the particles themselves.
#[derive(Debug, Args)]
#[command(long_about = long_about())]
#[command(group = ArgGroup::new("where").required(true).args(["at", "grid", "at_particles"]))]
pub(super) struct SampleArgs {
    #[arg(help = format!("A particle file, or {}", sets()))]
    particles: PathBuf,

    /// Evaluate at the points of this file
    #[arg(long, value_name = "POINTS")]
    at: Option<PathBuf>,
    /// Evaluate at the cell centres of a grid
    #[arg(long, value_name = "NX,NY[,NZ]", value_parser = parse::counts, allow_hyphen_values = true)]
    grid: Option<Counts>,
    /// Evaluate at the particles
    #[arg(long)]
    at_particles: bool,
    /// The grid's box; without it, the particles' bounding box
    #[arg(long, value_name = "X0,Y0[,Z0],X1,Y1[,Z1]", value_parser = parse::bounds, allow_hyphen_values = true)]
    bounds: Option<Bounds>,

    /// The smoothing kernel
    #[arg(long, value_enum, default_value_t = KernelName::CubicSpline)]
    kernel: KernelName,
    /// Dimensions, where a file has more coordinates than are meant: 2 for a 3-D file whose particles lie in a plane. Drops an axis
    /// along which all coordinates are equal
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=3))]
    dim: Option<u8>,
    /// A field to evaluate, again for more; without it, every numeric array that is not special
    #[arg(long = "quantity", value_name = "NAME")]
    quantities: Vec<String>,
    /// Also the gradients: NAME_dx, NAME_dy, NAME_dz
    #[arg(long)]
    gradient: bool,
    /// Write the surface on which a column of the result has a value: triangles, to --out FILE.ply or FILE.obj
    ///
    /// It needs a --grid of three axes. Normals point to lower values; the gradient that they come from need not be asked for. For example:
    /// fluisim sample demo:drop --grid 60,60,60 --bounds=-0.1,-0.1,-0.1,1.1,1.1,1.1 --surface density=500 --out drop.ply
    #[arg(long, value_name = "NAME=LEVEL", value_parser = surface::words)]
    surface: Option<SurfaceWords>,

    #[command(flatten)]
    support: SupportArgs,

    /// The sum that stands for a field
    #[arg(long, value_enum, default_value_t = Estimate::Plain)]
    estimate: Estimate,
    /// The mass of every particle, over a column
    #[arg(long, value_name = "M", value_parser = parse::positive, allow_hyphen_values = true)]
    mass: Option<f64>,
    /// Sum the densities although there is a density column
    #[arg(long)]
    recompute_density: bool,
    #[arg(long, value_name = "TYPE", value_parser = parse::scalar, default_value_t = ScalarName::F64, help = scalar_help())]
    scalar: ScalarName,
    /// About how many particles a built-in set is to have
    #[arg(long = "particles", value_name = "N", value_parser = parse::count)]
    count: Option<usize>,

    #[arg(long, value_name = "N", value_parser = parse::count, conflicts_with = "at_particles", help = chunk_help())]
    chunk: Option<usize>,
    /// Threads; without it, one for each core. No bit of the result depends on it
    #[arg(long, value_name = "N", value_parser = parse::count)]
    threads: Option<usize>,
    /// Sum in sph-core's documented order, so that the bits are those of firmware in the same units from the same origin:
    /// a line of JSON on stderr says which
    #[arg(long)]
    exact: bool,
    /// The result's file; without it, or with /dev/stdout, CSV on stdout
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
    /// No progress bar
    #[arg(long)]
    quiet: bool,
    /// End stderr with a line of JSON that says where the time went
    #[arg(long)]
    timing: bool,
}

/// The built-in sets.
pub(super) fn sets() -> String {
    demo::SETS.iter().map(|(name, _)| format!("demo:{name}")).collect::<Vec<_>>().join(", ")
}

fn long_about() -> String {
    format!(
        "Evaluate the fields of a particle set at points, on a grid, or at the particles themselves.\n\n\
         PARTICLES is a file ({}) or a built-in set: {}. Special columns are x, y, z, m or mass, rho or density, in any case of \
         letters. The result goes to stdout as CSV, or to --out in the format that its ending names: {}. Its columns are the \
         coordinates, density, each quantity, and with --gradient NAME_dx, NAME_dy, NAME_dz.\n\n\
         Example: fluisim sample demo:vortex --grid 256,256 --quantity velocity_x --gradient --out vortex.png",
        io::ENDINGS.join(", "),
        sets(),
        output::ENDINGS.join(", "),
    )
}

fn scalar_help() -> String {
    let compiled: Vec<String> =
        ScalarName::compiled().chain(ScalarName::minis()).map(ScalarName::name).collect();
    format!(
        "The number type: {}, or any other fixed point iAfB with A integer bits, the sign among them, and B fraction bits, 8 to 64 together",
        compiled.join(", ")
    )
}

fn chunk_help() -> String {
    let endings =
        io::FORMATS.iter().filter(|format| format.is_read_in_pieces()).flat_map(|format| format.endings);
    let endings = endings.copied().collect::<Vec<_>>().join(", ");
    format!(
        "Read so many particles at a time, for a file larger than memory ({endings}), at points or on a grid"
    )
}

/// Samples as the words say.
pub(super) fn run(args: SampleArgs) -> Result<(), Failure> {
    let to_file = args.out.clone().filter(|path| path != Path::new("/dev/stdout"));
    let target = to_file.map(|path| Target { path, force: args.force });
    let (quiet, timing, exact) = (args.quiet, args.timing, args.exact);
    let surface = args.surface.clone();
    let request = request(args)?;
    if let Some(surface) = &surface {
        surface.check(&request.at, target.as_ref())?;
    }
    if let Some(target) = &target {
        target.check(content(&request))?;
    }
    let bar = Bar::new(quiet, "{bar:40} {human_pos}/{human_len} points, {left}");
    let sampled = sample::run(&request, &bar).map_err(explain)?;
    for warning in &sampled.warnings {
        say(&format!("warning: {}", in_words(warning)));
    }
    if exact {
        say(&format!("units: {}", units_line(&sampled)));
    }
    let start = Instant::now();
    match (&target, &surface) {
        (Some(target), Some(surface)) => surface.write(&sampled.table, target)?,
        (Some(target), None) => output::write(&sampled.table, target)?,
        (None, _) => to_stdout(output::write_csv(&sampled.table, BufWriter::new(std::io::stdout().lock())))?,
    }
    if timing {
        say(&format!("timing: {}", timing_line(&sampled, start.elapsed().as_secs_f64())));
    }
    Ok(())
}

/// What the result's file will hold.
fn content(request: &Request) -> Content {
    match request.at {
        _ if request.surface.is_some() => Content::Surface,
        SamplePoints::Grid { .. } => Content::Grid,
        SamplePoints::At(_) | SamplePoints::AtParticles => Content::Points,
    }
}

/// What the words ask for, where they are words that can be.
fn request(args: SampleArgs) -> Result<Request, Failure> {
    if args.kernel.is_singular() {
        return Err(Failure::usage(
            "the viscosity kernel diverges at r = 0: it is for viscosity forces, not for densities or interpolation; \
             choose another --kernel",
        ));
    }
    // clap asks for no --grid where another of its group is there
    if args.bounds.is_some() && args.grid.is_none() {
        return Err(Failure::usage("--bounds is the box of a grid: it needs --grid"));
    }
    let dim = args.dim.map(usize::from);
    let particles = particle_source(args.particles, args.count)?;
    if args.chunk.is_some() && matches!(particles, ParticleSource::Demo(..)) {
        return Err(Failure::usage("--chunk reads a file some particles at a time, not a built-in set"));
    }
    let at = match (args.at, args.grid) {
        (Some(path), _) => SamplePoints::At(path),
        (None, Some(Counts(counts))) => {
            let bounds = args.bounds.map(|Bounds(bounds)| bounds);
            check_dimensions(&counts, bounds.as_deref(), dim)?;
            SamplePoints::Grid { counts, bounds }
        }
        (None, None) => SamplePoints::AtParticles,
    };
    Ok(Request {
        particles,
        at,
        kernel: args.kernel,
        dim,
        quantities: args.quantities,
        gradient: args.gradient || args.surface.is_some(),
        surface: args.surface.map(|surface| surface.column),
        support: args.support.source(),
        estimate: args.estimate,
        mass: args.mass,
        recompute_density: args.recompute_density,
        scalar: args.scalar,
        threads: args.threads,
        chunk: args.chunk,
        exact: args.exact,
    })
}

pub(super) fn particle_source(words: PathBuf, count: Option<usize>) -> Result<ParticleSource, Failure> {
    if let Some(name) = words.to_str().and_then(|words| words.strip_prefix("demo:")) {
        if demo::SETS.iter().all(|(known, _)| *known != name) {
            return Err(unknown_set(name));
        }
        return Ok(ParticleSource::Demo(name.to_owned(), count));
    }
    if count.is_some() {
        return Err(Failure::usage("--particles N sizes a built-in set, not a file"));
    }
    Ok(ParticleSource::File(words))
}

fn check_dimensions(counts: &[usize], bounds: Option<&[f64]>, dim: Option<usize>) -> Result<(), Failure> {
    let axes = counts.len();
    if let Some(bounds) = bounds.filter(|bounds| bounds.len() != 2 * axes) {
        let (found, expected) = (bounds.len(), 2 * axes);
        return Err(Failure::usage(format!(
            "--grid has {axes} axes, --bounds {found} numbers: expected {expected}"
        )));
    }
    if let Some(dim) = dim.filter(|&dim| dim != axes) {
        return Err(Failure::usage(format!("--grid has {axes} axes, but --dim is {dim}")));
    }
    Ok(())
}

/// What a program needs to compute the same bits.
fn units_line(sampled: &Sampled) -> Value {
    let units = &sampled.units;
    let quantities: Map<String, Value> =
        units.quantities.iter().map(|(name, unit)| (name.clone(), json!(unit))).collect();
    json!({
        "scalar": units.scalar,
        "origin": units.origin,
        "length": units.length,
        "mass": units.mass,
        "density": units.density,
        "quantities": quantities,
        "cells": units.cells,
    })
}

fn timing_line(sampled: &Sampled, write: f64) -> Value {
    json!({
        "particles": sampled.particles,
        "points": sampled.table.points(),
        "threads": sampled.threads,
        "read_s": sampled.timing.read,
        "search_s": sampled.timing.search,
        "evaluate_s": sampled.timing.evaluate,
        "write_s": write,
    })
}
