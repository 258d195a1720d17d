//! `fluisim study`: words to a [`Request`], the report to stdout, files to a directory.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use sph_lab::{MiniFormat, Overflow, Rounding};

use super::failure::Failure;
use super::input::InputArgs;
use super::progress::Bar;
use super::sample::sets;
use super::sample_messages::explain;
use super::study_words::{Bits, Kernels, bits, goal, kernels, named};
use super::support::SupportArgs;
use super::{parse, say, to_stdout};
use crate::io;
use crate::output::Target as File;
use crate::run::CaseName;
use crate::study::fluid::{self, FluidRequest};
use crate::study::{self, Quantity, Request, Study, StudyError, Target, UnitChoice};

/// Find what a number type costs on a particle set, and the one to take.
#[derive(Debug, Args)]
#[command(long_about = long_about())]
pub(super) struct StudyArgs {
    #[arg(required_unless_present = "fluid", help = format!("A particle file, or {}", sets()))]
    particles: Option<PathBuf>,
    /// Study a position-based fluid instead: its height and speed over several starts in each format, beside f64's own scatter
    #[arg(long, value_name = "CASE", value_enum, conflicts_with = "particles")]
    fluid: Option<CaseName>,
    /// Frames of the fluid
    #[arg(long, value_name = "N", default_value_t = 600, value_parser = clap::value_parser!(u32).range(60..=100_000), requires = "fluid")]
    frames: u32,
    /// How often the fluid is begun, from slightly different places
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(2..=1000), requires = "fluid")]
    starts: u32,

    /// The kernel, or all
    #[arg(long, value_name = "NAME|all", default_value = "all", value_parser = kernels)]
    kernel: Kernels,
    /// What the error is measured of: density, interpolation, gradient, or a field of the file by its name; again for more
    #[arg(long = "quantity", value_name = "NAME")]
    quantities: Vec<String>,
    /// The largest error that is good enough, relative to the largest value
    #[arg(long, value_name = "QUANTITY=ERROR,…", value_parser = goal, value_delimiter = ',')]
    want: Vec<(Quantity, f64)>,
    /// The processor whose instructions are told
    #[arg(long, value_enum, default_value_t = Target::M0)]
    target: Target,
    /// How many bits a number may have, 8 to 64
    #[arg(long, value_name = "FROM..TO", value_parser = bits, default_value = "8..32")]
    bits: Bits,
    /// How results are rounded: nearest, floor, zero, stochastic; the recommendation is to nearest, as compiled types are
    #[arg(long, value_name = "ROUNDING,…", value_delimiter = ',', default_value = "nearest", value_parser = named::<Rounding>)]
    round: Vec<Rounding>,
    /// What becomes of results that are out of range: saturating, wrapping, checked; the recommendation has the first
    #[arg(long, value_name = "OVERFLOW,…", value_delimiter = ',', default_value = "saturating", value_parser = named::<Overflow>)]
    overflow: Vec<Overflow>,
    /// Floating point of 16 bits to compare with: f16, bf16, posit16
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',', value_parser = named::<MiniFormat>)]
    also: Vec<MiniFormat>,
    /// Integer bits to have beyond those that are needed
    #[arg(long, value_name = "BITS", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=32))]
    margin: u32,
    /// Print every place of the source with its part of the error
    #[arg(long)]
    blame: bool,
    /// Compute bounds that hold for certain
    #[arg(long)]
    bound: bool,
    /// The units that the numbers have
    #[arg(long, value_enum, default_value_t = UnitChoice::Auto)]
    units: UnitChoice,

    #[command(flatten)]
    support: SupportArgs,
    /// The mass of every particle, over a column
    #[arg(long, value_name = "M", value_parser = parse::positive, allow_hyphen_values = true)]
    mass: Option<f64>,
    /// Dimensions, where a file has more coordinates than are meant
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=3))]
    dim: Option<u8>,
    #[command(flatten)]
    input: InputArgs,

    /// Threads; without it, one for each core. No byte of the result depends on it
    #[arg(long, value_name = "N", value_parser = parse::count)]
    threads: Option<usize>,
    /// Also leave study.csv, study.json and pictures in this directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace files of an earlier study
    #[arg(long)]
    force: bool,
    /// No progress bar
    #[arg(long)]
    quiet: bool,
}

fn long_about() -> String {
    format!(
        "Find what a number type costs on a particle set, and the one to take.\n\n\
         PARTICLES is a file ({}) or a built-in set: {}. Every format of --bits is measured with each kernel at some of the \
         particles, its integer bits being the fewest that hold all results; the fewest bits that meet --want are measured at all \
         particles and recommended with the lines to paste. Errors are against f64, relative to the largest value. A format has \
         the bits of the compiled type.\n\n\
         Exit status 1 when no format meets the goals: the best one and what limits it are printed, and --out is written.\n\n\
         Example: fluisim study demo:vortex --want density=1e-3,gradient=1e-2 --out study",
        io::ENDINGS.join(", "),
        sets(),
    )
}

/// Files of a study that may be there from an earlier one.
const FILES: [&str; 7] =
    ["study.csv", "study.json", "errors.png", "front.png", "bits.png", "units.png", "rounding.png"];

/// Makes the study that the words say.
pub(super) fn run(args: StudyArgs) -> Result<(), Failure> {
    let (out, force, blame) = (args.out.clone(), args.force, args.blame);
    if let Some(directory) = &out {
        check_free(directory, force)?;
    }
    if let Some(case) = args.fluid {
        return run_fluid(case, &args);
    }
    let bar = Bar::new(args.quiet, "{bar:40} {pos}/{len} formats, {left}");
    let request = request(args)?;
    let study = study::run(&request, &bar).map_err(failure)?;
    let mut report = study.to_string();
    if blame {
        report.push_str(&blame_table(&study));
    }
    to_stdout(std::io::stdout().write_all(report.as_bytes()))?;
    if let Some(directory) = &out {
        write(&study, directory)?;
    }
    if study.recommendation.is_some() { Ok(()) } else { Err(no_recommendation(&study, &request)) }
}

/// Makes the study of a fluid.
fn run_fluid(case: CaseName, args: &StudyArgs) -> Result<(), Failure> {
    let bar = Bar::new(args.quiet, "{bar:40} {pos}/{len} runs, {left}");
    let usual = FluidRequest::new(case);
    let roundings =
        if args.round == [Rounding::Nearest] { usual.roundings.clone() } else { args.round.clone() };
    let (frames, starts, threads) = (args.frames, args.starts, args.threads);
    let study =
        fluid::run(&FluidRequest { frames, starts, threads, roundings, ..usual }, &bar).map_err(failure)?;
    to_stdout(std::io::stdout().write_all(study.to_string().as_bytes()))?;
    if let Some(directory) = &args.out {
        prepare(directory, &[])?;
        file(directory, "study.json").create(|file| writeln!(file, "{:#}", study.json()))?;
    }
    match study.recommended() {
        Some(_) => Ok(()),
        None => Err(Failure::input(format!("{case}: no compiled format is within the scatter of f64"))),
    }
}

fn request(args: StudyArgs) -> Result<Request, Failure> {
    let Kernels(kernels) = args.kernel;
    let is_one = kernels.len() == 1;
    if !is_one && args.support.needs_kernel() {
        return Err(Failure::usage(
            "a smoothing length means another support radius for each kernel: choose one --kernel, or give --support",
        ));
    }
    let (asked, fields): (Vec<_>, Vec<_>) =
        args.quantities.into_iter().partition(|name| Quantity::of_name(name).is_some());
    let asked: Vec<Quantity> = asked.iter().filter_map(|name| Quantity::of_name(name)).collect();
    // those of --quantity, else those of --want, else all
    let named: Vec<Quantity> =
        if asked.is_empty() { args.want.iter().map(|(quantity, _)| *quantity).collect() } else { asked };
    let wanted = |quantity: Quantity| {
        args.want.iter().rev().find(|(known, _)| *known == quantity).map(|(_, goal)| *goal)
    };
    let is_wanted =
        |quantity: &&Quantity| named.is_empty() || named.contains(quantity) || wanted(**quantity).is_some();
    let goals = Quantity::ALL.iter().filter(is_wanted);
    let goals = goals.map(|&quantity| (quantity, wanted(quantity).unwrap_or(quantity.usual_goal())));
    let Bits(bits) = args.bits;
    let (particles, only) = args.input.particles(args.particles.unwrap_or_default(), None)?;
    Ok(Request {
        support: args.support.source()?,
        only,
        mass: args.mass,
        dim: args.dim.map(usize::from),
        fields,
        kernels,
        goals: goals.collect(),
        bits,
        roundings: args.round,
        overflows: args.overflow,
        also: args.also,
        margin: args.margin,
        bound: args.bound,
        units: args.units,
        target: args.target,
        threads: args.threads,
        ..Request::new(particles)
    })
}

/// Every place with its part of the error.
fn blame_table(study: &Study) -> String {
    let Some(insight) = &study.insight else { return String::new() };
    let names: Vec<&str> = study.goals.iter().map(|(quantity, _)| quantity.name()).collect();
    let mut table = format!(
        "\n{:<44} error where it alone is rounded, and where all but it are: {}\n",
        "place",
        names.join(", ")
    );
    for one in &insight.blamed {
        let errors = |of: &[f64; 3]| {
            let each = study.goals.iter().map(|&(quantity, _)| format!("{:>9.2e}", of[quantity as usize]));
            each.collect::<Vec<_>>().join(" ")
        };
        table.push_str(&format!("{:<44} {}  {}\n", one.place, errors(&one.alone), errors(&one.without)));
    }
    table
}

/// That no file of an earlier study is in the way.
fn check_free(directory: &Path, force: bool) -> Result<(), Failure> {
    if std::fs::metadata(directory).is_ok_and(|found| !found.is_dir()) {
        return Err(Failure::input(format!(
            "--out {}: is a file, expected a directory",
            directory.display()
        )));
    }
    match FILES.iter().map(|name| directory.join(name)).find(|path| path.exists()) {
        Some(path) if !force => Err(Failure::input(format!(
            "{}: the file exists already and is kept; use --force to replace it",
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// Makes the directory, and removes the files of an earlier study but these, which are to be replaced.
fn prepare(directory: &Path, replaced: &[&str]) -> Result<(), Failure> {
    let failed = |error: std::io::Error| Failure::input(format!("{}: {error}", directory.display()));
    std::fs::create_dir_all(directory).map_err(failed)?;
    let stale = FILES.iter().filter(|name| !replaced.contains(name)).map(|name| directory.join(name));
    stale.filter(|path| path.exists()).try_for_each(std::fs::remove_file).map_err(failed)
}

/// A file of a study; whether an earlier one may be replaced is settled before.
fn file(directory: &Path, name: &str) -> File {
    File { path: directory.join(name), force: true }
}

/// Writes the files of a study.
fn write(study: &Study, directory: &Path) -> Result<(), Failure> {
    let pictures = study.pictures().map_err(|error| Failure::input(error.to_string()))?;
    let names: Vec<&str> =
        pictures.iter().map(|(name, _)| *name).chain(["study.csv", "study.json"]).collect();
    prepare(directory, &names)?;
    file(directory, "study.csv").create(|file| study.write_csv(file))?;
    for (name, image) in &pictures {
        file(directory, name).create(|file| image.write_png(file))?;
    }
    // the last to come: where it is, all others are
    file(directory, "study.json").create(|file| writeln!(file, "{:#}", study.json()))?;
    say(&format!("study.csv, study.json and {} pictures are in {}", pictures.len(), directory.display()));
    Ok(())
}

fn no_recommendation(study: &Study, request: &Request) -> Failure {
    let most = *request.bits.end();
    let advice =
        if most < 64 { "allow more --bits, or ask for less by --want" } else { "ask for less by --want" };
    let limit = study.insight.as_ref().and_then(|insight| insight.blamed.first());
    let limit = limit.map_or_else(String::new, |one| format!("; what limits it most is {}", one.place));
    Failure::input(format!("{}: no format of up to {most} bits meets the goals{limit}: {advice}", study.file))
}

/// The error in the command's words.
fn failure(error: StudyError) -> Failure {
    match error {
        StudyError::Particles(error) => explain(error),
        StudyError::SingularKernel { .. } => Failure::usage(format!("{error}; choose another --kernel")),
        StudyError::NoFormat { .. } => {
            Failure::input(format!("{error}; allow more --bits, or leave out --units file"))
        }
        StudyError::NoFluid { .. } => Failure::usage(format!("--fluid {error}: choose dam-break or tilt")),
        StudyError::Chaotic { .. } => {
            Failure::input(format!("{error}; give more --frames, so that it comes to rest"))
        }
        StudyError::NothingToCompare { .. } => Failure::input(format!(
            "{error}; name other quantities by --quantity, or give a larger --support"
        )),
        _ => Failure::input(error.to_string()),
    }
}
