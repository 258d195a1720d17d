//! `fluisim sample`: words to a [`Request`], its result to a file.

use std::path::PathBuf;
use std::time::Instant;

use clap::{ArgGroup, Args};
use serde_json::{Map, Value, json};

use super::failure::Failure;
use super::input::InputArgs;
use super::parse::{self, Bounds, Counts};
use super::progress::Bar;
use super::results::{self, Results};
use super::sample_messages::{explain, in_words};
use super::say;
use super::support::SupportArgs;
use super::surface::{self, SurfaceWords};
use crate::demo;
use crate::estimate_choice::Estimate;
use crate::io;
use crate::kernel_choice::KernelName;
use crate::output::{self, Content};
use crate::parallel;
use crate::part::Part;
use crate::sample::{self, PartOfPoints, ParticleSource, Request, SampleError, SamplePoints, Sampled, Taken};
use crate::scalar_choice::ScalarName;

/// Evaluate the fields of a particle set at points, on a grid, or at the particles themselves.
#[derive(Debug, Args)]
#[command(long_about = long_about())]
#[command(group = ArgGroup::new("where").required(true).args(["at", "grid", "at_particles"]))]
pub(super) struct SampleArgs {
    #[arg(required = true, help = format!("A particle file, or {}; several files, or a .pvd, have a result each", sets()))]
    particles: Vec<PathBuf>,

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
    input: InputArgs,
    #[command(flatten)]
    support: SupportArgs,
    /// A box in which everything is repeated along each axis; an axis with equal ends is open
    #[arg(long, value_name = "X0,Y0[,Z0],X1,Y1[,Z1]", value_parser = parse::periodic, allow_hyphen_values = true)]
    periodic: Option<Bounds>,

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
    #[arg(long, value_name = "N", value_parser = parse::count, conflicts_with = "at_particles", help = chunk_help())]
    chunk: Option<usize>,
    /// Evaluate the K-th of N shares of the points, layers of a grid or points on end, and leave OUT_K as a piece; the first also
    /// leaves the .pvti or .pvtu that joins them. auto: as mpirun, srun or a SLURM array says
    #[arg(long, value_name = "K/N|auto", value_parser = parse::part)]
    part: Option<Part>,
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
         PARTICLES is a file ({}, each also with .gz behind), - for standard input with --format, or a built-in set: {}. Special \
         columns are x, y, z, m or mass, rho or density, in any case of letters; coordinates are also known as Points:0, pos_x, \
         Coordinates and the like, and a unit in brackets behind a name is dropped. The result goes to stdout as CSV, or to --out in the format that its ending names: {}. Its columns are the \
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
pub(super) fn run(mut args: SampleArgs) -> Result<(), Failure> {
    let words = std::mem::take(&mut args.particles);
    if words.iter().filter(|path| path.as_os_str() == "-").count() > 1 {
        return Err(Failure::usage("standard input is read once: - stands for one file"));
    }
    if args.surface.is_some() && args.part.is_some() {
        return Err(Failure::usage("--surface is taken of the whole grid: it has no --part"));
    }
    let is_series = words.len() > 1 || words.iter().any(|path| io::is_series(path));
    let results = Results::new(args.out.clone(), args.force, args.part, args.surface.clone(), is_series)?;
    let moments = results::moments(words)?;
    let requests = moments.iter().map(|moment| request(&args, moment.path.clone(), &results));
    let requests = requests.collect::<Result<Vec<_>, _>>()?;
    if let Some(request) = requests.first() {
        results.check(requests.len(), &request.at, content(request))?;
    }
    let threads = requests.first().and_then(|request| request.threads);
    let writers = parallel::pool(threads, || ()).map_err(|problem| explain(SampleError::Threads(problem)))?;
    for (number, request) in requests.iter().enumerate() {
        let sampled = sample_one(request, &args)?;
        let start = Instant::now();
        writers.install(|| results.write(number, &sampled.table))?;
        if args.timing {
            say(&format!("timing: {}", timing_line(&sampled, start.elapsed().as_secs_f64())));
        }
    }
    let times: Vec<f64> = moments.iter().map(|moment| moment.time).collect();
    results.finish(&times)
}

/// Samples one set of particles and says what there is to say of it.
fn sample_one(request: &Request, args: &SampleArgs) -> Result<Sampled, Failure> {
    let bar = Bar::new(args.quiet, "{bar:40} {human_pos}/{human_len} points, {left}");
    let sampled = sample::run(request, &bar).map_err(explain)?;
    if let Some(Taken { taken, of }) = sampled.taken {
        say(&format!("{taken} of {of} particles are taken"));
    }
    for warning in &sampled.warnings {
        say(&in_words(warning));
    }
    if args.exact {
        say(&format!("units: {}", units_line(&sampled)));
    }
    Ok(sampled)
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
fn request(args: &SampleArgs, particles: PathBuf, results: &Results) -> Result<Request, Failure> {
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
    let (particles, only) = args.input.particles(particles, args.at.as_deref())?;
    if args.chunk.is_some() && matches!(particles, ParticleSource::Demo(..)) {
        return Err(Failure::usage("--chunk reads a file some particles at a time, not a built-in set"));
    }
    let corners = |corners: &Option<Bounds>| corners.as_ref().map(|Bounds(corners)| corners.clone());
    let at = match (&args.at, &args.grid) {
        (Some(path), _) => SamplePoints::At(args.input.points(path.clone())?),
        (None, Some(Counts(counts))) => {
            let bounds = corners(&args.bounds);
            check_dimensions(counts, bounds.as_deref(), dim)?;
            SamplePoints::Grid { counts: counts.clone(), bounds }
        }
        (None, None) => SamplePoints::AtParticles,
    };
    Ok(Request {
        particles,
        at,
        kernel: args.kernel,
        dim,
        quantities: args.quantities.clone(),
        gradient: args.gradient || args.surface.is_some(),
        surface: args.surface.as_ref().map(|surface| surface.column.clone()),
        support: args.support.source()?,
        only,
        periodic: corners(&args.periodic),
        estimate: args.estimate,
        mass: args.mass,
        recompute_density: args.recompute_density,
        scalar: args.scalar,
        part: args.part.map(|part| PartOfPoints { part, shares_layers: results.shares_layers() }),
        threads: args.threads,
        chunk: args.chunk,
        exact: args.exact,
    })
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
